// The knobs of occlusion-texture shadows, and what they trade.
#pragma once

#include <penumbra/combine.hpp>
#include <penumbra/detail/error.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/occlusion_texture/slices.hpp>
#include <string>

namespace penumbra {

/// How a slice's texture is averaged over a kernel.
enum class SliceFilter {
    mipmap,       ///< smallest, least exact
    n_buffer,     ///< one byte a texel and level
    summed_area,  ///< exact for every box; four bytes a texel
};

/// What the casters are like. It decides both how slices combine and whether leaks between slices are closed,
/// since closing counts a surface twice under every rule but `max`.
struct SliceBlend {
    Combination combination = Combination::product;
    bool close_leaks = false;

    /// Foliage, crowds, debris: overlaps are as random.
    static constexpr SliceBlend scattered() { return {Combination::product, false}; }
    /// Solids, one sheet, a terrain: what one slice holds goes on in the next.
    static constexpr SliceBlend connected() { return {Combination::max, true}; }
    /// Objects side by side as seen from the light.
    static constexpr SliceBlend disjoint() { return {Combination::sum, false}; }
    /// Nothing known: at most half the worst case wrong.
    static constexpr SliceBlend unknown() { return {Combination::mean, false}; }
};

struct OcclusionTextureOptions {
    static constexpr int most_slices = 64, most_texels = 16384, most_cells = 8;

    /// Equal slices of the casters' depth range, 1 to 64.
    int slices = 8;
    /// Texels along the longer side of a slice, margin included, 1 to 16384 (at least 5 are made).
    int resolution = 512;
    /// The light is split in n × n cells, 1 (the paper) to 8: slices combine within a cell, cells add up. Each doubling
    /// about halves the error of the combination rule.
    int light_cells = 2;
    SliceFilter filter = SliceFilter::summed_area;
    SliceBlend blend = SliceBlend::connected();
    SlicePlane plane = SlicePlane::middle;
    SliceFaces faces = SliceFaces::solid;
    SliceProjection projection = SliceProjection::perspective;
    SelfShadow self_shadow = SelfShadow::mean_depth;
    /// Of SelfShadow::mean_depth, in slices, 0.001 to 1. Smaller sees nearer contacts, larger hides coarse surfaces.
    float self_shadow_bias = 0.5F;
};

/// Reports an option out of its range by name and value. True if there is none.
inline bool validate(const OcclusionTextureOptions& options) {
    using Options = OcclusionTextureOptions;
    const auto number = [](auto value) { return detail::text(static_cast<double>(value)); };
    const auto in = [&](auto value, auto low, auto high, const char* name) {
        return detail::require(value >= low && value <= high, [&] {
            return std::string("options.") + name + " = " + number(value) + " is not in [" + number(low) + ", " +
                   number(high) + "]";
        });
    };
    return in(options.slices, 1, Options::most_slices, "slices") &&
           in(options.resolution, 1, Options::most_texels, "resolution") &&
           in(options.light_cells, 1, Options::most_cells, "light_cells") &&
           in(options.self_shadow_bias, 0.001F, 1.0F, "self_shadow_bias");
}

}  // namespace penumbra
