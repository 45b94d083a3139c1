// D-buffer: a picture from the centre of a disk light of where rays enter penumbrae and leave umbrae.
//
// A ray from the light's centre is blocked by casters or not. If not, it is lit up to where it enters the first
// penumbra volume, and from there on the edge that it crossed hides a part of the disk. If it is blocked, it is dark
// from the caster to where it leaves the umbra volume, and the edge that it crosses there uncovers a part. So one texel
// has, for either case, the depth of the crossing and the edge. A second layer has the next crossing, as depth peeling
// finds it: then two edges cut the disk.
//
// Texel centres are right up to rounding; other points take the texel that they lie in, so that boundaries of umbra and
// penumbra are off by a texel at most.
// Source: the umbra and penumbra volume paper for circular lights; second layer, edges and rules for two cuts are ours.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/umbra_volume/cut_share.hpp>
#include <penumbra/umbra_volume/d_buffer_geometry.hpp>
#include <penumbra/umbra_volume/d_buffer_view.hpp>
#include <penumbra/umbra_volume/disk_visibility.hpp>
#include <penumbra/umbra_volume/hiding_edges.hpp>
#include <penumbra/umbra_volume/options.hpp>
#include <vector>

namespace penumbra {

/// Where a ray crosses the side of a volume, and the edge that it belongs to. No crossing: depth is infinite in effect.
template <class T>
struct Crossing {
    T depth = std::numeric_limits<T>::max();
    T silhouette_depth = T(0);  ///< of the edge, where the tangent plane's ray through the crossing meets it
    std::uint32_t edge = 0;     ///< DBuffer::edges
};

/// Two edges as a point sees them.
template <class T>
struct TwoCuts {
    T angle;      ///< between their visible sides, as disk_visibility(t1, t2, angle)
    bool convex;  ///< each lies where the other hides, so that they hide only what both do
};

/// How two edges lie to each other from `point`, all in light space. Edges of different casters never hide as one.
template <class T>
TwoCuts<T> two_cuts(const HidingEdge<T>& first, const HidingEdge<T>& second, const Vec3<T>& point) {
    const Vec3<T> zero(T(0), T(0), T(0));
    const Vec3<T> n1 = normalize_or(glm::cross(first.a - point, first.b - first.a), zero);
    const Vec3<T> n2 = normalize_or(glm::cross(second.a - point, second.b - second.a), zero);
    const Vec3<T> way1 = normalize_or(Vec3<T>(n1.x, n1.y, T(0)), Vec3<T>(T(1), T(0), T(0)));
    const Vec3<T> way2 = normalize_or(Vec3<T>(n2.x, n2.y, T(0)), Vec3<T>(T(1), T(0), T(0)));
    // from the shorter of two chords: acos of a cosine loses digits at both ends, and may be that of more than 1
    const bool obtuse = glm::dot(way1, way2) < T(0);
    const Vec3<T> chord = obtuse ? way1 + way2 : way1 - way2;
    const T turn = detail::half_arc(T(0.25) * glm::dot(chord, chord));
    // on the other's plane counts as hidden: of an edge there and back between is nothing
    const Vec3<T> to1 = (first.a + first.b) * T(0.5) - point, to2 = (second.a + second.b) * T(0.5) - point;
    constexpr T slack = T(-32) * std::numeric_limits<T>::epsilon();
    const bool hidden1 = glm::dot(n2, to1) >= slack * detail::largest_component(to1);
    const bool hidden2 = glm::dot(n1, to2) >= slack * detail::largest_component(to2);
    return {obtuse ? pi<T> - turn : turn, first.mesh == second.mesh && hidden1 && hidden2};
}

/// V(t) by one of its forms.
template <class T>
T cut_visibility(T t, CutVisibility form) {
    return form == CutVisibility::exact   ? disk_visibility(t)
           : form == CutVisibility::cubic ? disk_visibility_cubic(t)
                                          : disk_visibility_sqrt(t);
}

namespace detail {
template <class T>
class DBufferBuilder;
}  // namespace detail

/// Built once; looked up from any number of threads.
template <class T>
class DBuffer {
  public:
    static constexpr T widest = DBufferGeometry<T>::widest;  ///< slope of the image's borders, at most

    DBuffer() = default;
    /// For valid casters and a valid light, in `frame`. Points outside of the image are lit: it holds all umbrae and
    /// penumbrae but for what lies at slopes above `widest`. `resolution` ≥ 1 texels a side, `layers` 1 or 2. Casters
    /// are cut off at a millionth of their reach before the light's plane.
    DBuffer(const std::vector<Mesh<T>>& casters, const LightFrame<T>& frame, T radius, int resolution, int layers,
            VolumeSilhouette silhouette = VolumeSilhouette::disk, DBufferDepth depth = DBufferDepth::light_plane);

    bool empty() const {
        return casters_.empty() || !(view_.slopes.min.x < view_.slopes.max.x) ||
               !(view_.slopes.min.y < view_.slopes.max.y);
    }
    const DBufferView<T>& view() const { return view_; }
    int layers() const { return layers_; }
    T radius() const { return radius_; }
    const std::vector<HidingEdge<T>>& edges() const { return edges_; }
    /// A texel's depth beyond which the ray is blocked: the middle of a solid, so that points on either side of it are
    /// clearly before it or behind.
    T caster(int x, int y) const { return casters_[texel(x, y)]; }
    const Crossing<T>& umbra(int x, int y, int layer) const {
        return umbra_[texel(x, y) * layer_count() + static_cast<std::size_t>(layer)];
    }
    const Crossing<T>& penumbra(int x, int y, int layer) const {
        return penumbra_[texel(x, y) * layer_count() + static_cast<std::size_t>(layer)];
    }
    std::size_t bytes() const {
        return casters_.size() * sizeof(T) + (umbra_.size() + penumbra_.size()) * sizeof(Crossing<T>) +
               edges_.size() * sizeof(HidingEdge<T>);
    }

    /// The fraction of the light that a point in light space sees past one edge or two. Exactly 1 before the penumbra
    /// and exactly 0 within the umbra; 1 on and behind the light's plane, and for points that are not finite.
    T visibility(const Vec3<T>& point, CutVisibility form, CutShare share) const {
        if (!(point.z > T(0)) || !is_finite(point) || empty()) return T(1);
        const Vec2<T> at = view_.to_texel(point);
        const T size = static_cast<T>(view_.resolution);
        if (!(at.x >= T(0) && at.x < size && at.y >= T(0) && at.y < size)) return T(1);
        const std::size_t i = texel(static_cast<int>(at.x), static_cast<int>(at.y));
        const T depth = view_.depth_of(point);
        const bool behind = depth > casters_[i];
        const Crossing<T>* const crossings = (behind ? umbra_ : penumbra_).data() + i * layer_count();
        // what an edge leaves that was not crossed yet: nothing of the light, or all
        const T uncrossed = behind ? T(0) : T(1);
        if (!has_edge(crossings[0]) || !(crossings[0].depth < depth)) return uncrossed;
        const HidingEdge<T>& first = edges_[crossings[0].edge];
        const T t1 = cut_share(crossings[0], point, depth, behind, share);
        if (share == CutShare::edge && first.corner != HidingEdge<T>::none) {
            const HidingEdge<T>& second = edges_[first.corner];
            return past_two(first, second, t1, share_of(second, point), point, form);
        }
        const T v1 = share == CutShare::edge ? past_neighbours(first, t1, point, form) : cut_visibility(t1, form);
        if (layers_ < 2 || !has_edge(crossings[1]) || !(crossings[1].silhouette_depth < depth)) return v1;
        const HidingEdge<T>& second = edges_[crossings[1].edge];
        const bool crossed = crossings[1].depth < depth;
        if (!crossed && first.mesh == second.mesh) return v1;  // where one caster ends, its first edge says
        const T t2 = crossed ? cut_share(crossings[1], point, depth, behind, share) : uncrossed;
        return past_two(first, second, t1, t2, point, form);
    }

  private:
    friend class detail::DBufferBuilder<T>;

    std::size_t layer_count() const { return static_cast<std::size_t>(layers_); }
    std::size_t texel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.resolution) + static_cast<std::size_t>(x);
    }
    static bool has_edge(const Crossing<T>& crossing) { return crossing.depth < std::numeric_limits<T>::max(); }

    T share_of(const HidingEdge<T>& edge, const Vec3<T>& point) const {
        const T t = edge_cut_share(edge.a, edge.b, point, radius_);
        if (edge.chained == HidingEdge<T>::none) return t;
        const HidingEdge<T>& other = edges_[edge.chained];
        if (!(std::max(other.a.z, other.b.z) < point.z)) return t;
        return std::min(t, edge_cut_share(other.a, other.b, point, radius_));
    }
    T cut_share(const Crossing<T>& crossing, const Vec3<T>& point, T depth, bool behind, CutShare share) const {
        if (share == CutShare::edge) return share_of(edges_[crossing.edge], point);
        return behind ? umbra_cut_share(crossing.silhouette_depth, crossing.depth, depth)
                      : penumbra_cut_share(crossing.silhouette_depth, crossing.depth, depth);
    }
    /// Past an edge: beyond an outer corner the light is not hidden that lies past the other edge there. Only for
    /// neighbours that look at least half as long as the light's radius: shorter ones are soon followed by others.
    T past_neighbours(const HidingEdge<T>& edge, T t, const Vec3<T>& point, CutVisibility form) const {
        T most = cut_visibility(t, form);
        for (const std::uint32_t number : {edge.before, edge.after}) {
            if (number == HidingEdge<T>::none) continue;
            const HidingEdge<T>& other = edges_[number];
            if (!(std::max(other.a.z, other.b.z) < point.z)) continue;
            const T grown_a = point.z / (point.z - other.a.z), grown_b = point.z / (point.z - other.b.z);
            const Vec2<T> along((other.b.x - point.x) * grown_b - (other.a.x - point.x) * grown_a,
                                (other.b.y - point.y) * grown_b - (other.a.y - point.y) * grown_a);
            if (!(glm::dot(along, along) > T(0.25) * radius_ * radius_)) continue;
            most = std::max(most, past_two(edge, other, t, share_of(other, point), point, form));
        }
        return most;
    }
    static T past_two(const HidingEdge<T>& first, const HidingEdge<T>& second, T t1, T t2, const Vec3<T>& point,
                      CutVisibility form) {
        const TwoCuts<T> cuts = two_cuts(first, second, point);
        if (form == CutVisibility::exact)
            return cuts.convex ? disk_visibility_between(t1, t2, cuts.angle) : disk_visibility(t1, t2, cuts.angle);
        const T v1 = cut_visibility(t1, form), v2 = cut_visibility(t2, form);
        return cuts.convex ? std::max(v1, v2) : std::min(v1, v2);
    }

    DBufferView<T> view_{{Vec2<T>(T(0), T(0)), Vec2<T>(T(0), T(0))}, 0};
    T radius_ = T(0);
    int layers_ = 1;
    std::vector<T> casters_;
    std::vector<Crossing<T>> umbra_, penumbra_;
    std::vector<HidingEdge<T>> edges_;
};

}  // namespace penumbra

#include <penumbra/umbra_volume/d_buffer_builder.hpp>  // what the constructor does
