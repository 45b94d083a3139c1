#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "plot.hpp"
#include "report.hpp"

namespace penumbra::study {
namespace {

/// "87", or "> 40" where only a limit is known.
std::string bounded(Bound bound, double known, double limit, const char* unit) {
    if (bound == Bound::none) return known > 0.0 ? digits(known) + unit : "–";
    return (bound == Bound::lower ? "> " : "< ") + digits(limit) + unit;
}

/// Of rays that cost so much at the same RMSE.
std::string speedup_text(const RayCost& rays, double ns_per_point) {
    const double factor = rays.ns / ns_per_point;
    return bounded(rays.bound, factor, factor, "×");
}

using Cells = std::array<std::string, 7>;

Cells cells(const Study& study, const Row& row) {
    return {row.scene,
            row.method,
            varying_knobs_text(study, row) + (row.is_default ? "  (default)" : ""),
            fmt::format("{:.4f}", row.rmse),
            digits(row.ns_per_point),
            bounded(row.ray_ns_bound, row.rays_at_equal_rmse, row.rays_limit, ""),
            bounded(row.ray_ns_bound, row.speedup, row.ray_ns_limit / row.ns_per_point, "×")};
}

std::size_t columns(const std::string& utf8) {
    return static_cast<std::size_t>(std::count_if(
        utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

void print_line(std::FILE* out, const char* mark, const Cells& line, const std::array<std::size_t, 7>& widths) {
    std::string text = mark;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::string pad(widths[i] - columns(line[i]), ' ');
        text += "  " + (i < 3 ? line[i] + pad : pad + line[i]);
    }
    fmt::print(out, "{}\n", text);
}

void print_costs(const Study& study, std::FILE* out) {
    for (const CostFigure& figure : study.cost_figures) {
        const bool with_rays = has_rays(figure);
        const auto line = [&](const std::string& x, const std::string& ns, const std::string& rmse,
                              const std::string& build, const std::string& faster, const std::string& series) {
            fmt::print(out, "{:>{}}  {:>10}  {:>8}  {:>9}  ", x, std::max<std::size_t>(10, figure.counts.size()), ns,
                       rmse, build);
            fmt::print(out, "{}{}\n", with_rays ? fmt::format("{:>8}  ", faster) : "", series);
        };
        fmt::print(out, "\n{}\n", figure.about);
        line(figure.counts, "ns/point", "RMSE", "build, ms", "speedup", "series");
        std::vector<const Cost*> costs;
        for (const Cost& cost : figure.costs) costs.push_back(&cost);
        std::stable_sort(costs.begin(), costs.end(),
                         [](const Cost* a, const Cost* b) { return a->series < b->series; });
        for (const Cost* cost : costs)
            line(fmt::format("{}", cost->x), (cost->at_least ? "> " : "") + digits(cost->ns_per_point),
                 fmt::format("{:.4f}", cost->rmse), cost->build_ms < 0.0 ? "" : digits(cost->build_ms),
                 speedup_text(cost->rays, cost->ns_per_point), cost->series);
    }
}

}  // namespace

void print_table(const Study& study, std::FILE* out) {
    print_costs(study, out);
    if (study.rows.empty()) return;
    const Cells head = {"scene", "method", "knobs", "RMSE", "ns/point", "rays at equal RMSE", "speedup"};
    std::vector<std::pair<const char*, Cells>> lines;  // a mark and a row; empty between scenes
    for (const SceneInfo& scene : study.scenes) {
        const Row* best = best_row(study, scene.name);
        std::vector<const Row*> rows = pareto_front(study, scene.name);
        std::reverse(rows.begin(), rows.end());
        const auto coarse = [&](const Row* row) { return row != best && row->ray_ns_bound == Bound::upper; };
        rows.erase(std::remove_if(rows.begin(), rows.end(), coarse), rows.end());
        const auto add = [&](const Row* row) {
            if (std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(row);
        };
        std::vector<const Row*> bests;
        for (const std::string& method : methods_on(study, scene.name)) {
            bests.push_back(best_row(study, scene.name, method));
            add(bests.back());
        }
        for (const Row& row : study.rows)
            if (row.is_default && row.scene == scene.name) add(&row);
        lines.emplace_back("", Cells());
        for (const Row* row : rows) {
            const bool of_method = std::find(bests.begin(), bests.end(), row) != bests.end();
            lines.emplace_back(row == best ? "★" : of_method ? "☆" : " ", cells(study, *row));
        }
    }
    std::array<std::size_t, 7> widths{};
    for (std::size_t i = 0; i < widths.size(); ++i) {
        widths[i] = columns(head[i]);
        for (const auto& line : lines) widths[i] = std::max(widths[i], columns(line.second[i]));
    }
    print_line(out, " ", head, widths);
    for (const auto& [mark, line] : lines) {
        if (line[0].empty())
            fmt::print(out, "\n");
        else
            print_line(out, mark, line, widths);
    }
    fmt::print(
        out,
        "\n★ smallest RMSE, ☆ of its method. Below ★, settings that no other beats in RMSE and time both, as long as\n"
        "the fewest rays are not more accurate still; then each method's best and its default. All {} settings are in\n"
        "study.csv.\n",
        study.rows.size());
}

}  // namespace penumbra::study
