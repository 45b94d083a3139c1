// Umbra and penumbra volumes of a mesh under a disk light, ready to rasterise.
//
// From each edge of a silhouette a quad runs away from the light, along the rays from the edge's extrusion point
// through its ends: in a plane that touches disk and caster. At a corner two quads part where the disk rolls over the
// vertex; a fan of triangles between them follows the cone that it leaves there. Where they cross instead, at outer
// corners of the umbra, each ends at the other.
//
// Light space throughout: the disk's centre is the origin, the third axis its normal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/umbra_volume/extrusion.hpp>
#include <penumbra/umbra_volume/silhouette.hpp>
#include <vector>

namespace penumbra {

/// Which of the two volumes.
enum class VolumeKind { umbra, penumbra };

/// A face of a volume's side: the rays from `rim`, a point of the disk, through the edge from a to b. For a fan's
/// triangles the edge is the vertex that the disk rolls over: a and b are equal, and the rays run from `rim` and from
/// `rim_b`, the next point of the arc, which in a quad is `rim`.
template <class T>
struct VolumeSide {
    Vec3<T> a, b, rim, rim_b;
    std::uint32_t from, to;  ///< the vertices at a and b
    bool ridge;              ///< see VolumeEdge
    bool crossed;            ///< a fan whose neighbours cross each other, and which lies behind them
    VolumeKind kind;

    bool is_fan() const { return from == to; }
    /// Where the rays through a and through b reach `depth`, behind both.
    Vec3<T> far_a(T depth) const { return a + (a - rim) * ((depth - a.z) / a.z); }
    Vec3<T> far_b(T depth) const { return b + (b - rim_b) * ((depth - b.z) / b.z); }
    /// An edge that hides what the side's planes hide: its own, or for a fan the tangent of its arc, through the
    /// vertex.
    std::array<Vec3<T>, 2> hiding_edge() const {
        if (!is_fan()) return {a, b};
        const Vec3<T> chord = kind == VolumeKind::umbra ? rim_b - rim : rim - rim_b;
        return {a, a + chord};
    }
};

namespace detail {

/// The order of edges around loops: after each edge the one that goes on from its end, such that every edge follows
/// once. Where several do, the one that turns farthest towards the caster, as seen from the light's centre.
template <class T>
std::vector<std::uint32_t> next_edges(const std::vector<Vec3<T>>& vertices, const std::vector<VolumeEdge>& edges) {
    std::vector<std::uint32_t> from(edges.size());
    for (std::uint32_t i = 0; i < from.size(); ++i) from[i] = i;
    std::sort(from.begin(), from.end(), [&](std::uint32_t i, std::uint32_t k) {
        return edges[i].from != edges[k].from ? edges[i].from < edges[k].from : i < k;
    });
    const auto seen = [&](std::uint32_t i) { return Vec2<T>(vertices[i].x, vertices[i].y) / vertices[i].z; };
    std::vector<bool> taken(edges.size(), false);
    std::vector<std::uint32_t> next(edges.size(), 0xffffffffU);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const VolumeEdge& edge = edges[i];
        auto at = std::lower_bound(from.begin(), from.end(), edge.to,
                                   [&](std::uint32_t k, std::uint32_t vertex) { return edges[k].from < vertex; });
        const Vec2<T> in = seen(edge.to) - seen(edge.from);
        T best = T(-10);
        for (; at != from.end() && edges[*at].from == edge.to; ++at) {
            if (taken[*at]) continue;
            const Vec2<T> out = seen(edges[*at].to) - seen(edge.to);
            // the caster is where x y' − y x' < 0: seen from the light, whose frame is right-handed, on the left
            const T turn = std::atan2(in.y * out.x - in.x * out.y, in.x * out.x + in.y * out.y);
            if (turn > best) best = turn, next[i] = *at;
        }
        if (next[i] != 0xffffffffU) taken[next[i]] = true;
    }
    return next;
}

/// The angle from one point of the rim to another, in (−π, π].
template <class T>
T rim_angle(const Vec3<T>& from, const Vec3<T>& to) {
    return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
}

/// The nearest side of a loop that is not a fan, `step` at a time from the one at `at`: 1 forwards, loop.size() − 1
/// back. `at` itself if there is no other.
template <class T>
std::size_t quad_beside(const std::vector<VolumeSide<T>>& loop, std::size_t at, std::size_t step) {
    std::size_t k = at;
    do k = (k + step) % loop.size();
    while (k != at && loop[k].is_fan());
    return k;
}
/// Whether a loop is the fan around a tip.
template <class T>
bool is_tip(const std::vector<VolumeSide<T>>& loop) {
    return std::all_of(loop.begin(), loop.end(), [](const VolumeSide<T>& side) { return side.is_fan(); });
}

}  // namespace detail

/// The sides of a volume, without its ends, loop by loop: a quad for each edge, and fans where neighbours part, with a
/// triangle for each `fan_step` radians of the arc or less; for each tip a fan all around. The sides of a loop follow
/// each other, and each shares its first border with the one before: no gaps. `vertices` in light space, those of edges
/// at depth > 0; edges that run through the disk, which no silhouette for that disk has but by rounding, take their
/// limit. Source: the umbra and penumbra volume paper for circular lights, where fans are one triangle.
template <class T>
std::vector<std::vector<VolumeSide<T>>> volume_sides(const std::vector<Vec3<T>>& vertices,
                                                     const VolumeSilhouettes& silhouettes, T radius, VolumeKind kind,
                                                     T fan_step) {
    const LightFrame<T> frame{Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(0), T(1), T(0)),
                              Vec3<T>(T(0), T(0), T(1))};
    const bool umbra = kind == VolumeKind::umbra;
    const std::vector<VolumeEdge>& edges = umbra ? silhouettes.umbra : silhouettes.penumbra;
    std::vector<Vec3<T>> rims;
    rims.reserve(edges.size());
    for (const VolumeEdge& edge : edges) {
        const ExtrusionPoints<T> points = extrusion_points(vertices[edge.from], vertices[edge.to], frame, radius);
        rims.push_back(umbra ? points.umbra : points.penumbra);
    }
    std::vector<std::vector<VolumeSide<T>>> loops;
    const auto add_fan = [&](std::uint32_t vertex, const Vec3<T>& from, const Vec3<T>& to, T angle, bool ridge,
                             bool crossed) {
        const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / fan_step)));
        Vec3<T> last = from;
        for (int k = 1; k <= steps; ++k) {
            const T turn = angle * (static_cast<T>(k) / static_cast<T>(steps));
            const T cosine = std::cos(turn), sine = std::sin(turn);
            const Vec3<T> turned(from.x * cosine - from.y * sine, from.x * sine + from.y * cosine, T(0));
            const Vec3<T> rim = k == steps ? to : turned;
            const Vec3<T>& v = vertices[vertex];
            if (rim != last) loops.back().push_back({v, v, last, rim, vertex, vertex, ridge, crossed, kind});
            last = rim;
        }
    };
    const std::vector<std::uint32_t> next = detail::next_edges(vertices, edges);
    std::vector<bool> done(edges.size(), false);
    for (std::uint32_t first = 0; first < edges.size(); ++first) {
        if (done[first]) continue;
        loops.emplace_back();
        for (std::uint32_t i = first; i < edges.size() && !done[i]; i = next[i]) {
            done[i] = true;
            const VolumeEdge& edge = edges[i];
            const Vec3<T>&a = vertices[edge.from], &b = vertices[edge.to];
            loops.back().push_back({a, b, rims[i], rims[i], edge.from, edge.to, edge.ridge, false, kind});
            if (next[i] >= edges.size()) break;
            const VolumeEdge& after = edges[next[i]];
            // around outer corners the disk rolls with the loop, clockwise; around inner ones against it
            const Vec3<T> normal = glm::cross(b - a, a - rims[i]);
            const bool outer = !(glm::dot(normal, vertices[after.to] - a) < T(0));  // a way back is one
            T angle = detail::rim_angle(rims[i], rims[next[i]]);
            if (std::abs(angle) > T(1e-3) && (angle < T(0)) != outer) angle += T(2) * pi<T> * (outer ? T(-1) : T(1));
            add_fan(edge.to, rims[i], rims[next[i]], angle, edge.ridge && after.ridge, umbra == outer);
        }
    }
    for (const std::uint32_t tip : umbra ? silhouettes.umbra_tips : silhouettes.penumbra_tips) {
        loops.emplace_back();
        const Vec3<T> rim(radius, T(0), T(0));
        add_fan(tip, rim, rim, T(-2) * pi<T>, true, false);
    }
    return loops;
}

/// A volume as a closed mesh in light space, down to `far_depth`, behind all its vertices: the faces that see all of
/// the disk (penumbra), or some (umbra), turned to the light; its sides, as volume_sides; an end at far_depth. Each
/// edge is run through as often one way as the other, by two faces unless loops touch: no holes, and is_closed holds,
/// wherever the silhouettes are those of `mesh_ls`. Umbra sides cross each other behind outer corners and beyond the
/// umbra's apex: see trimmed_umbra.
template <class T>
Mesh<T> volume_mesh(const Mesh<T>& mesh_ls, const VolumeSilhouettes& silhouettes, T radius, VolumeKind kind,
                    T far_depth, T fan_step) {
    const bool umbra = kind == VolumeKind::umbra;
    Mesh<T> result;
    result.positions = mesh_ls.positions;
    const auto add_faces = [&](const std::vector<VolumeFace>& faces) {
        for (const VolumeFace& face : faces) {
            const glm::uvec3& t = mesh_ls.triangles[face.face];
            result.triangles.push_back(face.turned ? glm::uvec3(t.x, t.z, t.y) : t);
        }
    };
    add_faces(silhouettes.lit);
    if (umbra) add_faces(silhouettes.faces);
    const auto push = [&](const Vec3<T>& position) {
        result.positions.push_back(position);
        return static_cast<std::uint32_t>(result.positions.size() - 1);
    };
    for (const std::vector<VolumeSide<T>>& loop :
         volume_sides(mesh_ls.positions, silhouettes, radius, kind, fan_step)) {
        Vec3<T> middle(T(0), T(0), T(0));
        for (const VolumeSide<T>& side : loop) middle += side.far_a(far_depth) / static_cast<T>(loop.size());
        const std::uint32_t end = push(middle), first = push(loop.front().far_a(far_depth));
        std::uint32_t far_a = first;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const VolumeSide<T>& side = loop[i];
            const std::uint32_t far_b = i + 1 == loop.size() ? first : push(side.far_b(far_depth));
            if (!side.is_fan()) result.triangles.emplace_back(side.to, side.from, far_a);
            result.triangles.emplace_back(side.to, far_a, far_b);
            result.triangles.emplace_back(far_b, far_a, end);
            far_a = far_b;
        }
    }
    return result;
}

/// The sides of an umbra, each to where others cross it, down to `far_depth`: of a loop without inner corners to every
/// other side, so that what is left of them bounds the umbra; of any other loop to the neighbours across outer corners.
/// `loop` is one of volume_sides'. Sides of which nothing is left are empty. O(n²) in the sides of a loop.
template <class T>
std::vector<ConvexPolygon<Vec3<T>, 16>> trimmed_umbra(const std::vector<VolumeSide<T>>& loop, T far_depth) {
    const std::size_t count = loop.size();
    // a plane through each quad; its inside is the umbra's
    std::vector<Plane<T>> planes(count);
    bool convex = true;
    for (std::size_t i = 0; i < count; ++i) {
        const VolumeSide<T>& side = loop[i];
        const Vec3<T> normal = normalize_or(glm::cross(side.b - side.a, side.a - side.rim), Vec3<T>(T(0), T(0), T(0)));
        planes[i] = {normal, -glm::dot(normal, side.a)};
    }
    for (const VolumeSide<T>& side : loop) convex = convex && (!side.is_fan() || side.crossed);
    std::vector<ConvexPolygon<Vec3<T>, 16>> result(count);
    if (detail::is_tip(loop)) return result;  // there is no umbra
    for (std::size_t i = 0; i < count; ++i) {
        const VolumeSide<T>& side = loop[i];
        if (side.crossed) continue;
        ConvexPolygon<Vec3<T>, 16> polygon;
        polygon.push(side.b);
        if (!side.is_fan()) polygon.push(side.a);
        polygon.push(side.far_a(far_depth)), polygon.push(side.far_b(far_depth));
        const auto cut = [&](std::size_t k) {
            if (k != i && !loop[k].is_fan() && polygon.count + 1 < 16)
                polygon = clip(polygon, [&](const Vec3<T>& v) {
                    // what both share is on the plane, whatever rounding says
                    return v == loop[k].a || v == loop[k].b ? T(0) : signed_distance(planes[k], v);
                });
        };
        if (convex) {
            for (std::size_t k = 0; k < count; ++k) cut(k);
        } else if (!side.is_fan()) {
            const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
            if (!loop[before].is_fan() || loop[before].crossed) cut(detail::quad_beside(loop, i, count - 1));
            if (!loop[after].is_fan() || loop[after].crossed) cut(detail::quad_beside(loop, i, 1));
        }
        if (polygon.count >= 3) result[i] = polygon;
    }
    return result;
}

}  // namespace penumbra
