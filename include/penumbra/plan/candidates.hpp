// What each method may leave out of a scene, and what is lost at most.
//
// What a caster hides is limited by its box; what a method that counts overlaps twice takes for it, by that times the
// number of faces. Of methods by images no more is known than that nothing is lost where nothing is hidden.
#pragma once

#include <cstddef>
#include <penumbra/mesh.hpp>
#include <penumbra/occlusion_texture/options.hpp>
#include <penumbra/penumbra_wedge/options.hpp>
#include <penumbra/plan/candidate_search.hpp>
#include <penumbra/plan/covers_once.hpp>
#include <penumbra/plan/slice_candidates.hpp>
#include <penumbra/soft_shadow_map/options.hpp>
#include <penumbra/umbra_volume/options.hpp>

namespace penumbra::detail {

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

inline bool are_exact(const PenumbraWedgeOptions& options) { return options.overlap == OverlapRule::exact; }
/// Whether overlaps are left out point by point.
inline bool decides_at_points(const PenumbraWedgeOptions& options) {
    return options.overlap == OverlapRule::bitmask || are_exact(options);
}

template <class T>
void find_candidates(const PenumbraWedgeOptions& full, CandidateSearch<T>& search) {
    if (decides_at_points(full)) find_overlap(search);
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
// --- umbra volumes ------------------------------------------------------------------------------------------------

inline bool are_exact(const UmbraVolumeOptions& options) {
    return options.mode == DiskMode::edge_sum && options.overlap == DiskOverlap::exact;
}
inline bool decides_at_points(const UmbraVolumeOptions& options) {
    return are_exact(options) || (options.mode == DiskMode::edge_sum && options.overlap == DiskOverlap::bitmask);
}

template <class T>
void find_candidates(const UmbraVolumeOptions& full, CandidateSearch<T>& search) {
    if (full.mode == DiskMode::edge_sum) {
        if (decides_at_points(full)) find_overlap(search);
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
