#include "drawing.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "error.hpp"
#include "progress.hpp"
#include "scene_pictures.hpp"

namespace penumbra::study {
namespace {

constexpr double longest_picture = 8.0;  // seconds

const Candidate* find(const std::vector<Candidate>& candidates, const Setting& setting) {
    for (const Candidate& candidate : candidates)
        if (candidate.row.method == setting.method && candidate.row.knobs == setting.knobs) return &candidate;
    return nullptr;
}

/// The default and the best setting of each method, and those that are special.
void draw_settings(const ScenePictures& pictures, const std::vector<Candidate>& candidates, Study& study) {
    for (const Candidate& candidate : candidates) {
        const Row& row = candidate.row;
        const Row* best = best_row(study, row.scene, row.method);
        const bool is_best = best && best->knobs == row.knobs;
        std::string special = row.is_default ? "default" : candidate.special;
        if (is_best) special += special.empty() ? "best setting" : ", the best setting";
        if (special.empty()) continue;
        if (pictures.seconds(row) > longest_picture) {
            fmt::print(stderr, "{}: no picture of {}, it would take {:.0f} s\n", row.scene, row.method,
                       pictures.seconds(row));
            continue;
        }
        study.pictures.push_back(pictures.draw(row, candidate.built, special));
    }
}

/// Plain wedges beside blended ones where silhouettes overlap: Figures 1 and 2 of Forest, Barthe & Paulin.
void draw_wedges(const ScenePictures& pictures, const Measured& measured, const std::vector<Candidate>& candidates,
                 Study& study) {
    const WedgeFigure figure = wedge_figure();
    const Candidate *plain = find(candidates, figure.plain), *blended = find(candidates, figure.blended);
    if (!plain || !blended) return;
    if (pictures.seconds(plain->row) + pictures.seconds(blended->row) > longest_picture) return;
    const auto shown = [&](const char* name, const Candidate& candidate) -> Shown {
        return {fmt::format("{}\nRMSE {:.3f} where silhouettes overlap", name, candidate.row.overlap_rmse),
                ask(candidate.built, measured.view.points)};
    };
    const SceneInfo& info = measured.info;
    const double before = plain->row.overlap_rmse, after = blended->row.overlap_rmse;
    const std::string caption = fmt::format(
        "Plain wedges, wedges blended as by Forest, Barthe & Paulin, and the truth. At the {} of {} points from which "
        "silhouettes overlap, RMSE is {:.4f} and {:.4f}{}.",
        with_commas(info.overlap_points), with_commas(info.points), before, after,
        after > 0.0 ? fmt::format(", {}× lower", digits(before / after)) : "");
    study.triplets.push_back(pictures.triplet(
        {shown("plain wedges", *plain), shown("blended wedges", *blended), pictures.truth()}, caption));
}

/// Two samples by the paper beside ten rays a point: Figure 9 of Heidrich, Brabec & Seidel.
void draw_line(const ScenePictures& pictures, const Measured& measured, const std::vector<Candidate>& candidates,
               Study& study) {
    constexpr int rays = 10;
    constexpr std::uint32_t seed = 9;  // not the truth's
    const Candidate* paper = find(candidates, line_figure().paper);
    if (!paper) return;
    const auto traced = [&](const Points& points) {
        return trace(measured.traced, measured.scene, points, rays, seed);
    };
    const double paper_rmse = paper->row.rmse, rays_rmse = compare(traced(measured.points), measured.truth).rmse;
    const std::string caption = fmt::format(
        "The truth; two samples of the light with skins between them, as by Heidrich, Brabec & Seidel; and ten "
        "stratified rays a point. RMSE of the two samples is {:.4f}, of the ten rays {:.4f}.",
        paper_rmse, rays_rmse);
    const auto title = [](const char* name, double rmse) { return fmt::format("{}\nRMSE {:.4f}", name, rmse); };
    study.triplets.push_back(pictures.triplet(
        {pictures.truth(),
         {title("two samples, skins (the paper)", paper_rmse), ask(paper->built, measured.view.points)},
         {title("ten rays a point", rays_rmse), traced(measured.view.points)}},
        caption));
}

/// Where umbra and penumbra begin by volumes from the disk and from its centre.
void draw_parts(const ScenePictures& pictures, const Measured& measured, const std::vector<Candidate>& candidates,
                Study& study) {
    const VolumeFigure figure = volume_figure();
    const Candidate *disk = find(candidates, figure.two_layers), *center = find(candidates, figure.from_light_center);
    if (!disk || !center) return;
    study.parts.push_back(
        pictures.parts(measured.traced, {{"D-buffer, volumes from the disk", &disk->built},
                                         {"D-buffer, volumes from the light's centre", &center->built}}));
}

}  // namespace

void draw(const Measured& measured, const std::vector<Candidate>& candidates, const std::filesystem::path& folder,
          Study& study) {
    const Scene& scene = measured.scene;
    say(scene.name, "pictures");
    const ScenePictures pictures(scene, measured.view,
                                 trace(measured.traced, scene, measured.view.points, measured.effort.picture_rays),
                                 folder);
    draw_settings(pictures, candidates, study);
    if (scene.subject == Subject::overlap && measured.info.overlap_points > 0)
        draw_wedges(pictures, measured, candidates, study);
    if (scene.subject == Subject::volumes && scene.casters.size() == 1)
        draw_parts(pictures, measured, candidates, study);
    if (scene.subject == Subject::lines) draw_line(pictures, measured, candidates, study);
}

}  // namespace penumbra::study
