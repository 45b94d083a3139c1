#include <fmt/format.h>

#include <algorithm>

#include "gnuplot.hpp"
#include "plot.hpp"

namespace penumbra::study {

bool write_cost_plot(const CostFigure& figure, const std::filesystem::path& folder) {
    PlotScript script;
    std::vector<double> sizes, times;
    std::vector<std::string> all_series;
    for (const Cost& cost : figure.costs) {
        sizes.push_back(cost.x), times.push_back(cost.ns_per_point);
        if (std::find(all_series.begin(), all_series.end(), cost.series) == all_series.end())
            all_series.push_back(cost.series);
    }
    for (std::size_t i = 0; i < all_series.size(); ++i) {
        std::string data;
        for (const Cost& cost : figure.costs)
            if (cost.series == all_series[i]) data += fmt::format("{} {}\n", cost.x, cost.ns_per_point);
        const char* color = all_series[i].rfind("Embree", 0) == 0 ? ink : colors[i % colors.size()];
        script.add(data, fmt::format("with linespoints lc rgb '{}' lw 1.6 pt {} ps 0.8 title {}", color,
                                     shapes[i % shapes.size()], in_quotes(all_series[i])));
    }
    const auto count = [](double x) { return fmt::format("{:.0f}", x); };
    const auto largest = [](const std::vector<double>& values) {
        return values.empty() ? 1.0 : *std::max_element(values.begin(), values.end());
    };
    const std::string x_axis = figure.log_x ? "set logscale x\n" + log_axis("x", sizes, {1.0, 3.0}, count)
                                            : fmt::format("set xrange [0:{}]\n", 1.05 * largest(sizes));
    const std::string y_axis = figure.log_y
                                   ? "set logscale y\n" + log_axis("y", times, {1.0, 3.0}, nanoseconds)
                                   : fmt::format("set yrange [0:{}]\nset format y '%.0f ns'\n", 1.15 * largest(times));
    return draw_plot(folder, "plot-cost-" + file_name(figure.name), script,
                     {"cost against " + figure.counts, figure.counts, "time per point", x_axis + y_axis, true});
}

}  // namespace penumbra::study
