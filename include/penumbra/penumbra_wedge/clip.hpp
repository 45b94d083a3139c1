// From a point through a caster onto the light's plane: edges and loops, cut to what can matter.
//
// Light space: depth 0 is the light's plane, P has depth p > 0. A caster's vertex E at depth e lands at
//     P + (E − P) p / w,   w = p − e,
// kept homogeneous, as (p (E − P) + P w, w), until all cuts are made: what lies beside the light's box goes first, by
// planes through P, which leaves w ≥ 0 without any near plane to choose. Depth 0 is cut before that; else parts of the
// caster behind the light would land on it.
#pragma once

#include <array>
#include <cstddef>
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

/// A caster's vertex as P sees it: (x, y) / w on the light's plane from the middle of the box; `depth` for one cut.
template <class T>
struct SeenVertex {
    T x, y, w, depth;
};

template <class T>
SeenVertex<T> operator+(const SeenVertex<T>& a, const SeenVertex<T>& b) {
    return {a.x + b.x, a.y + b.y, a.w + b.w, a.depth + b.depth};
}
template <class T>
SeenVertex<T> operator-(const SeenVertex<T>& a, const SeenVertex<T>& b) {
    return {a.x - b.x, a.y - b.y, a.w - b.w, a.depth - b.depth};
}
template <class T>
SeenVertex<T> operator*(const SeenVertex<T>& a, T s) {
    return {a.x * s, a.y * s, a.w * s, a.depth * s};
}

/// The five cuts of a caster by the pyramid from P to the box, in order: ≥ 0 is kept.
template <class T>
struct Pyramid {
    static constexpr int cuts = 5;
    Vec3<T> point_ls;
    Vec2<T> middle, half;

    Pyramid(const Vec3<T>& point, const Rect2<T>& box)
        : point_ls(point), middle((box.min + box.max) * T(0.5)), half((box.max - box.min) * T(0.5)) {}

    SeenVertex<T> see(const Vec3<T>& vertex_ls) const {
        const T w = point_ls.z - vertex_ls.z;
        return {point_ls.z * (vertex_ls.x - point_ls.x) + (point_ls.x - middle.x) * w,
                point_ls.z * (vertex_ls.y - point_ls.y) + (point_ls.y - middle.y) * w, w, vertex_ls.z};
    }
    T distance(int cut, const SeenVertex<T>& v) const {
        switch (cut) {
            case 0:
                return v.depth;
            case 1:
                return half.x * v.w + v.x;
            case 2:
                return half.x * v.w - v.x;
            case 3:
                return half.y * v.w + v.y;
            default:
                return half.y * v.w - v.y;
        }
    }
    /// From inside to outside, so that reversed edges give the same vertex bit for bit; put exactly on the plane.
    SeenVertex<T> cut_point(int cut, const SeenVertex<T>& in, const SeenVertex<T>& out, T d_in, T d_out) const {
        SeenVertex<T> v = in + (out - in) * (d_in / (d_in - d_out));
        if (cut == 0) v.depth = T(0);
        if (cut == 1) v.x = -half.x * v.w;
        if (cut == 2) v.x = half.x * v.w;
        if (cut == 3) v.y = -half.y * v.w;
        if (cut == 4) v.y = half.y * v.w;
        return v;
    }
    /// The middle of the box for w too small to divide by: the caster's cross-section is a point there.
    Vec2<T> land(const SeenVertex<T>& v) const {
        return Vec2<T>(middle.x + safe_ratio(v.x, v.w, T(0)), middle.y + safe_ratio(v.y, v.w, T(0)));
    }
};

/// Sutherland and Hodgman's cuts one behind the other, vertex by vertex: loops of any length, no memory.
template <class T, class Edge>
class LoopCutter {
  public:
    LoopCutter(const Pyramid<T>& pyramid, Edge& edge) : pyramid_(pyramid), edge_(edge) {}

    void add(const Vec3<T>& vertex_ls) { push(0, pyramid_.see(vertex_ls)); }
    void close() {
        for (int cut = 0; cut < Pyramid<T>::cuts; ++cut)
            if (stages_[cut].any) cross(cut, stages_[cut].last, stages_[cut].first);
        if (landed_) edge_(last_, first_);
    }

  private:
    struct Stage {
        SeenVertex<T> first, last;
        bool any = false;
    };

    void push(int cut, const SeenVertex<T>& v) {
        if (cut == Pyramid<T>::cuts) {
            const Vec2<T> at = pyramid_.land(v);
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
        if (pyramid_.distance(cut, v) >= T(0)) push(cut + 1, v);
    }
    void cross(int cut, const SeenVertex<T>& from, const SeenVertex<T>& to) {
        const T a = pyramid_.distance(cut, from), b = pyramid_.distance(cut, to);
        if (a >= T(0) && b < T(0)) push(cut + 1, pyramid_.cut_point(cut, from, to, a, b));
        if (a < T(0) && b >= T(0)) push(cut + 1, pyramid_.cut_point(cut, to, from, b, a));
    }

    const Pyramid<T>& pyramid_;
    Edge& edge_;
    std::array<Stage, Pyramid<T>::cuts> stages_{};
    Vec2<T> first_{T(0), T(0)}, last_{T(0), T(0)};
    bool landed_ = false;
};

}  // namespace detail

/// Where the edge from a to b, seen from `point_ls`, lands in the columns of `box` on the light's plane: what
/// edge_coverage needs of it, and all that can be in the box. Light space, world units. Domain: finite, point depth > 0.
/// Parts behind the light's plane, at or beyond the point's depth and beside the box's columns are cut off; an edge of
/// which nothing is left does not land. A lone edge that is cut at the point's depth leaves its loop open at infinity:
/// cut whole casters by project_loop. Error: 4 ε of the distance from the box, in box sizes.
template <class T>
ProjectedEdge<T> project_edge(const Vec3<T>& a_ls, const Vec3<T>& b_ls, const Vec3<T>& point_ls, const Rect2<T>& box) {
    const detail::Pyramid<T> pyramid(point_ls, box);
    detail::SeenVertex<T> a = pyramid.see(a_ls), b = pyramid.see(b_ls);
    bool lands = true;
    for (int cut = 0; cut < 3 && lands; ++cut) {
        const T da = pyramid.distance(cut, a), db = pyramid.distance(cut, b);
        lands = da >= T(0) || db >= T(0);
        if (da >= T(0) && db < T(0)) b = pyramid.cut_point(cut, a, b, da, db);
        if (da < T(0) && db >= T(0)) a = pyramid.cut_point(cut, b, a, db, da);
    }
    constexpr T least = std::numeric_limits<T>::min();
    if (!lands || !(a.w >= least) || !(b.w >= least)) return {pyramid.middle, pyramid.middle, false};
    return {pyramid.land(a), pyramid.land(b), true};
}

/// Cuts the planar caster whose border is the closed loop of `count` vertices by the pyramid from `point_ls` to `box`,
/// and calls edge(Vec2<T> from, Vec2<T> to) for each edge of what lands in the box: a closed loop, the same way round as
/// the caster's border looks from the point towards the light in (x, y). Light space, world units. Domain: finite,
/// point depth > 0. Nothing is called where the caster lies behind the light, beyond the point or beside the pyramid.
/// Loops of any shape: parts that a cut separates stay connected along the border of the box, where nothing is between.
template <class T, class Edge>
void project_loop(const Vec3<T>* loop_ls, std::size_t count, const Vec3<T>& point_ls, const Rect2<T>& box,
                  Edge&& edge) {
    const detail::Pyramid<T> pyramid(point_ls, box);
    detail::LoopCutter<T, Edge> cutter(pyramid, edge);
    for (std::size_t i = 0; i < count; ++i) cutter.add(loop_ls[i]);
    cutter.close();
}

/// The fraction of `box` that the planar caster with this border hides from `point_ls`, signed by the way round, winding
/// counted: in [−1, 1] for a border that does not cross itself. 0 for a box without area. Error in float: 5e-6, and 5e-4
/// for casters within 1e-3 of the point.
template <class T>
T loop_coverage(const Vec3<T>* loop_ls, std::size_t count, const Vec3<T>& point_ls, const Rect2<T>& box) {
    T sum = T(0);
    project_loop(loop_ls, count, point_ls, box,
                 [&](const Vec2<T>& from, const Vec2<T>& to) { sum += edge_coverage(from, to, box); });
    return safe_ratio(sum, area(box), T(0));
}

}  // namespace penumbra
