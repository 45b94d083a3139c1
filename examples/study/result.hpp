// What the study measures, as data: one row a setting of a method, one row a number of rays, and the
// pictures.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ray_cost.hpp"

namespace penumbra::study {

/// One setting of one method on one scene. Errors are of visibility, method − truth.
struct Row {
    std::string scene;
    std::size_t triangles = 0;
    std::string light;
    std::string method;
    nlohmann::ordered_json knobs;  ///< object; plots colour by "filter" and shape by "combination" where they exist
    std::size_t points = 0;
    double rmse = 0.0, max_error = 0.0, bias = 0.0;
    double build_ms = 0.0, ns_per_point = 0.0;
    std::size_t bytes = 0;
    bool is_default = false;     ///< the method's default options
    double overlap_rmse = -1.0;  ///< where casters hide the same part of the light; negative if they do nowhere

    // What rays cost for the same RMSE; filled by compare_with_rays.
    double ray_ns_at_equal_rmse = -1.0;  ///< not positive if outside of the rays swept
    double speedup = -1.0;               ///< ray_ns_at_equal_rmse / ns_per_point; not positive likewise
    double rays_at_equal_rmse = -1.0;    ///< of the cheapest sampler; not positive likewise
    std::string ray_sampler;             ///< the cheapest sampler's name
    Bound ray_ns_bound = Bound::none;    ///< which side of the limits the three figures above lie on
    double ray_ns_limit = -1.0;          ///< the limit of ray_ns_at_equal_rmse, where there is a bound
    double rays_limit = -1.0;            ///< the limit of rays_at_equal_rmse, likewise
};

/// Pictures of one setting. Files are relative to the study's folder and of equal size, but for the
/// difference, whose legend is drawn below it.
struct Picture {
    std::string scene;
    std::string label;  ///< method, and what is special about the setting
    std::string title;  ///< method and knobs
    std::string method_png, truth_png, difference_png;
    double rmse = 0.0;  ///< of its row: the picture's truth has fewer rays
};

/// Three pictures side by side, as a figure of a method's paper has them.
struct Triplet {
    std::string scene, png;
    std::string caption;  ///< what they are, from left to right, and how far from the truth
};

/// The share of points that a setting has where the truth has them, in light, penumbra or umbra: of all points, and of
/// those that are not in the light.
struct Agreement {
    std::string setting;
    double all = 0.0, shadow = 0.0;  ///< in [0, 1]
};

/// Light, penumbra and umbra by the truth and by settings, side by side.
struct Parts {
    std::string scene, png;
    std::vector<Agreement> agreements;
};

/// A point of a plot of cost against size.
struct Cost {
    std::string series;
    double x = 0.0, ns_per_point = 0.0;
    double rmse = -1.0;      ///< negative if it was not measured
    double build_ms = -1.0;  ///< negative likewise
    bool at_least = false;   ///< the time is a lower bound
    RayCost rays;            ///< at the same RMSE, where rays were swept
};

struct CostFigure {
    std::string name;                 ///< of files
    std::string counts;               ///< what x counts
    std::string about;                ///< for the report
    bool log_x = true, log_y = true;  ///< axes by factors
    std::vector<Cost> costs = {};
};

struct SceneInfo {
    std::string name;
    std::string about;  ///< one sentence
    std::size_t triangles = 0;
    std::string light;
    std::size_t points = 0;
    std::size_t overlap_points = 0;  ///< those at which casters hide the same part of the light
    double truth_noise = 0.0;        ///< standard error of the truth itself
};

struct Study {
    std::string command, date, machine, compiler, flags;
    int truth_rays = 0;
    std::vector<SceneInfo> scenes;  ///< in the order of the report
    std::vector<Row> rows;
    std::vector<RayRow> ray_rows;
    std::vector<Picture> pictures;
    std::vector<Triplet> triplets;
    std::vector<Parts> parts;
    std::vector<CostFigure> cost_figures;
};

/// Were rays swept for the figure's points?
bool has_rays(const CostFigure& figure);

/// Fills the ray figures of every row from `ray_rows` of its scene: the cheapest sampler at the row's RMSE.
void compare_with_rays(Study& study);

/// The rows of `scene` that no other is better than in RMSE and time both, fastest first.
std::vector<const Row*> pareto_front(const Study& study, const std::string& scene);

/// The row of `scene` with the smallest RMSE, the faster one of equals; of one method, or of all if none is named. Null
/// if there is none.
const Row* best_row(const Study& study, const std::string& scene, const std::string& method = "");

/// The methods measured on `scene`, in order of first appearance.
std::vector<std::string> methods_on(const Study& study, const std::string& scene);

/// A name for files made from a scene's name: letters, digits, '-' and '_' only.
std::string file_name(const std::string& scene);

/// Three significant digits or all before the point, no exponent.
std::string digits(double x);

/// "1,234,567".
std::string with_commas(std::size_t count);

/// What people call a method, a knob or its value.
std::string plain_name(const std::string& name);

/// "slices 8, n_buffer, closing": numbers with their names, words alone, switches only where they are on. All
/// knobs, or those that differ between rows of the same scene and method.
std::string knobs_text(const Row& row);
std::string varying_knobs_text(const Study& study, const Row& row);

/// The value of a knob for people, "yes" and "no" for Booleans; `fallback` if the row has no such knob.
std::string knob_text(const Row& row, const std::string& knob, const std::string& fallback = "");

}  // namespace penumbra::study
