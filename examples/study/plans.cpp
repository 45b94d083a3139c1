#include "plans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <penumbra/plan.hpp>
#include <type_traits>
#include <utility>

#include "progress.hpp"
#include "rays.hpp"
#include "result.hpp"
#include "settings.hpp"
#include "shade.hpp"
#include "timing.hpp"
#include "view.hpp"

namespace penumbra::study {
namespace {

/// A type as a value.
template <class Shadow>
struct Tag {
    using type = Shadow;
};

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// The median of `count` runs of work(), in milliseconds.
template <class Work>
double median_ms(int count, const Work& work) {
    std::vector<double> ms;
    for (int i = 0; i < count; ++i) {
        const auto start = Clock::now();
        work();
        ms.push_back(seconds_since(start) * 1e3);
    }
    return median(ms);
}

/// Runs of neighbours, as many as are answered together, spread evenly over the picture: all of it unless that takes
/// long.
Points runs_of(const View& view, double ns_per_point) {
    constexpr std::size_t run = 1024;
    const std::size_t all = (view.points.size() + run - 1) / run;
    const auto affordable = static_cast<std::size_t>(0.3e9 / (ns_per_point * run)) + 1;
    const std::size_t runs = std::min(all, std::max<std::size_t>(affordable, 128));
    Points points;
    for (std::size_t k = 0; k < runs; ++k) {
        const std::size_t first = all * k / runs * run, end = std::min(first + run, view.points.size());
        points.insert(points.end(), view.points.begin() + static_cast<std::ptrdiff_t>(first),
                      view.points.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return points;
}

/// How points came by their answers, light blue, green and orange, darker in the shade.
Image<Rgb> answers_picture(const View& view, const std::vector<float>& visibility,
                           const std::vector<PointAnswer>& answers) {
    constexpr std::array<Rgb, 3> tints = {{{196, 214, 232}, {120, 200, 140}, {240, 140, 60}}};
    Image<Rgb> picture(view.width, view.height, Rgb(228, 230, 232));
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const Rgb tint = tints[static_cast<std::size_t>(answers[i])];
        const float shade = 0.45F + 0.55F * visibility[i];
        picture.data()[view.pixel[i]] = Rgb(Vec3<float>(tint) * shade);
    }
    return picture;
}

/// Every second pixel of every second line.
Image<Rgb> halved(const Image<Rgb>& picture) {
    Image<Rgb> result(picture.width() / 2, picture.height() / 2);
    for (int y = 0; y < result.height(); ++y)
        for (int x = 0; x < result.width(); ++x) result(x, y) = picture(2 * x, 2 * y);
    return result;
}

template <class Shadow>
void draw(const Scene& scene, const Shadow& full, const PlannedShadow<Shadow>& planned, const PlanRow& row,
          const std::filesystem::path& folder) {
    const View view = look(scene, 960, 720);
    const std::size_t n = view.points.size();
    std::vector<float> a(n), b(n);
    std::vector<PointAnswer> answers(n);
    in_parallel(n, [&](std::size_t first, std::size_t count) {
        full.visibility(view.points.data() + first, count, a.data() + first);
        planned.visibility(view.points.data() + first, count, b.data() + first, answers.data() + first);
    });
    std::string left_out;
    for (const auto& decision : planned.plan().decisions)
        if (!decision.simulated)
            left_out += (left_out.empty() ? "; without " : ", ") + std::string(name_of(decision.effect));
    write_png(
        folder / fmt::format("{}-{}-plan.png", row.scene, row.method),
        side_by_side(
            {{fmt::format("{}, all effects\n{} ns a point", row.scene, digits(row.full_ns)), halved(shade(view, a))},
             {fmt::format("planned, within {:g}\n{} ns a point{}", row.tolerance, digits(row.planned_ns), left_out),
              halved(shade(view, b))},
             {"who answers\nblue: nobody, all lit; green: a neighbour; orange: its own query",
              halved(answers_picture(view, b, answers))}}));
}

template <class Shadow>
PlanRow measure(const Scene& scene, const View& view, const std::string& method,
                const typename Shadow::Options& options, double tolerance, const std::filesystem::path& folder) {
    const auto& light = std::get<typename Shadow::Light>(scene.light);
    PlanSettings<Shadow> settings;
    settings.full = options;
    const auto plan_it = [&] {
        return plan_for<Shadow>(scene.casters, light, {scene.ground}, static_cast<float>(tolerance), settings);
    };
    PlanRow row;
    row.scene = scene.name, row.method = method, row.tolerance = tolerance;
    row.points_of_picture = view.points.size();
    say(scene.name, "plans of " + method);
    const auto start = Clock::now();
    const Shadow full = make_shadow<Shadow>(scene, options);
    const int builds = seconds_since(start) < 0.05 ? 9 : 3;
    const Plan<Shadow> plan = plan_it();
    const PlannedShadow<Shadow> planned(scene.casters, plan, {scene.ground});
    row.words = plan.text(), row.bound = static_cast<double>(plan.bound);
    row.full_build_ms = median_ms(builds, [&] { make_shadow<Shadow>(scene, options); });
    row.build_ms = median_ms(builds, [&] { PlannedShadow<Shadow>(scene.casters, plan, {scene.ground}); });
    row.plan_ms = median_ms(2 * builds + 1, plan_it);

    std::vector<float> a(4096), b;
    const std::size_t few = std::min(a.size(), view.points.size());
    const auto first = Clock::now();
    full.visibility(view.points.data() + (view.points.size() - few) / 2, few, a.data());
    const Points points = runs_of(view, seconds_since(first) * 1e9 / static_cast<double>(few));
    row.points = points.size();
    a.resize(points.size()), b.resize(points.size());
    std::vector<double> full_s, planned_s;
    for (int round = 0; round < 7; ++round) {
        const auto begin = Clock::now();
        full.visibility(points.data(), points.size(), a.data());
        full_s.push_back(seconds_since(begin));
        const auto middle = Clock::now();
        planned.visibility(points.data(), points.size(), b.data());
        planned_s.push_back(seconds_since(middle));
        if (round >= 2 && full_s[0] > 0.5) break;
    }
    const double per_point = 1e9 / static_cast<double>(points.size());
    row.full_ns = median(full_s) * per_point, row.planned_ns = median(planned_s) * per_point;

    std::vector<PointAnswer> answers(points.size());
    planned.visibility(points.data(), points.size(), b.data(), answers.data());
    double squares = 0.0;
    std::array<double, 3> counts{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double difference = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
        row.max_difference = std::max(row.max_difference, difference), squares += difference * difference;
        counts[static_cast<std::size_t>(answers[i])] += 1.0;
    }
    const double n = static_cast<double>(points.size());
    row.rms_difference = std::sqrt(squares / n);
    row.lit = counts[0] / n, row.shared = counts[1] / n, row.own = counts[2] / n;
    draw(scene, full, planned, row, folder);
    return row;
}

}  // namespace

std::vector<PlanRow> measure_plans(const Scene& scene, double tolerance, int lines,
                                   const std::filesystem::path& folder) {
    const View view = look(scene, lines * 16 / 9, lines);
    std::vector<PlanRow> rows;
    const auto add = [&](auto shadow, const std::string& method, const auto& options) {
        using Shadow = typename decltype(shadow)::type;
        rows.push_back(measure<Shadow>(scene, view, method, options, tolerance, folder));
    };
    if (std::holds_alternative<RectLight<float>>(scene.light)) {
        const bool has_few_outlines = scene.subject != Subject::occlusion_textures || scene.triangle_count() < 1000;
        if (has_few_outlines) add(Tag<PenumbraWedgeShadow<float>>(), "penumbra_wedge", PenumbraWedgeOptions());
        add(Tag<OcclusionTextureShadow<float>>(), "occlusion_texture", OcclusionTextureOptions());
    } else if (std::holds_alternative<DiskLight<float>>(scene.light)) {
        UmbraVolumeOptions d_buffer;
        d_buffer.mode = DiskMode::d_buffer;
        add(Tag<UmbraVolumeShadow<float>>(), "umbra_volume", UmbraVolumeOptions());
        add(Tag<UmbraVolumeShadow<float>>(), "umbra_volume-d_buffer", d_buffer);
    } else {
        SoftShadowMapOptions skins;
        skins.mode = LinearMode::skins, skins.resolution = 512, skins.most_samples = 33;
        add(Tag<SoftShadowMap<float>>(), "soft_shadow_map", SoftShadowMapOptions());
        add(Tag<SoftShadowMap<float>>(), "soft_shadow_map-skins", skins);
    }
    say(scene.name, "done\n");
    return rows;
}

void write_plans(const std::vector<PlanRow>& rows, const nlohmann::ordered_json& about,
                 const std::filesystem::path& folder) {
    std::ofstream csv(folder / "plans.csv"), words(folder / "plans.md");
    nlohmann::ordered_json json = about;
    csv << "scene,method,tolerance,bound,max_difference,rms_difference,full_build_ms,build_ms,plan_ms,full_ns,"
           "planned_ns,query_ratio,picture_ratio,lit,shared,own,points\n";
    fmt::print("{:<14} {:<22} {:>9} {:>9} {:>8} {:>9} {:>9} {:>7} {:>8} {:>6} {:>6}\n", "scene", "method", "full ns",
               "planned", "ratio", "picture", "max diff", "bound", "plan ms", "lit", "shared");
    std::size_t within = 0;
    double worst = 0.0;
    for (const PlanRow& row : rows) {
        csv << fmt::format("{},{},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{}\n",
                           row.scene, row.method, row.tolerance, row.bound, row.max_difference, row.rms_difference,
                           row.full_build_ms, row.build_ms, row.plan_ms, row.full_ns, row.planned_ns, row.query_ratio(),
                           row.picture_ratio(), row.lit, row.shared, row.own, row.points);
        json["plans"].push_back({{"scene", row.scene},
                                 {"method", row.method},
                                 {"tolerance", row.tolerance},
                                 {"bound", row.bound},
                                 {"max_difference", row.max_difference},
                                 {"rms_difference", row.rms_difference},
                                 {"full_build_ms", row.full_build_ms},
                                 {"build_ms", row.build_ms},
                                 {"plan_ms", row.plan_ms},
                                 {"full_ns", row.full_ns},
                                 {"planned_ns", row.planned_ns},
                                 {"query_ratio", row.query_ratio()},
                                 {"picture_ratio", row.picture_ratio()},
                                 {"lit", row.lit},
                                 {"shared", row.shared},
                                 {"own", row.own},
                                 {"points", row.points},
                                 {"words", row.words}});
        words << fmt::format("## {}, {}\n\n{:.0f} ns a point full, {:.0f} ns planned\n\n", row.scene, row.method,
                             row.full_ns, row.planned_ns);
        for (std::size_t at = 0; at < row.words.size();) {
            const std::size_t end = row.words.find('\n', at);
            words << "- " << row.words.substr(at, end - at) << '\n';
            at = end + 1;
        }
        words << fmt::format("\n![full, planned, how points were answered]({}-{}-plan.png)\n\n", row.scene, row.method);
        fmt::print("{:<14} {:<22} {:>9.1f} {:>9.1f} {:>8.2f} {:>9.2f} {:>9.4f} {:>7.3f} {:>8.3f} {:>6.2f} {:>6.2f}\n",
                   row.scene, row.method, row.full_ns, row.planned_ns, row.query_ratio(), row.picture_ratio(),
                   row.max_difference, row.bound, row.plan_ms, row.lit, row.shared);
        within += row.query_ratio() <= 0.25 ? 1 : 0;
        worst = std::max(worst, row.query_ratio());
    }
    std::ofstream(folder / "plans.json") << json.dump(2) << '\n';
    fmt::print("\n{} of {} take at most a quarter of the time; at worst {:.2f}\nresults: {}\n", within, rows.size(),
               worst, (folder / "plans.md").string());
}

}  // namespace penumbra::study
