#include <cmath>
#include <penumbra/occlusion_texture/shadow.hpp>

#include "../settings.hpp"

namespace penumbra::study {
namespace {

using Options = OcclusionTextureOptions;

const char* name_of(SliceFilter filter) {
    switch (filter) {
        case SliceFilter::mipmap:
            return "mipmap";
        case SliceFilter::n_buffer:
            return "n_buffer";
        case SliceFilter::summed_area:
            break;
    }
    return "summed_area";
}

const char* name_of(Combination rule) {
    switch (rule) {
        case Combination::product:
            return "product";
        case Combination::sum:
            return "sum";
        case Combination::max:
            return "max";
        case Combination::mean:
            break;
    }
    return "mean";
}

const char* name_of(SelfShadow mode) {
    switch (mode) {
        case SelfShadow::fade:
            return "fade";
        case SelfShadow::clear:
            return "clear";
        case SelfShadow::mean_depth:
            break;
    }
    return "mean_depth";
}

const char* name_of(SliceFaces faces) {
    switch (faces) {
        case SliceFaces::solid:
            return "solid";
        case SliceFaces::all:
            return "all";
        case SliceFaces::facing:
            break;
    }
    return "facing";
}

nlohmann::ordered_json knobs_of(const Options& o) {
    return {{"slices", o.slices},
            {"cells", o.light_cells},
            {"filter", name_of(o.filter)},
            {"combination", name_of(o.blend.combination)},
            {"closing", o.blend.close_leaks},
            {"plane", o.plane == SlicePlane::middle ? "middle" : "bottom"},
            {"faces", name_of(o.faces)},
            {"projection", o.projection == SliceProjection::perspective ? "perspective" : "orthographic"},
            {"self_shadow", name_of(o.self_shadow)},
            {"bias", std::round(static_cast<double>(o.self_shadow_bias) * 1e4) / 1e4},
            {"resolution", o.resolution}};
}

class Settings {
  public:
    /// Adds a setting unless it is there already.
    void add(const Options& options) {
        const nlohmann::ordered_json knobs = knobs_of(options);
        for (const Setting& setting : settings)
            if (setting.knobs == knobs) return;
        settings.push_back(make_setting<OcclusionTextureShadow<float>, RectLight<float>>(
            "occlusion_texture", knobs, knobs == knobs_of(Options()), options));
    }
    template <class Change>
    void add(Options options, Change&& change) {
        change(options);
        add(options);
    }

    std::vector<Setting> settings;
};

}  // namespace

std::vector<Setting> occlusion_texture_settings(Sweep sweep) {
    Settings all;
    all.add(Options());
    if (sweep == Sweep::one) return all.settings;
    const bool quick = sweep == Sweep::few;
    // slices × rule × closing
    for (const int slices : {4, 8, 16, 32}) {
        for (const SliceBlend blend :
             {SliceBlend::scattered(), SliceBlend::unknown(), SliceBlend::connected(), SliceBlend::disjoint(),
              SliceBlend{Combination::max, false}, SliceBlend{Combination::product, true}}) {
            const bool main_line = blend.close_leaks == (blend.combination == Combination::max);
            if (quick && (!main_line || slices == 4 || slices == 32)) continue;
            all.add({}, [&](Options& o) { o.slices = slices, o.blend = blend; });
        }
    }
    for (const SliceBlend blend : {SliceBlend::scattered(), SliceBlend::connected()}) {
        for (const int slices : {8, 12, 16, 32}) {
            if (quick && slices != 8) continue;
            Options base;
            base.blend = blend;
            base.slices = slices;
            all.add(base, [](Options& o) { o.self_shadow_bias = 0.25F, o.light_cells = 4; });
            if (slices == 12) continue;
            for (const int cells : {1, 4}) all.add(base, [&](Options& o) { o.light_cells = cells; });
            if (slices != 32)
                for (const SliceFilter filter : {SliceFilter::mipmap, SliceFilter::n_buffer})
                    all.add(base, [&](Options& o) { o.filter = filter; });
            if (quick) continue;
            for (const float bias : {0.1F, 0.25F}) all.add(base, [&](Options& o) { o.self_shadow_bias = bias; });
            all.add(base, [](Options& o) { o.resolution = 256; });
            if (slices == 32) continue;
            all.add(base, [](Options& o) { o.plane = SlicePlane::bottom; });
            for (const SliceFaces faces : {SliceFaces::all, SliceFaces::facing})
                all.add(base, [&](Options& o) { o.faces = faces; });
            all.add(base, [](Options& o) { o.self_shadow = SelfShadow::fade; });
            all.add(base, [](Options& o) { o.self_shadow = SelfShadow::clear; });
        }
    }
    // for foliage: few slices, little bias
    const auto foliage = [&](int slices, int cells, int resolution, float bias) {
        all.add({}, [&](Options& o) {
            o.slices = slices, o.light_cells = cells, o.resolution = resolution, o.self_shadow_bias = bias;
            o.blend = SliceBlend::scattered();
        });
    };
    foliage(2, 2, 1024, 0.01F);
    if (quick) return all.settings;
    for (const int slices : {4, 6}) {
        for (const int cells : {1, 2}) foliage(slices, cells, 256, 0.1F);
        for (const int resolution : {512, 640}) foliage(slices, 2, resolution, 0.02F);
    }
    foliage(2, 2, 768, 0.01F);
    foliage(5, 2, 512, 0.02F);
    foliage(6, 3, 1024, 0.02F);
    all.add({}, [](Options& o) { o.resolution = 1024; });
    all.add({}, [](Options& o) { o.projection = SliceProjection::orthographic; });
    // the paper: one cell, all faces, bottom planes, N-Buffers, probabilities, fade
    for (const int slices : {4, 8, 16}) {
        all.add({}, [&](Options& o) {
            o.slices = slices, o.light_cells = 1, o.plane = SlicePlane::bottom, o.filter = SliceFilter::n_buffer;
            o.faces = SliceFaces::all, o.blend = SliceBlend::scattered(), o.self_shadow = SelfShadow::fade;
        });
    }
    return all.settings;
}

}  // namespace penumbra::study
