#include <penumbra/penumbra_wedge/shadow.hpp>
#include <string>

#include "../settings.hpp"

namespace penumbra::study {
namespace {

using Options = PenumbraWedgeOptions;

std::string name_of(const Options& options) {
    switch (options.overlap) {
        case OverlapRule::additive:
            return "additive";
        case OverlapRule::maximum:
            return "maximum";
        case OverlapRule::product:
            return "product";
        case OverlapRule::product_quadrants:
            return "product_quadrants";
        case OverlapRule::rectangles:
            return "rectangles";
        case OverlapRule::rectangles_centroid:
            return "rectangles_centroid";
        case OverlapRule::rectangle_product:
            return "rectangle_product";
        case OverlapRule::exact:
            return "exact";
        case OverlapRule::bitmask:
            break;
    }
    return "bitmask_" + std::to_string(options.bitmask_size);
}

Setting setting(const Options& options) {
    const auto knobs_of = [](const Options& o) {
        return nlohmann::ordered_json{
            {"overlap", name_of(o)},
            {"silhouette", o.silhouette == SilhouetteFrom::point ? "per_point" : "from_light_center"}};
    };
    const nlohmann::ordered_json knobs = knobs_of(options);
    return make_setting<PenumbraWedgeShadow<float>, RectLight<float>>("penumbra_wedge", knobs,
                                                                      knobs == knobs_of(Options()), options);
}

Setting setting(OverlapRule rule, SilhouetteFrom from, int bitmask_size = 32) {
    Options options;
    options.overlap = rule, options.silhouette = from, options.bitmask_size = bitmask_size;
    return setting(options);
}

}  // namespace

std::vector<Setting> penumbra_wedge_settings(Sweep sweep) {
    std::vector<Setting> all = {setting(Options())};
    if (sweep == Sweep::one) return all;
    const auto add = [&](const Setting& one) { add_new(all, one); };
    for (const SilhouetteFrom from : {SilhouetteFrom::point, SilhouetteFrom::light_center}) {
        for (const OverlapRule rule :
             {OverlapRule::additive, OverlapRule::maximum, OverlapRule::product, OverlapRule::product_quadrants,
              OverlapRule::rectangles, OverlapRule::rectangles_centroid, OverlapRule::rectangle_product}) {
            const bool in_paper = rule == OverlapRule::additive || rule == OverlapRule::rectangles;
            if (sweep == Sweep::all || (in_paper && from == SilhouetteFrom::light_center)) add(setting(rule, from));
        }
        for (const int size : {8, 16, 32})
            if (sweep == Sweep::all || size == 32) add(setting(OverlapRule::bitmask, from, size));
        if (sweep == Sweep::all) add(setting(OverlapRule::exact, from));
    }
    return all;
}

WedgeFigure wedge_figure() {
    return {setting(OverlapRule::additive, SilhouetteFrom::light_center),
            setting(OverlapRule::rectangles, SilhouetteFrom::light_center), setting(Options())};
}

}  // namespace penumbra::study
