#include "plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "gnuplot.hpp"

namespace penumbra::study {
namespace {

/// Distinct values in order of first appearance.
std::vector<std::string> distinct(const std::vector<std::string>& values) {
    std::vector<std::string> result;
    for (const std::string& value : values)
        if (std::find(result.begin(), result.end(), value) == result.end()) result.push_back(value);
    return result;
}

/// What colours and shapes stand for: methods where there are several, else knobs.
struct Keys {
    std::string color, shape;
};

Keys keys_of(const Study& study, const std::string& scene) {
    const std::vector<std::string> methods = methods_on(study, scene);
    if (methods.size() > 1) return {"method", "method"};
    if (!methods.empty() && methods.front() == "penumbra_wedge") return {"overlap", "silhouette"};
    if (!methods.empty() && methods.front() == "umbra_volume") return {"mode", "layers"};
    if (!methods.empty() && methods.front() == "soft_shadow_map") return {"mode", "transition"};
    return {"filter", "combination"};
}

std::string value_of(const Row& row, const std::string& key) {
    return key == "method" ? row.method : knob_text(row, key, "no " + key);
}

std::string curve_key(const RayRow& row) { return fmt::format("{} {}", row.sampler, row.packet); }

/// Every sampler as a soft line, and the best of them at any time as a strong one.
void add_rays(PlotScript& script, const Study& study, const std::string& scene) {
    std::map<std::string, std::string> curves;
    std::vector<const RayRow*> by_time;
    for (const RayRow& row : study.ray_rows) {
        if (row.scene != scene) continue;
        curves[curve_key(row)] += fmt::format("{} {}\n", row.ns_per_point, row.rmse);
        by_time.push_back(&row);
    }
    if (by_time.empty()) return;
    for (const auto& curve : curves)
        script.add(curve.second, fmt::format("with lines lc rgb '{}' lw 0.8 notitle", soft));
    script.key(fmt::format("with lines lc rgb '{}' lw 0.8 title 'Embree, {} samplers'", soft, curves.size()));
    std::sort(by_time.begin(), by_time.end(),
              [](const RayRow* a, const RayRow* b) { return a->ns_per_point < b->ns_per_point; });
    std::string best;
    double least = by_time.front()->rmse * 2.0;
    for (const RayRow* row : by_time) {
        if (row->rmse >= least) continue;
        least = row->rmse;
        best += fmt::format("{} {}\n", row->ns_per_point, row->rmse);
    }
    script.add(best, fmt::format("with lines lc rgb '{}' lw 2 title 'Embree, the best of them'", ink));
}

void add_rows(PlotScript& script, const Study& study, const std::string& scene) {
    const Keys keys = keys_of(study, scene);
    std::vector<std::string> hues, forms;
    for (const Row& row : study.rows) {
        if (row.scene != scene) continue;
        hues.push_back(value_of(row, keys.color));
        forms.push_back(value_of(row, keys.shape));
    }
    hues = distinct(hues), forms = distinct(forms);
    for (std::size_t h = 0; h < hues.size(); ++h) {
        for (std::size_t f = 0; f < forms.size(); ++f) {
            std::string data;
            for (const Row& row : study.rows)
                if (row.scene == scene && value_of(row, keys.color) == hues[h] && value_of(row, keys.shape) == forms[f])
                    data += fmt::format("{} {}\n", row.ns_per_point, row.rmse);
            if (data.empty()) continue;
            script.add(data, fmt::format("with points lc rgb '{}' pt {} ps 0.7 notitle", colors[h % colors.size()],
                                         shapes[f % shapes.size()]));
        }
    }
    std::string front;
    for (const Row* row : pareto_front(study, scene)) front += fmt::format("{} {}\n", row->ns_per_point, row->rmse);
    if (!front.empty()) script.add(front, fmt::format("with steps lc rgb '{}' lw 2 title 'best for its time'", accent));
    for (std::size_t h = 0; h < hues.size(); ++h)
        script.key(fmt::format("with points lc rgb '{}' pt 7 ps 0.9 title {}", colors[h % colors.size()],
                               in_quotes(plain_name(hues[h]))));
    for (std::size_t f = 0; keys.color != keys.shape && forms.size() > 1 && f < forms.size(); ++f)
        script.key(fmt::format("with points lc rgb '{}' pt {} ps 0.8 title {}", soft, shapes[f % shapes.size()],
                               in_quotes(plain_name(forms[f]))));
}

}  // namespace

bool write_plot(const Study& study, const std::string& scene, const std::filesystem::path& folder) {
    const std::string name = "plot-" + file_name(scene);
    PlotScript script;
    add_rows(script, study, scene);
    add_rays(script, study, scene);
    std::vector<double> times, errors;
    const auto collect = [&](const auto& rows) {
        for (const auto& row : rows)
            if (row.scene == scene) times.push_back(row.ns_per_point), errors.push_back(row.rmse);
    };
    collect(study.rows), collect(study.ray_rows);
    const std::string axes = log_axis("x", times, {1.0}, nanoseconds) +
                             log_axis("y", errors, {1.0, 2.0, 5.0}, [](double e) { return fmt::format("{:.4g}", e); });
    return draw_plot(folder, name, script, {scene, "time per point", "RMSE of visibility", "set logscale xy\n" + axes});
}

}  // namespace penumbra::study
