// A scene as a planner sees it: boxes in light space, and what they limit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/plan/extents.hpp>
#include <utility>
#include <vector>

namespace penumbra {

/// Boxes of casters, one a mesh, and of receivers, in the light's frame.
template <class T>
struct SceneExtents {
    LightFrame<T> frame{};
    LightExtent<T> light{};
    std::vector<Box3<T>> casters, receivers;
    /// Of each caster, the largest share of the light that it hides from any receiver, in [0, 1].
    std::vector<T> hidden;

    /// That of all casters together: at most the sum.
    T total_hidden() const {
        T sum = T(0);
        for (const T share : hidden) sum += share;
        return saturate(sum);
    }
    /// The largest share of the light that any two casters both hide from a receiver, summed over all pairs; 1 as soon
    /// as it is more than a half. `pairs` is how many hide the light from the same point, as far as they were tried.
    T total_overlap(std::size_t& pairs) const {
        pairs = 0;
        T sum = T(0);
        std::vector<Box3<T>> near, shadows;
        for (const Box3<T>& r : receivers) {
            near.clear(), shadows.clear();
            for (const Box3<T>& c : casters) {
                const Box3<T> shadow = shadow_box(c, r, light.half_size);
                for (std::size_t k = 0; k < near.size(); ++k) {
                    const Box3<T> both{glm::max(shadows[k].min, shadow.min), glm::min(shadows[k].max, shadow.max)};
                    if (is_empty(both)) continue;
                    const T share = overlap_limit(near[k], c, both, light);
                    pairs += share > T(0) ? 1 : 0;
                    sum += share;
                    if (sum > T(0.5)) return T(1);
                }
                if (!is_empty(shadow)) near.push_back(c), shadows.push_back(shadow);
            }
        }
        return sum;
    }
    /// Of all casters, world units.
    T widest_penumbra() const {
        T widest = T(0);
        for (const Box3<T>& c : casters)
            for (const Box3<T>& r : receivers) widest = std::max(widest, penumbra_width(c, r, light.half_size));
        return widest;
    }
};

namespace detail {

/// Whether the light looks where it does whatever casters there are.
template <class T>
bool has_own_frame(const RectLight<T>& light) {
    const Vec2<T> half = half_size(light);
    return half.x > T(0) && half.y > T(0);
}
template <class T>
bool has_own_frame(const DiskLight<T>&) {
    return true;
}
template <class T>
bool has_own_frame(const LinearLight<T>&) {
    return false;
}

/// bounds() of a mesh that may be broken: of what is not.
template <class T>
Box3<T> checked_bounds(const Mesh<T>& mesh) {
    Box3<T> box = empty_box<T>();
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            if (t[k] < mesh.positions.size()) box = extend(box, mesh.positions[t[k]]);
    return box;
}

/// The middle of all casters, at which lights without a direction of their own look.
template <class T>
Vec3<T> middle_of(const std::vector<Mesh<T>>& casters) {
    Box3<T> box = empty_box<T>();
    for (const Mesh<T>& mesh : casters) box = join(box, checked_bounds(mesh));
    return is_empty(box) ? Vec3<T>(T(0), T(0), T(0)) : (box.min + box.max) * T(0.5);
}
template <class T>
LightFrame<T> plan_frame(const RectLight<T>& light, const std::vector<Mesh<T>>& casters) {
    return has_own_frame(light) ? light_frame(light) : light_frame(light, middle_of(casters) - light.center);
}
template <class T>
LightFrame<T> plan_frame(const DiskLight<T>& light, const std::vector<Mesh<T>>&) {
    return light_frame(light);
}
template <class T>
LightFrame<T> plan_frame(const LinearLight<T>& light, const std::vector<Mesh<T>>& casters) {
    return light_frame(light, middle_of(casters) - (light.a * T(0.5) + light.b * T(0.5)));
}
template <class T>
LightExtent<T> light_extent(const RectLight<T>& light) {
    return {half_size(light), false};
}
template <class T>
LightExtent<T> light_extent(const DiskLight<T>& light) {
    return {Vec2<T>(light.radius, light.radius), true};
}
template <class T>
LightExtent<T> light_extent(const LinearLight<T>& light) {
    return {Vec2<T>(safe_length(light.b - light.a) * T(0.5), T(0)), false};
}

/// Around a mesh in light space, with what rounding may make of it.
template <class T>
Box3<T> seen_box(const Mesh<T>& mesh, const LightFrame<T>& frame) {
    constexpr T big = std::numeric_limits<T>::max();
    T low[3] = {big, big, big}, high[3] = {-big, -big, -big};
    for (const Vec3<T>& p : mesh.positions) {
        const Vec3<T> at = frame.to_light(p);
        for (int k = 0; k < 3; ++k) {
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
        }
    }
    Box3<T> box{Vec3<T>(low[0], low[1], low[2]), Vec3<T>(high[0], high[1], high[2])};
    if (is_empty(box)) return empty_box<T>();
    const T reach = largest_component(detail::farthest_of(box)) + largest_component(frame.origin);
    const T margin = T(16) * std::numeric_limits<T>::epsilon() * reach;
    return {box.min - margin, box.max + margin};
}

/// By two texels of an image over all casters as a light of this size sees them, from its nearest depth to its
/// farthest.
template <class T>
void widen_by_texels(std::vector<Box3<T>>& boxes, const Vec2<T>& half_size, int image_size) {
    T nearest = std::numeric_limits<T>::max(), farthest = T(0), reach = T(0);
    for (const Box3<T>& box : boxes) {
        if (is_empty(box) || !(box.max.z > T(0))) continue;
        nearest = std::min(nearest, std::max(box.min.z, T(0))), farthest = std::max(farthest, box.max.z);
        const Vec3<T> out = detail::farthest_of(box);
        reach = std::max({reach, out.x + half_size.x, out.y + half_size.y});
    }
    constexpr T most = T(1e3);
    const T larger = nearest * most > farthest ? farthest / nearest : most;
    const T margin = T(4) * reach * larger / static_cast<T>(image_size);
    for (Box3<T>& box : boxes) {
        if (is_empty(box)) continue;
        box.min.x -= margin, box.min.y -= margin, box.max.x += margin, box.max.y += margin;
    }
}

/// Neighbours in the list become one, until there are few.
template <class T>
void merge_to_few(std::vector<Box3<T>>& boxes) {
    constexpr std::size_t few = 16;
    const std::size_t group = (boxes.size() + few - 1) / few;
    if (group < 2) return;
    std::vector<Box3<T>> merged;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (i % group == 0) merged.push_back(empty_box<T>());
        merged.back() = join(merged.back(), boxes[i]);
    }
    boxes = std::move(merged);
}

}  // namespace detail

/// Costs one look at every vertex. Casters, light and receivers are valid; casters receive if `casters_receive`, and if
/// they do not and there are no receivers, these may be anywhere. For methods by images of so many texels a side
/// casters' boxes are widened by two texels as they are at most; 0: they are not.
template <class T, class Light>
SceneExtents<T> scene_extents(const std::vector<Mesh<T>>& casters, const Light& light,
                              const std::vector<Mesh<T>>& receivers, bool casters_receive, int image_size = 0) {
    SceneExtents<T> result;
    result.frame = detail::plan_frame(light, casters);
    result.light = detail::light_extent(light);
    for (const Mesh<T>& mesh : casters) result.casters.push_back(detail::seen_box(mesh, result.frame));
    if (casters_receive) result.receivers = result.casters;
    if (image_size > 0) detail::widen_by_texels(result.casters, result.light.half_size, image_size);
    for (const Mesh<T>& mesh : receivers) result.receivers.push_back(detail::seen_box(mesh, result.frame));
    detail::merge_to_few(result.receivers);
    constexpr T far = T(1e9);
    if (result.receivers.empty()) result.receivers.push_back({Vec3<T>(-far, -far, T(0)), Vec3<T>(far, far, far)});
    for (const Box3<T>& c : result.casters) {
        T hidden = T(0);
        for (std::size_t r = 0; r < result.receivers.size() && hidden < T(1); ++r)
            hidden = std::max(hidden, occlusion_limit(c, result.receivers[r], result.light));
        result.hidden.push_back(hidden);
    }
    return result;
}

}  // namespace penumbra
