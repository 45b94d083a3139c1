#include <penumbra/umbra_volume/shadow.hpp>
#include <string>

#include "../settings.hpp"

namespace penumbra::study {
namespace {

using Options = UmbraVolumeOptions;

std::string name_of(DiskOverlap overlap, int bitmask_size) {
    switch (overlap) {
        case DiskOverlap::additive:
            return "additive";
        case DiskOverlap::maximum:
            return "maximum";
        case DiskOverlap::product:
            return "product";
        case DiskOverlap::exact:
            return "exact";
        case DiskOverlap::bitmask:
            break;
    }
    return "bitmask_" + std::to_string(bitmask_size);
}

const char* name_of(CutVisibility visibility) {
    switch (visibility) {
        case CutVisibility::cubic:
            return "cubic";
        case CutVisibility::square_root:
            return "square_root";
        case CutVisibility::exact:
            break;
    }
    return "exact";
}

/// Those that matter to the mode.
nlohmann::ordered_json knobs_of(const Options& o) {
    if (o.mode == DiskMode::edge_sum) return {{"mode", "edge_sum"}, {"overlap", name_of(o.overlap, o.bitmask_size)}};
    return {{"mode", "d_buffer"},
            {"layers", o.layers},
            {"share", o.share == CutShare::edge ? "t_from_edge" : "t_from_depths"},
            {"visibility", name_of(o.visibility)},
            {"silhouette", o.silhouette == VolumeSilhouette::disk ? "from_disk" : "from_light_center"},
            {"resolution", o.resolution}};
}

Setting setting(const Options& options, const std::string& special = "") {
    const nlohmann::ordered_json knobs = knobs_of(options);
    Setting made = make_setting<UmbraVolumeShadow<float>, DiskLight<float>>("umbra_volume", knobs,
                                                                            knobs == knobs_of(Options()), options);
    made.special = special;
    return made;
}

Options edge_sum(DiskOverlap overlap, int bitmask_size) {
    Options options;
    options.mode = DiskMode::edge_sum, options.overlap = overlap, options.bitmask_size = bitmask_size;
    return options;
}

/// The most accurate that one or two layers get.
Options d_buffer(int layers, int resolution = Options().resolution) {
    Options options;
    options.mode = DiskMode::d_buffer, options.layers = layers, options.resolution = resolution;
    return options;
}

Options paper() {
    Options options = d_buffer(1, 512);
    options.share = CutShare::depths, options.visibility = CutVisibility::cubic;
    return options;
}

Options from_light_center(Options options) {
    options.silhouette = VolumeSilhouette::light_center;
    return options;
}

}  // namespace

std::vector<Setting> umbra_volume_settings(Sweep sweep) {
    std::vector<Setting> all = {setting(Options())};
    if (sweep == Sweep::one) return all;
    const auto add = [&](const Setting& one) { add_new(all, one); };
    add(setting(paper(), "the paper"));
    add(setting(d_buffer(2), "two layers"));
    add(setting(from_light_center(d_buffer(2))));
    add(setting(edge_sum(DiskOverlap::additive, 32)));
    if (sweep == Sweep::few) return all;
    for (const DiskOverlap overlap : {DiskOverlap::maximum, DiskOverlap::product}) add(setting(edge_sum(overlap, 32)));
    for (const int size : {8, 16, 32}) add(setting(edge_sum(DiskOverlap::bitmask, size)));
    add(setting(d_buffer(1)));
    for (const int resolution : {256, 512, 2048}) add(setting(d_buffer(2, resolution)));
    const auto add_to_paper = [&](auto&& change) {
        Options options = paper();
        change(options);
        add(setting(options));
    };
    add_to_paper([](Options& o) { o.layers = 2; });
    add_to_paper([](Options& o) { o.share = CutShare::edge; });
    add_to_paper([](Options& o) { o.silhouette = VolumeSilhouette::light_center; });
    for (const CutVisibility visibility : {CutVisibility::exact, CutVisibility::square_root})
        add_to_paper([&](Options& o) { o.visibility = visibility; });
    return all;
}

VolumeFigure volume_figure(int resolution) {
    const Options two = d_buffer(2, resolution);
    return {setting(Options()), setting(d_buffer(1, resolution)), setting(two), setting(from_light_center(two))};
}

}  // namespace penumbra::study
