// What each method may leave out of a scene, and what is lost at most.
//
// What a caster hides is limited by its box; what a method that counts overlaps twice takes for it, by that times the
// number of faces. Of methods by images no more is known than that nothing is lost where nothing is hidden.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/mesh.hpp>
#include <penumbra/occlusion_texture/options.hpp>
#include <penumbra/occlusion_texture/slices.hpp>
#include <penumbra/penumbra_wedge/options.hpp>
#include <penumbra/plan/scene_extents.hpp>
#include <penumbra/plan/selection.hpp>
#include <penumbra/soft_shadow_map/options.hpp>
#include <penumbra/umbra_volume/options.hpp>
#include <vector>

namespace penumbra::detail {

/// Casters and what is known of them, and the candidates that are found.
template <class T>
struct CandidateSearch {
    const std::vector<Mesh<T>>& casters;
    const SceneExtents<T>& extents;
    T budget;  ///< of what has a budget of its own
    std::vector<Candidate<T>> found;

    void add(Effect effect, T loss, const char* reason, T number) { found.push_back({effect, loss, reason, number}); }
    /// An effect of a method by images, without which they are as wrong as can be where there is a shadow.
    void add_of_images(Effect effect) {
        const T total = extents.total_hidden();
        add(effect, total > T(0) ? T(1) : T(0), "casters together hide up to %s of the light from a receiver", total);
    }
};

/// Whether a mesh covers no part of a light twice, seen from anywhere, if that is cheaply known: a triangle, a planar
/// quad of two, a welded convex solid of a few faces, each of which is tried against every vertex.
template <class T>
bool covers_once(const Mesh<T>& mesh) {
    constexpr std::size_t most_faces = 32;
    const std::size_t faces = mesh.triangles.size(), vertices = mesh.positions.size();
    if (faces <= 1) return true;
    const bool quad = faces == 2 && vertices == 4;
    if (!quad && (faces > most_faces || faces + 4 != 2 * vertices)) return false;
    // every edge runs both ways, or for a quad one does: differences of hashes of edges cancel
    const auto hash = [](std::uint64_t a, std::uint64_t b) {
        const std::uint64_t mixed = (a * 0x9e3779b97f4a7c15U) ^ (b * 0xc2b2ae3d27d4eb4fU + 0x165667b19e3779f9U);
        return (mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9U;
    };
    std::uint64_t open = 0;
    bool outwards = true, inwards = true;
    Vec3<T> first_normal(T(0), T(0), T(0));
    for (const glm::uvec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) open += hash(t[k], t[(k + 1) % 3]) - hash(t[(k + 1) % 3], t[k]);
        const Vec3<T>& a = mesh.positions[t.x];
        const Vec3<T> normal =
            normalize_or(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a), Vec3<T>(T(0), T(0), T(0)));
        T low = T(0), high = T(0), size = T(0);
        for (const Vec3<T>& p : mesh.positions) {
            const T away = glm::dot(normal, p - a);
            low = std::min(low, away), high = std::max(high, away);
            size = std::max(size, largest_component(glm::abs(p)));
        }
        const T slack = T(16) * std::numeric_limits<T>::epsilon() * size;
        outwards = outwards && high <= slack, inwards = inwards && low >= -slack;
        if (quad && glm::dot(normal, first_normal) < T(0)) return false;
        first_normal = normal;
    }
    return quad ? outwards && inwards : open == 0 && (outwards || inwards);
}

/// The most that a sum over edges takes a caster to hide: every face may cover the same part of the light.
template <class T>
T counted(const Mesh<T>& caster, T hidden) {
    return hidden > T(0) && !covers_once(caster) ? saturate(hidden * static_cast<T>(caster.triangles.size())) : hidden;
}

/// By how much casters seen before each other, or before themselves, are counted twice at most.
template <class T>
void find_overlap(CandidateSearch<T>& search) {
    std::size_t pairs = 0, folded = 0;
    const T apart = search.extents.total_overlap(pairs);
    T loss = apart;
    for (std::size_t i = 0; i < search.casters.size() && loss < T(1); ++i) {
        if (!(search.extents.hidden[i] > T(0)) || covers_once(search.casters[i])) continue;
        ++folded;
        loss += counted(search.casters[i], search.extents.hidden[i]);
    }
    if (apart > T(0))
        search.add(Effect::overlap, saturate(loss),
                   "%s pairs of casters may hide the same of the light from a receiver", static_cast<T>(pairs));
    else if (folded > 0)
        search.add(Effect::overlap, saturate(loss),
                   "no two casters hide the same of the light, but %s may hide it twice", static_cast<T>(folded));
    else
        search.add(Effect::overlap, T(0), "no two of %s casters hide the same of the light from any receiver",
                   static_cast<T>(search.casters.size()));
}

// --- penumbra wedges ----------------------------------------------------------------------------------------------

template <class T>
void find_candidates(const PenumbraWedgeOptions& full, CandidateSearch<T>& search) {
    if (full.overlap == OverlapRule::bitmask) find_overlap(search);
    if (full.silhouette == SilhouetteFrom::light_center) return;
    T loss = T(0);
    for (std::size_t i = 0; i < search.casters.size(); ++i)
        loss += search.extents.hidden[i] * static_cast<T>(search.casters[i].triangles.size());
    search.add(Effect::silhouettes_per_point, saturate(loss),
               "casters together hide up to %s of the light from a receiver", search.extents.total_hidden());
}
inline void leave_out(Effect effect, PenumbraWedgeOptions& options) {
    if (effect == Effect::overlap) options.overlap = OverlapRule::additive;
    if (effect == Effect::silhouettes_per_point) options.silhouette = SilhouetteFrom::light_center;
}
inline bool decides_at_points(const PenumbraWedgeOptions& options) { return options.overlap == OverlapRule::bitmask; }

// --- umbra volumes ------------------------------------------------------------------------------------------------

template <class T>
void find_candidates(const UmbraVolumeOptions& full, CandidateSearch<T>& search) {
    if (full.mode == DiskMode::edge_sum) {
        if (full.overlap == DiskOverlap::bitmask) find_overlap(search);
        return;
    }
    if (full.layers == 2) search.add_of_images(Effect::second_layer);
    if (full.silhouette == VolumeSilhouette::disk) search.add_of_images(Effect::volume_silhouette);
}
inline void leave_out(Effect effect, UmbraVolumeOptions& options) {
    if (effect == Effect::overlap) options.overlap = DiskOverlap::additive;
    if (effect == Effect::second_layer) options.layers = 1;
    if (effect == Effect::volume_silhouette) options.silhouette = VolumeSilhouette::light_center;
}
inline bool decides_at_points(const UmbraVolumeOptions& options) {
    return options.mode == DiskMode::edge_sum && options.overlap == DiskOverlap::bitmask;
}

// --- soft shadow maps ---------------------------------------------------------------------------------------------

template <class T>
bool is_level(const Box3<T>& box) {
    return box.max.z > T(0) && box.max.z - box.min.z <= T(1e-4) * box.max.z;
}
template <class T>
void find_candidates(const SoftShadowMapOptions& full, CandidateSearch<T>& search) {
    if (full.most_samples > full.samples) {
        const bool exact = full.mode == LinearMode::intervals || full.mode == LinearMode::interval_mask;
        // parallel to the light, so that no texel holds much of its depth
        const bool level = search.casters.size() == 1 && search.casters[0].triangles.size() <= 2 &&
                           covers_once(search.casters[0]) && is_level(search.extents.casters[0]);
        if (exact && level)
            search.add(Effect::extra_samples, T(0), "of %s flat convex caster two samples see all that it hides", T(1));
        else
            search.add_of_images(Effect::extra_samples);
    }
    if (full.mode == LinearMode::skins && full.transition != SkinTransition::linear)
        search.add_of_images(Effect::exact_transition);
}
inline void leave_out(Effect effect, SoftShadowMapOptions& options) {
    if (effect == Effect::extra_samples) options.most_samples = 0, options.narrowest_gap = false;
    if (effect == Effect::exact_transition) options.transition = SkinTransition::linear;
}
inline bool decides_at_points(const SoftShadowMapOptions&) { return false; }

// --- occlusion textures -------------------------------------------------------------------------------------------

/// The slices that casters fall into, for `count` of them over the same depths.
template <class T>
class SliceLayout {
  public:
    SliceLayout(const SceneExtents<T>& extents, int count) : range_{T(0), T(0), count} {
        T nearest = std::numeric_limits<T>::max(), farthest = T(0);
        for (const Box3<T>& c : extents.casters) {
            if (is_empty(c) || !(c.max.z > T(0))) continue;
            nearest = std::min(nearest, std::max(c.min.z, T(0))), farthest = std::max(farthest, c.max.z);
        }
        if (!(farthest > T(0))) return;
        const T slices = static_cast<T>(count), length = std::max(farthest - nearest, farthest * T(1e-5) * slices);
        const T lead = length * T(1.0 / 4096.0);
        range_ = {nearest - lead, (length + lead) / slices, count};
    }
    /// The slice that holds all of a caster, with room for what rounding does to either; −1 if none surely does.
    int slice_of(const Box3<T>& caster) const {
        const T room = range_.thickness * T(0.02);
        const int first = range_.slice_of(caster.min.z - room), last = range_.slice_of(caster.max.z + room);
        return first == last ? first : -1;
    }
    const SliceRange<T>& range() const { return range_; }
    T plane(int slice, SlicePlane plane) const {
        return range_.top(slice) + range_.thickness * (plane == SlicePlane::middle ? T(0.5) : T(1));
    }
    /// From which depth on no slice holds a point, by any rule for those that do.
    T passed_depth() const { return range_.bottom(range_.count - 1) + T(2) * range_.thickness; }

  private:
    SliceRange<T> range_;
};

/// Occlusion textures, in a scene.
template <class T>
class SliceCandidates {
  public:
    SliceCandidates(const OcclusionTextureOptions& full, CandidateSearch<T>& search)
        : full_(full), search_(search), extents_(search.extents), fine_(extents_, full.slices) {
        for (const Box3<T>& r : extents_.receivers)
            if (r.max.z > T(0)) nearest_ = std::min(nearest_, std::max(r.min.z, T(0)));
    }

    /// A point behind all slices asks for no depths.
    void find_self_shadow() {
        const T behind = nearest_ - fine_.passed_depth();
        if (behind >= T(0))
            search_.add(Effect::self_shadow, T(0), "receivers lie at least %s behind what a slice may hold", behind);
        else
            search_.add_of_images(Effect::self_shadow);
    }
    /// If all casters lie in one slice, a copy in the next is the same on another plane; in the last there is none.
    void find_leak_closing() {
        const int layer = only_layer(fine_);
        const bool has_copy = layer + 1 < full_.slices;
        if (layer >= 0)
            search_.add(Effect::leak_closing, has_copy ? moved_loss(plane(layer), plane(layer + 1)) : T(0),
                        "all casters lie in slice %s", static_cast<T>(layer));
        else
            search_.add_of_images(Effect::leak_closing);
    }
    /// Fewer slices change nothing but the planes that casters are projected on, if each lies in one slice and those of
    /// different slices stay in different ones: the fewest of which that holds within the budget.
    void find_slices() {
        for (int count = 1; count < full_.slices; ++count) {
            const SliceLayout<T> coarse(extents_, count);
            const T loss = nearest_ >= coarse.passed_depth() ? loss_of(coarse) : T(1);
            if (loss > search_.budget) continue;
            search_.add(Effect::slices, loss, "%s hold all layers of casters, each in its own", static_cast<T>(count));
            search_.found.back().has_own_budget = true;
            return;
        }
        search_.add(Effect::slices, T(1), "casters reach through slices: none of %s can be spared",
                    static_cast<T>(full_.slices));
    }

  private:
    T plane(int slice) const { return fine_.plane(slice, full_.plane); }

    int only_layer(const SliceLayout<T>& layout) const {
        int layer = -1;
        for (std::size_t i = 0; i < extents_.casters.size(); ++i) {
            const int slice = layout.slice_of(extents_.casters[i]);
            if (slice < 0 || (i > 0 && slice != layer)) return -1;
            layer = slice;
        }
        return layer;
    }

    /// The change of a mean over a part of the kernel, on a plane that moves from depth `a` to depth `b`.
    T moved_loss(T a, T b) const {
        const T cells = static_cast<T>(full_.light_cells);
        T worst = T(0);
        for (const Box3<T>& r : extents_.receivers) {
            const T moved = std::abs(b - a) / r.min.z, most = std::max(a, b) / r.min.z;
            if (!(r.min.z > T(0)) || !(most < T(1))) return T(1);
            T loss = T(0);
            for (int k = 0; k < 2; ++k) {
                const T h = extents_.light.half_size[k];
                const T out = std::max(std::abs(r.min[k]), std::abs(r.max[k])) + h;
                loss += saturated_ratio((out * cells + T(2) * h) * moved, T(2) * h * (T(1) - most));
            }
            worst = std::max(worst, saturate(loss));
        }
        return worst;
    }
    T loss_of(const SliceLayout<T>& coarse) const {
        if (full_.blend.close_leaks) {  // copies would meet other layers
            const int before = only_layer(fine_), after = only_layer(coarse);
            if (before < 0 || after < 0) return T(1);
            T loss = T(0);
            for (int i = before; i <= std::min(before + 1, full_.slices - 1); ++i)
                for (int j = after; j <= std::min(after + 1, coarse.range().count - 1); ++j)
                    loss = std::max(loss, moved_loss(plane(i), coarse.plane(j, full_.plane)));
            return loss;
        }
        std::vector<int> held(static_cast<std::size_t>(coarse.range().count), -1);
        T loss = T(0);
        for (const Box3<T>& c : extents_.casters) {
            const int before = fine_.slice_of(c), after = coarse.slice_of(c);
            if (before < 0 || after < 0) return T(1);
            int& holder = held[static_cast<std::size_t>(after)];
            if (holder >= 0 && holder != before) return T(1);
            if (holder < 0) loss += moved_loss(plane(before), coarse.plane(after, full_.plane));
            holder = before;
        }
        return loss;
    }

    const OcclusionTextureOptions& full_;
    CandidateSearch<T>& search_;
    const SceneExtents<T>& extents_;
    SliceLayout<T> fine_;
    T nearest_ = std::numeric_limits<T>::max();
};

template <class T>
void find_candidates(const OcclusionTextureOptions& full, CandidateSearch<T>& search) {
    SliceCandidates<T> slices(full, search);
    if (full.self_shadow == SelfShadow::mean_depth) slices.find_self_shadow();
    if (full.blend.close_leaks) slices.find_leak_closing();
    if (full.slices > 1) slices.find_slices();
}
inline void leave_out(Effect effect, OcclusionTextureOptions& options) {
    if (effect == Effect::self_shadow) options.self_shadow = SelfShadow::fade;
    if (effect == Effect::leak_closing) options.blend.close_leaks = false;
}
inline bool decides_at_points(const OcclusionTextureOptions&) { return false; }

}  // namespace penumbra::detail
