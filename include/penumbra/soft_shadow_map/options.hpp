// What can be chosen about soft shadow maps.
#pragma once

#include <penumbra/detail/error.hpp>
#include <penumbra/numeric.hpp>
#include <string>

namespace penumbra {

/// What decides how much of a line light a point sees.
enum class LinearMode {
    hard,           ///< the share of maps that see the point: plain shadow maps
    skins,          ///< what skins between the maps leave: the paper
    intervals,      ///< the union of what surfaces in all maps hide, exactly
    interval_mask,  ///< the same by 128 cells of the light: no sorting
};

/// How visibility changes across a skin.
enum class SkinTransition {
    linear,    ///< in the image: the paper
    rational,  ///< eq. 1, with a straight receiver between the depths under both ends
    exact      ///< by the edge itself, from the point: needs no receivers
};

/// What tells surfaces apart.
enum class StepDetector {
    slope_aware,  ///< is_step: steep surfaces are one surface
    laplacian     ///< is_laplacian_step: the paper
};

struct SoftShadowMapOptions {
    LinearMode mode = LinearMode::intervals;
    int resolution = 1024;  ///< texels along a side of each map, 1 to 16384

    // where on the light maps are
    int samples = 2;             ///< at first, evenly from end to end; 2 to 64
    int most_samples = 9;        ///< up to how many are inserted where they are needed; `samples` and less inserts none
    float tolerance = 0.01F;     ///< RMS of visibility, over what is in shadow, up to which nothing is inserted; > 0
    bool narrowest_gap = false;  ///< at first as many samples as see through every gap, up to most_samples

    // discontinuities and skins
    float step = 0.0F;  ///< world units: the least between two surfaces; 0: 1/1000 of the farthest caster's depth
    StepDetector detector = StepDetector::slope_aware;
    SkinTransition transition = SkinTransition::exact;
};

/// Reports the first option out of its domain by name and value. True if there is none.
inline bool validate(const SoftShadowMapOptions& options) {
    const auto report = [](const char* name, const std::string& value, const char* domain) {
        return detail::require(false,
                               [&] { return std::string("options.") + name + " = " + value + " is not " + domain; });
    };
    if (options.resolution < 1 || options.resolution > 16384)
        return report("resolution", std::to_string(options.resolution), "from 1 to 16384");
    if (options.samples < 2 || options.samples > 64)
        return report("samples", std::to_string(options.samples), "from 2 to 64");
    if (options.most_samples > 64) return report("most_samples", std::to_string(options.most_samples), "at most 64");
    if (!is_finite(options.tolerance) || !(options.tolerance > 0.0F))
        return report("tolerance", detail::text(static_cast<double>(options.tolerance)), "a finite number above 0");
    if (!is_finite(options.step) || !(options.step >= 0.0F))
        return report("step", detail::text(static_cast<double>(options.step)), "a finite number ≥ 0");
    return true;
}

}  // namespace penumbra
