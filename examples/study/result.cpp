#include "result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace penumbra::study {
namespace {

bool varies(const Study& study, const Row& row, const std::string& knob) {
    return std::any_of(study.rows.begin(), study.rows.end(), [&](const Row& other) {
        return other.scene == row.scene && other.method == row.method && other.knobs.contains(knob) &&
               other.knobs[knob] != row.knobs[knob];
    });
}

template <class Wanted>
std::string text_of(const Row& row, Wanted&& wanted) {
    std::string text;
    for (const auto& knob : row.knobs.items()) {
        const auto& value = knob.value();
        if (!wanted(knob.key()) || value == false) continue;
        const std::string word = value == true       ? knob.key()
                                 : value.is_string() ? value.get<std::string>()
                                                     : knob.key() + " " + value.dump();
        text += (text.empty() ? "" : ", ") + word;
    }
    return text;
}

}  // namespace

bool has_rays(const CostFigure& figure) {
    return std::any_of(figure.costs.begin(), figure.costs.end(), [](const Cost& cost) { return cost.rays.ns > 0.0; });
}

void compare_with_rays(Study& study) {
    for (Row& row : study.rows) {
        const RayCost cost = ray_cost(study.ray_rows, row.scene, row.rmse);
        const bool known = cost.ns > 0.0 && cost.bound == Bound::none;
        row.ray_ns_bound = cost.bound;
        row.ray_sampler = cost.sampler;
        row.ray_ns_limit = known ? -1.0 : cost.ns;
        row.rays_limit = known ? -1.0 : cost.rays;
        row.ray_ns_at_equal_rmse = known ? cost.ns : -1.0;
        row.rays_at_equal_rmse = known ? cost.rays : -1.0;
        row.speedup = known && row.ns_per_point > 0.0 ? cost.ns / row.ns_per_point : -1.0;
    }
}

std::vector<const Row*> pareto_front(const Study& study, const std::string& scene) {
    std::vector<const Row*> rows, front;
    for (const Row& row : study.rows)
        if (row.scene == scene) rows.push_back(&row);
    std::stable_sort(rows.begin(), rows.end(), [](const Row* a, const Row* b) {
        return a->ns_per_point != b->ns_per_point ? a->ns_per_point < b->ns_per_point : a->rmse < b->rmse;
    });
    for (const Row* row : rows)
        if (front.empty() || row->rmse < front.back()->rmse) front.push_back(row);
    return front;
}

const Row* best_row(const Study& study, const std::string& scene, const std::string& method) {
    const Row* best = nullptr;
    for (const Row& row : study.rows) {
        if (row.scene != scene || (!method.empty() && row.method != method)) continue;
        const bool better = !best || row.rmse < best->rmse;
        if (better || (row.rmse == best->rmse && row.ns_per_point < best->ns_per_point)) best = &row;
    }
    return best;
}

std::vector<std::string> methods_on(const Study& study, const std::string& scene) {
    std::vector<std::string> methods;
    for (const Row& row : study.rows)
        if (row.scene == scene && std::find(methods.begin(), methods.end(), row.method) == methods.end())
            methods.push_back(row.method);
    return methods;
}

std::string file_name(const std::string& scene) {
    std::string name;
    for (const char c : scene) name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
    return name;
}

std::string digits(double x) {
    const int decimals = x >= 100.0 ? 0 : x >= 10.0 ? 1 : 2;
    const bool whole = x < 1e9 && x == static_cast<double>(static_cast<long>(x));
    return fmt::format("{:.{}f}", x, whole ? 0 : decimals);
}

std::string with_commas(std::size_t count) {
    std::string text = std::to_string(count);
    for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
    return text;
}

std::string plain_name(const std::string& name) {
    static const std::map<std::string, std::string> names = {{"n_buffer", "N-Buffer"},
                                                             {"d_buffer", "D-buffer"},
                                                             {"mipmap", "mip-map"},
                                                             {"rectangles", "rectangles (the paper)"}};
    const auto known = names.find(name);
    if (known != names.end()) return known->second;
    std::string text = name;
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

std::string knob_text(const Row& row, const std::string& knob, const std::string& fallback) {
    if (!row.knobs.contains(knob)) return fallback;
    const nlohmann::ordered_json& value = row.knobs[knob];
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string knobs_text(const Row& row) {
    return text_of(row, [](const std::string&) { return true; });
}

std::string varying_knobs_text(const Study& study, const Row& row) {
    return text_of(row, [&](const std::string& knob) { return varies(study, row, knob); });
}

}  // namespace penumbra::study
