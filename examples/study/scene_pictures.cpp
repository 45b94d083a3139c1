#include "scene_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "../pictures/picture.hpp"
#include "parts.hpp"
#include "shade.hpp"

namespace penumbra::study {
ScenePictures::ScenePictures(const Scene& scene, const View& view, std::vector<float> truth,
                             std::filesystem::path folder)
    : scene_(scene), view_(view), truth_(std::move(truth)), folder_(std::move(folder)), file_(file_name(scene.name)) {
    write_png(folder_ / (file_ + "-truth.png"), shade(view_, truth_));
}

Picture ScenePictures::draw(const Row& row, const Built& built, const std::string& special) const {
    const std::vector<float> visibility = ask(built, view_.points);
    const std::string file = fmt::format("{}-{}{}", file_, row.method, row.is_default ? "" : "-" + file_name(special));
    Picture picture;
    picture.scene = scene_.name;
    picture.label = fmt::format("{}, {}", plain_name(row.method), special);
    picture.title = fmt::format("{}: {}", row.method, knobs_text(row));
    picture.method_png = file + ".png";
    picture.truth_png = file_ + "-truth.png";
    picture.difference_png = file + "-difference.png";
    picture.rmse = row.rmse;
    const Image<Rgb> shaded = shade(view_, visibility);
    write_png(folder_ / picture.method_png, shaded);
    const Image<Rgb> difference = difference_picture(image_of(view_, visibility), image_of(view_, truth_));
    write_png(folder_ / picture.difference_png, difference);
    write_png(folder_ / (file + "-panel.png"),
              side_by_side({{truth().title, shade(view_, truth_)},
                            {fmt::format("{}\nRMSE {:.4f}", picture.label, picture.rmse), shaded},
                            {"difference\nmethod − truth, of visibility", difference}}));
    return picture;
}

Shown ScenePictures::truth() const { return {scene_.name + "\nray-traced truth", truth_}; }

Triplet ScenePictures::triplet(const std::vector<Shown>& shown, const std::string& caption) const {
    std::vector<Panel> panels;
    for (const Shown& one : shown) panels.push_back({one.title, shade(view_, one.visibility)});
    const Triplet triplet{scene_.name, file_ + "-triplet.png", caption};
    write_png(folder_ / triplet.png, side_by_side(panels));
    return triplet;
}

Parts ScenePictures::parts(const reference::Scene& traced,
                           const std::vector<std::pair<std::string, const Built*>>& settings) const {
    const std::vector<Part> truth = true_parts(traced, scene_, view_, truth_);
    Parts result{scene_.name, file_ + "-parts.png", {}};
    std::vector<Panel> panels = {
        {scene_.name + "\nlight, penumbra and umbra, traced", parts_picture(view_, truth, truth)}};
    for (const auto& [name, built] : settings) {
        const std::vector<Part> parts = parts_of(ask(*built, view_.points));
        const Agreement found = agreement(name, parts, truth);
        panels.push_back({fmt::format("{}\n{:.2f} % of points right, {:.2f} % in shadow", name, 100.0 * found.all,
                                      100.0 * found.shadow),
                          parts_picture(view_, parts, truth)});
        result.agreements.push_back(found);
    }
    write_png(folder_ / result.png, side_by_side(panels));
    return result;
}

double ScenePictures::seconds(const Row& row) const {
    return row.ns_per_point * 1e-9 * static_cast<double>(view_.points.size()) /
           std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace penumbra::study
