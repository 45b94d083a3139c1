#include "measure.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <penumbra/reference/embree.hpp>
#include <thread>

#include "picture.hpp"
#include "view.hpp"

namespace penumbra::study {
namespace {

using Clock = std::chrono::steady_clock;
using Points = std::vector<Vec3<float>>;
using reference::Rays;
using reference::Sampler;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Progress on stderr: a line that is written over on a terminal, nothing but the start of each scene elsewhere.
void say(const std::string& scene, const std::string& what) {
    static const bool on_terminal = isatty(STDERR_FILENO) == 1;
    static std::string last_scene;
    if (on_terminal)
        std::fprintf(stderr, "\r\x1b[K%s: %s", scene.c_str(), what.c_str());
    else if (scene != last_scene)
        std::fprintf(stderr, "%s ...\n", scene.c_str());
    last_scene = scene;
    std::fflush(stderr);
}

struct Error {
    double rmse = 0.0, max = 0.0, bias = 0.0;
};

Error compare(const std::vector<float>& measured, const std::vector<float>& truth) {
    Error error;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = static_cast<double>(measured[i]) - static_cast<double>(truth[i]);
        error.rmse += difference * difference;
        error.bias += difference;
        error.max = std::max(error.max, std::abs(difference));
    }
    const double count = static_cast<double>(std::max<std::size_t>(truth.size(), 1));
    error.rmse = std::sqrt(error.rmse / count);
    error.bias /= count;
    return error;
}

/// Ray-traced visibility on all cores; only timings need one thread.
std::vector<float> trace(const reference::Scene& traced, const Scene& scene, const Points& points, int rays) {
    std::vector<float> result(points.size());
    reference::SampleOptions options;
    options.samples = rays;
    options.sampler = Sampler::stratified;
    const std::size_t workers = std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::thread> threads;
    for (std::size_t w = 0; w < workers; ++w) {
        const std::size_t first = w * points.size() / workers, last = (w + 1) * points.size() / workers;
        threads.emplace_back([&, first, last] {
            traced.visibility(points.data() + first, last - first, scene.light, options, result.data() + first);
        });
    }
    for (std::thread& thread : threads) thread.join();
    return result;
}

const char* name_of(Sampler sampler) {
    switch (sampler) {
        case Sampler::stratified:
            return "stratified";
        case Sampler::r2:
            return "r2";
        case Sampler::sobol:
            break;
    }
    return "sobol";
}

/// Something to time: a batch over all points. Short ones are run once before the clock starts, so that both rays and
/// methods find their data in the caches that a picture in progress would leave them.
struct Timed {
    std::function<void()> run;
    bool is_short = true;
    std::vector<double> ns_per_point = {};

    void once(std::size_t points) {
        if (is_short) run();
        const int repeats = is_short ? 2 : 1;
        const auto start = Clock::now();
        for (int i = 0; i < repeats; ++i) run();
        ns_per_point.push_back(seconds_since(start) * 1e9 / static_cast<double>(points) / repeats);
    }
};

/// A setting of a method, built, with the time it took.
struct Candidate {
    Built built;
    double build_ms;
};

Candidate build(const Setting& setting, const Scene& scene) {
    const auto start = Clock::now();
    Built built = setting.build(scene);
    return {std::move(built), seconds_since(start) * 1e3};
}

struct Sweep {
    RayRow row;
    reference::SampleOptions options;
};

std::vector<Sweep> ray_sweep(const std::string& scene, int most_rays) {
    std::vector<Sweep> sweeps;
    for (const Rays mode : {Rays::single, Rays::packet16, Rays::coherent16}) {
        for (const Sampler sampler : {Sampler::stratified, Sampler::r2, Sampler::sobol}) {
            for (int rays = 4; rays <= most_rays; rays *= 2) {
                Sweep sweep;
                sweep.row.scene = scene;
                sweep.row.sampler = fmt::format("{}{}", name_of(sampler), mode == Rays::coherent16 ? " coherent" : "");
                sweep.row.packet = mode == Rays::single ? 1 : 16;
                sweep.row.rays = rays;
                sweep.options.samples = rays;
                sweep.options.sampler = sampler;
                sweep.options.rays = mode;
                sweep.options.seed = 1000U + static_cast<std::uint32_t>(rays);  // independent of the truth's
                sweeps.push_back(sweep);
            }
        }
    }
    return sweeps;
}

/// The picture of `visibility` at the view's points; −1 elsewhere.
Image<float> image_of(const View& view, const std::vector<float>& visibility) {
    Image<float> image(view.width, view.height, -1.0F);
    for (std::size_t i = 0; i < view.points.size(); ++i) image.data()[view.pixel[i]] = visibility[i];
    return image;
}

Image<Rgb> shade(const View& view, const std::vector<float>& visibility) {
    Image<float> cosine(view.width, view.height, -1.0F);
    Image<Vec3<float>> base(view.width, view.height, Vec3<float>(0.62F, 0.70F, 0.78F));  // the background
    for (std::size_t i = 0; i < view.hit.size(); ++i) {
        if (!view.hit[i]) continue;
        cosine.data()[i] = 0.0F;
        base.data()[i] = Vec3<float>(0.80F, 0.62F, 0.42F);  // casters, also where they look away
    }
    for (std::size_t i = 0; i < view.points.size(); ++i) {
        cosine.data()[view.pixel[i]] = view.cosine[i];
        if (!view.on_caster[i]) base.data()[view.pixel[i]] = Vec3<float>(0.78F, 0.78F, 0.76F);
    }
    return shaded_picture(image_of(view, visibility), cosine, base, 0.12F);
}

void add_picture(const View& view, const std::vector<float>& visibility, const std::vector<float>& truth,
                 const std::string& title, const std::string& headline, const std::string& file,
                 const std::filesystem::path& folder, const std::string& scene, Study& study) {
    Picture picture;
    picture.scene = scene;
    picture.title = title;
    picture.method_png = file + ".png";
    picture.truth_png = scene + "-truth.png";
    picture.difference_png = file + "-difference.png";
    picture.rmse = compare(visibility, truth).rmse;
    write_png(folder / picture.method_png, shade(view, visibility));
    const Image<Rgb> difference = difference_picture(image_of(view, visibility), image_of(view, truth));
    write_png(folder / picture.difference_png, difference);
    write_png(folder / (file + "-panel.png"),
              side_by_side(
                  {{scene + "\nray-traced truth", shade(view, truth)},
                   {fmt::format("{}\nRMSE {:.3f} over the picture", headline, picture.rmse), shade(view, visibility)},
                   {"difference\nmethod − truth, of visibility", difference}}));
    study.pictures.push_back(picture);
}

}  // namespace

void measure_scene(const Scene& scene, const std::vector<Setting>& settings, const Effort& effort,
                   const std::filesystem::path& folder, Study& study) {
    say(scene.name, "looking");
    const View view = look(scene, effort.width, effort.height);
    Points points;
    for (const std::size_t i : spread(view, effort.points)) points.push_back(view.points[i]);
    const std::size_t count = points.size();
    const reference::Scene traced(scene.casters);

    say(scene.name, fmt::format("truth, {} rays at {} points", effort.truth_rays, count));
    const std::vector<float> truth = trace(traced, scene, points, effort.truth_rays);
    reference::SampleOptions truth_options;
    truth_options.samples = effort.truth_rays;
    truth_options.sampler = Sampler::stratified;
    truth_options.seed = 77;
    SceneInfo info;
    info.name = scene.name;
    info.about = scene.about;
    info.triangles = scene.triangle_count();
    info.light = scene.light_text();
    info.points = count;
    info.truth_noise = traced.noise(points.data(), count, scene.light, truth_options, 2);
    study.scenes.push_back(info);

    // Every round runs each of the rays' and the methods' settings once, in turn; long ones in the first round only.
    std::vector<float> result(count);
    std::vector<Timed> timed;
    std::vector<Sweep> sweeps = ray_sweep(scene.name, effort.most_rays);
    for (const Sweep& sweep : sweeps)
        timed.push_back({[&] { traced.visibility(points.data(), count, scene.light, sweep.options, result.data()); },
                         sweep.row.rays <= 64});
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        say(scene.name, fmt::format("{} rays, {}", sweeps[i].row.rays, sweeps[i].row.sampler));
        timed[i].once(count);
        sweeps[i].row.rmse = compare(result, truth).rmse;
    }
    std::vector<Candidate> candidates;
    std::vector<Row> rows;
    candidates.reserve(settings.size());
    for (const Setting& setting : settings) {
        say(scene.name, fmt::format("setting {} of {}", rows.size() + 1, settings.size()));
        candidates.push_back(build(setting, scene));
        timed.push_back(
            {[&, i = candidates.size() - 1] { candidates[i].built.visibility(points.data(), count, result.data()); }});
        timed.back().once(count);
        const Error error = compare(result, truth);
        Row row;
        row.scene = scene.name;
        row.triangles = info.triangles;
        row.light = info.light;
        row.method = setting.method;
        row.knobs = setting.knobs;
        row.is_default = setting.is_default;
        row.points = count;
        row.rmse = error.rmse, row.max_error = error.max, row.bias = error.bias;
        row.build_ms = candidates.back().build_ms;
        row.bytes = candidates.back().built.bytes;
        rows.push_back(row);
    }
    for (int round = 1; round < effort.rounds; ++round) {
        say(scene.name, fmt::format("timing, round {} of {}", round + 1, effort.rounds));
        for (Timed& item : timed)
            if (item.is_short) item.once(count);
    }
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        sweeps[i].row.ns_per_point = median(timed[i].ns_per_point);
        study.ray_rows.push_back(sweeps[i].row);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].ns_per_point = median(timed[sweeps.size() + i].ns_per_point);
        study.rows.push_back(rows[i]);
    }

    say(scene.name, "pictures");
    const std::vector<float> true_picture = trace(traced, scene, view.points, effort.picture_rays);
    write_png(folder / (scene.name + "-truth.png"), shade(view, true_picture));
    std::vector<float> pixels(view.points.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row* best = best_row(study, scene.name);
        const bool is_best = best && best->knobs == rows[i].knobs && best->method == rows[i].method;
        if (!is_best && !rows[i].is_default) continue;
        candidates[i].built.visibility(view.points.data(), pixels.size(), pixels.data());
        add_picture(view, pixels, true_picture, fmt::format("{}: {}", rows[i].method, knobs_text(rows[i])),
                    fmt::format("{}, {}", rows[i].method, is_best ? "best setting" : "default"),
                    fmt::format("{}-{}{}", scene.name, rows[i].method, is_best ? "-best" : ""), folder, scene.name,
                    study);
    }
    say(scene.name, "done\n");
}

}  // namespace penumbra::study
