#include <fmt/format.h>

#include <penumbra/soft_shadow_map/shadow.hpp>
#include <string>

#include "../settings.hpp"

namespace penumbra::study {
namespace {

using Options = SoftShadowMapOptions;

const char* name_of(LinearMode mode) {
    switch (mode) {
        case LinearMode::hard:
            return "hard";
        case LinearMode::skins:
            return "skins";
        case LinearMode::interval_mask:
            return "interval_mask";
        case LinearMode::intervals:
            break;
    }
    return "intervals";
}

const char* name_of(SkinTransition transition) {
    switch (transition) {
        case SkinTransition::linear:
            return "linear";
        case SkinTransition::rational:
            return "rational";
        case SkinTransition::exact:
            break;
    }
    return "exact";
}

/// Those that matter to the mode.
nlohmann::ordered_json knobs_of(const Options& o) {
    nlohmann::ordered_json knobs = {{"mode", name_of(o.mode)}, {"samples", o.samples}};
    if (o.most_samples > o.samples) {
        knobs["most_samples"] = o.most_samples;
        knobs["tolerance"] = std::stod(fmt::format("{:g}", o.tolerance));  // 0.01, not the double of 0.01F
        knobs["narrowest_gap"] = o.narrowest_gap;
    }
    if (o.mode == LinearMode::skins) {
        knobs["transition"] = name_of(o.transition);
        knobs["detector"] = o.detector == StepDetector::laplacian ? "laplacian" : "slope_aware";
    }
    knobs["resolution"] = o.resolution;
    return knobs;
}

Setting setting(const Options& options, const std::string& special = "") {
    const nlohmann::ordered_json knobs = knobs_of(options);
    Setting made = make_setting<SoftShadowMap<float>, LinearLight<float>>("soft_shadow_map", knobs,
                                                                          knobs == knobs_of(Options()), options);
    made.special = special;
    return made;
}

/// Evenly from end to end, none inserted. Maps that are kept are smaller than those that only intervals come from.
Options fixed(LinearMode mode, int samples) {
    Options options;
    options.mode = mode, options.samples = samples, options.most_samples = 0;
    if (mode == LinearMode::hard || mode == LinearMode::skins) options.resolution = 512;
    return options;
}

Options skins(SkinTransition transition, int samples) {
    Options options = fixed(LinearMode::skins, samples);
    options.transition = transition;
    return options;
}

Options inserted_skins(int most_samples) {
    Options options = skins(SkinTransition::exact, 2);
    options.most_samples = most_samples;
    return options;
}

Setting paper() { return setting(skins(SkinTransition::linear, 2), "the paper, two samples"); }

}  // namespace

std::vector<Setting> soft_shadow_map_settings(Sweep sweep) {
    std::vector<Setting> all = {setting(Options())};
    if (sweep == Sweep::one) return all;
    const auto add = [&](const Setting& one) { add_new(all, one); };
    add(paper());
    add(setting(skins(SkinTransition::exact, 2)));
    add(setting(inserted_skins(33)));
    for (const LinearMode mode : {LinearMode::skins, LinearMode::hard}) add(setting(fixed(mode, 9)));
    if (sweep == Sweep::few) return all;
    for (const int samples : {2, 3, 5, 9}) {
        for (const LinearMode mode : {LinearMode::intervals, LinearMode::interval_mask, LinearMode::hard})
            add(setting(fixed(mode, samples)));
        for (const SkinTransition transition :
             {SkinTransition::linear, SkinTransition::rational, SkinTransition::exact})
            add(setting(skins(transition, samples)));
    }
    Options laplacian = skins(SkinTransition::linear, 2), narrow = inserted_skins(64);
    laplacian.detector = StepDetector::laplacian;
    narrow.narrowest_gap = true;
    add(setting(laplacian));
    add(setting(narrow));
    for (const int resolution : {256, 512, 2048}) {
        Options options;
        options.resolution = resolution;
        add(setting(options));
    }
    return all;
}

LineFigure line_figure(int samples) {
    return {paper(), setting(fixed(LinearMode::hard, samples)), setting(skins(SkinTransition::linear, samples)),
            setting(skins(SkinTransition::exact, samples)), setting(fixed(LinearMode::intervals, samples))};
}

}  // namespace penumbra::study
