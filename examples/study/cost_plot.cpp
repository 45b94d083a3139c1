#include <fmt/format.h>

#include <algorithm>

#include "gnuplot.hpp"
#include "plot.hpp"

namespace penumbra::study {
namespace {

template <class Of>
std::vector<std::string> distinct(const Study& study, Of&& of) {
    std::vector<std::string> names;
    for (const Cost& cost : study.costs) {
        const std::string name = of(cost);
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

}  // namespace

std::vector<std::string> cost_figures(const Study& study) {
    return distinct(study, [](const Cost& cost) { return cost.figure; });
}

bool write_cost_plot(const Study& study, const std::string& figure, const std::filesystem::path& folder) {
    PlotScript script;
    std::vector<double> sizes, times;
    const auto all_series = distinct(study, [&](const Cost& cost) { return cost.figure == figure ? cost.series : ""; });
    for (std::size_t i = 0; i < all_series.size(); ++i) {
        std::string data;
        for (const Cost& cost : study.costs) {
            if (cost.figure != figure || cost.series != all_series[i]) continue;
            data += fmt::format("{} {}\n", cost.x, cost.ns_per_point);
            sizes.push_back(cost.x), times.push_back(cost.ns_per_point);
        }
        const char* color = all_series[i].rfind("Embree", 0) == 0 ? ink : colors[i % colors.size()];
        script.add(data, fmt::format("with linespoints lc rgb '{}' lw 1.6 pt {} ps 0.8 title {}", color,
                                     shapes[i % shapes.size()], in_quotes(all_series[i])));
    }
    // triangles grow by factors, and time should not; of spheres both grow alike
    const bool by_factors = figure == "triangles";
    const auto count = [](double x) { return fmt::format("{:.0f}", x); };
    const std::string axes =
        by_factors ? "set logscale x\n" + log_axis("x", sizes, {1.0, 3.0}, count) +
                         fmt::format("set yrange [0:{}]\nset format y '%.0f ns'\n",
                                     1.15 * *std::max_element(times.begin(), times.end()))
                   : "set logscale y\nset xrange [0:85]\n" + log_axis("y", times, {1.0, 3.0}, nanoseconds);
    return draw_plot(folder, "plot-cost-" + file_name(figure), script,
                     {"cost against number of " + figure, figure, "time per point", axes, true});
}

}  // namespace penumbra::study
