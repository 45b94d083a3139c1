// From a point through a caster onto the light's plane: edges and loops, cut to what can matter.
//
// Light space: depth 0 is the light's plane, P has depth p > 0. A caster's vertex E at depth e lands at
//     P + (E − P) p / w,   w = p − e.
// Nothing is divided before all cuts are made. A vertex is its distances from the five planes that cut: the light's,
// and four through P and a side of the box each. For the left side that is w (x − box.min.x), x being where E lands:
//     left = p (E.x − P.x) + (P.x − box.min.x) w,     right = p (P.x − E.x) + (box.max.x − P.x) w,
// linear in E; what lands lies at left / (left + right) of the box's width. Cuts by these planes leave w ≥ 0 without
// any near plane to choose, and put vertices on the box's border to the last bit. Depth 0 is cut first; else parts of
// the caster behind the light would land on it.
//
// Source: J. Blinn & M. Newell, "Clipping using homogeneous coordinates", 1978; I. Sutherland & G. Hodgman, "Reentrant
// polygon clipping", 1974.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/coverage.hpp>

namespace penumbra {

/// What an edge leaves on the light's plane; `lands` is false, and both ends are the box's middle, if that is nothing.
template <class T>
struct ProjectedEdge {
    Vec2<T> a, b;
    bool lands;
};

namespace detail {

/// A caster's vertex by its depth, left, right, bottom and top; ≥ 0 inside.
template <class T>
using SeenVertex = std::array<T, 5>;

/// The planes that cut what a point sees through a box.
template <class T>
struct Pyramid {
    static constexpr int cuts = 5;
    Vec3<T> point_ls;
    Rect2<T> box;

    Pyramid(const Vec3<T>& point, const Rect2<T>& light_box) : point_ls(point), box(light_box) {}

    SeenVertex<T> see(const Vec3<T>& vertex_ls) const {
        const T w = point_ls.z - vertex_ls.z;
        const T across = point_ls.z * (vertex_ls.x - point_ls.x), along = point_ls.z * (vertex_ls.y - point_ls.y);
        return {vertex_ls.z, (point_ls.x - box.min.x) * w + across, (box.max.x - point_ls.x) * w - across,
                (point_ls.y - box.min.y) * w + along, (box.max.y - point_ls.y) * w - along};
    }
    static T distance(int cut, const SeenVertex<T>& v) { return v[static_cast<std::size_t>(cut)]; }
};

/// Where the edge from a vertex inside of plane `cut` to one outside meets it. As weighted means: small distances keep
/// their digits beside large ones. Always from inside to outside: reversed edges give the same vertex, bit for bit.
template <class T>
SeenVertex<T> cut_point(std::size_t cut, const SeenVertex<T>& in, const SeenVertex<T>& out) {
    const T whole = in[cut] - out[cut];
    const T of_in = safe_ratio(-out[cut], whole, T(1)), of_out = safe_ratio(in[cut], whole, T(0));
    SeenVertex<T> v;
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = in[k] * of_in + out[k] * of_out;
    v[cut] = T(0);
    return v;
}

/// Where a vertex lands, in units of the box: [0, 1]² inside. The middle for w too small to divide by: the caster's
/// cross-section is a point there.
template <class T>
Vec2<T> land(const SeenVertex<T>& v) {
    return Vec2<T>(safe_ratio(v[1], v[1] + v[2], T(0.5)), safe_ratio(v[3], v[3] + v[4], T(0.5)));
}
/// The same place on the light's plane; exact on the box's border.
template <class T>
Vec2<T> on_plane(const Vec2<T>& at, const Rect2<T>& box) {
    return Vec2<T>(mix(box.min.x, box.max.x, at.x), mix(box.min.y, box.max.y, at.y));
}

/// Sutherland and Hodgman's cuts one behind the other, vertex by vertex: loops of any length, no memory. What lands
/// goes through place(Vec2<T> in units of the box), once for both its edges, to edge(from, to).
template <class T, class Place, class Edge>
class LoopCutter {
  public:
    LoopCutter(const Place& place, Edge& edge) : place_(place), edge_(edge) {}

    void add(const SeenVertex<T>& v) { push(0, v); }
    void close() {
        for (std::size_t cut = 0; cut < cuts; ++cut)
            if (stages_[cut].any) cross(cut, stages_[cut].last, stages_[cut].first);
        if (landed_) edge_(last_, first_);
    }

  private:
    static constexpr std::size_t cuts = Pyramid<T>::cuts;
    struct Stage {
        SeenVertex<T> first, last;
        bool any = false;
    };

    void push(std::size_t cut, const SeenVertex<T>& v) {
        if (cut == cuts) {
            const Vec2<T> at = place_(land(v));
            if (landed_)
                edge_(last_, at);
            else
                first_ = at;
            last_ = at;
            landed_ = true;
            return;
        }
        Stage& stage = stages_[cut];
        if (stage.any)
            cross(cut, stage.last, v);
        else
            stage.first = v;
        stage.last = v;
        stage.any = true;
        if (v[cut] >= T(0)) push(cut + 1, v);
    }
    void cross(std::size_t cut, const SeenVertex<T>& from, const SeenVertex<T>& to) {
        if (from[cut] >= T(0) && to[cut] < T(0)) push(cut + 1, cut_point(cut, from, to));
        if (from[cut] < T(0) && to[cut] >= T(0)) push(cut + 1, cut_point(cut, to, from));
    }

    const Place& place_;
    Edge& edge_;
    std::array<Stage, cuts> stages_{};
    Vec2<T> first_{T(0), T(0)}, last_{T(0), T(0)};
    bool landed_ = false;
};

template <class T, class Place, class Edge>
void cut_loop(const Vec3<T>* loop_ls, std::size_t count, const Vec3<T>& point_ls, const Rect2<T>& box,
              const Place& place, Edge& edge) {
    const Pyramid<T> pyramid(point_ls, box);
    LoopCutter<T, Place, Edge> cutter(place, edge);
    for (std::size_t i = 0; i < count; ++i) cutter.add(pyramid.see(loop_ls[i]));
    cutter.close();
}

}  // namespace detail

/// Where the edge from a to b, seen from `point_ls`, lands in the columns of `box` on the light's plane: what
/// edge_coverage needs of it, and all that can be in the box. Light space, world units. Domain: |coordinates| ≤ 1e18,
/// p > 0, box with an area. Parts behind the light's plane, at or beyond the point's depth and beside the
/// box's columns are cut off; an edge of which nothing is left does not land. Where a caster reaches beyond the point,
/// or behind the light, its edges one by one leave its loop open: cut it whole, by project_loop, or as triangles from
/// one vertex to each edge, by triangle_coverage. Error: 8 ε of the angle at the point.
template <class T>
ProjectedEdge<T> project_edge(const Vec3<T>& a_ls, const Vec3<T>& b_ls, const Vec3<T>& point_ls, const Rect2<T>& box) {
    const detail::Pyramid<T> pyramid(point_ls, box);
    detail::SeenVertex<T> a = pyramid.see(a_ls), b = pyramid.see(b_ls);
    bool lands = true;
    for (std::size_t cut = 0; cut < 3 && lands; ++cut) {
        const bool a_inside = a[cut] >= T(0), b_inside = b[cut] >= T(0);
        lands = a_inside || b_inside;
        if (a_inside && !b_inside) b = detail::cut_point(cut, a, b);
        if (!a_inside && b_inside) a = detail::cut_point(cut, b, a);
    }
    constexpr T least = std::numeric_limits<T>::min();
    lands = lands && a[1] + a[2] >= least && a[3] + a[4] >= least && b[1] + b[2] >= least && b[3] + b[4] >= least;
    const Vec2<T> middle(T(0.5), T(0.5));
    return {detail::on_plane(lands ? detail::land(a) : middle, box),
            detail::on_plane(lands ? detail::land(b) : middle, box), lands};
}

/// Cuts the planar caster whose border is the closed loop of `count` vertices by the pyramid from `point_ls` to `box`,
/// and calls edge(Vec2<T> from, Vec2<T> to) for each edge of what lands in the box: a closed loop, the same way round
/// as the caster's border looks from the point towards the light in (x, y). Light space, world units. Domain:
/// |coordinates| ≤ 1e18, p > 0. Nothing is called where the caster lies behind the light, beyond the point or beside
/// the pyramid. Loops of any shape: parts that a cut separates stay connected along the border of the box, where
/// nothing is between.
template <class T, class Edge>
void project_loop(const Vec3<T>* loop_ls, std::size_t count, const Vec3<T>& point_ls, const Rect2<T>& box,
                  Edge&& edge) {
    const auto place = [&](const Vec2<T>& at) { return detail::on_plane(at, box); };
    detail::cut_loop(loop_ls, count, point_ls, box, place, edge);
}

/// The fraction of `box` that the planar caster with this border hides from `point_ls`, signed by the way round,
/// winding counted: in [−1, 1] for a border that does not cross itself, but for rounding; 1 if it covers the box, 0 if
/// nothing lands, to the last bit. 0 for a box without area. Domain as project_loop; p and the box's sides ≥ 1e-15 in
/// float. Reversing a border negates but for the order of sums; scaling by a power of two changes no bit. Error: 12 ε
/// and 1.5 ε l / d, for the side whose length l is largest beside its distance d from the point (measured 9 ε and
/// 1 ε): in float 5e-6 where l < 20 d, 5e-4 where l < 2700 d. A plane that passes the point within 4 ε of the caster's
/// size may count for the other side of it.
template <class T>
T loop_coverage(const Vec3<T>* loop_ls, std::size_t count, const Vec3<T>& point_ls, const Rect2<T>& box) {
    const Rect2<T> unit{Vec2<T>(T(0), T(0)), Vec2<T>(T(1), T(1))};
    T sum = T(0);
    const auto place = [](const Vec2<T>& at) { return at; };
    const auto add = [&](const Vec2<T>& from, const Vec2<T>& to) { sum += edge_coverage(from, to, unit); };
    detail::cut_loop(loop_ls, count, point_ls, box, place, add);
    return area(box) > T(0) ? sum : T(0);
}

/// loop_coverage of a triangle.
template <class T>
T triangle_coverage(const Vec3<T>& a_ls, const Vec3<T>& b_ls, const Vec3<T>& c_ls, const Vec3<T>& point_ls,
                    const Rect2<T>& box) {
    const Vec3<T> loop_ls[3] = {a_ls, b_ls, c_ls};
    return loop_coverage(loop_ls, 3, point_ls, box);
}

}  // namespace penumbra
