// What plans save: each method with all its effects and as planned, side by side.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../scenes/scene.hpp"

namespace penumbra::study {

using namespace scenes;

/// A method on a scene, full and planned. Times are medians of runs in turn, one thread.
struct PlanRow {
    std::string scene, method, words;
    double tolerance = 0.0, bound = 0.0;
    double max_difference = 0.0, rms_difference = 0.0;  ///< |planned − full| at the points
    double full_build_ms = 0.0, build_ms = 0.0, plan_ms = 0.0;
    double full_ns = 0.0, planned_ns = 0.0;     ///< a point
    double lit = 0.0, shared = 0.0, own = 0.0;  ///< shares of points, by how they came by their answer
    std::size_t points = 0, points_of_picture = 0;

    double query_ratio() const { return planned_ns / full_ns; }
    /// Of a picture's time: building, planning and asking once for each of its points.
    double picture_ratio() const {
        const double n = static_cast<double>(points_of_picture) * 1e-6;
        return (plan_ms + build_ms + planned_ns * n) / (full_build_ms + full_ns * n);
    }
};

/// Every method for the scene's light, with its default options as "full", over what a picture of 16 : 9 with so many
/// lines shows. Writes a picture of full, planned, and how points came by their answers, beside the results.
std::vector<PlanRow> measure_plans(const Scene& scene, double tolerance, int lines,
                                   const std::filesystem::path& folder);

/// plans.csv, plans.json and plans.md; prints the table.
void write_plans(const std::vector<PlanRow>& rows, const nlohmann::ordered_json& about,
                 const std::filesystem::path& folder);

}  // namespace penumbra::study
