// What the study leaves behind: study.json, study.csv, index.html with its parts, plots, and a table on the
// terminal.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "result.hpp"

namespace penumbra::study {

/// The study as JSON: {"study", "scenes", "rows", "rays", "pictures", "triplets", "parts", "cost_figures", "costs"}.
/// Where the cost of rays is only bounded, ray_ns_at_equal_rmse and speedup are null, ray_ns_bound is "lower" or
/// "upper" and ray_ns_limit the bound.
nlohmann::ordered_json to_json(const Study& study);

/// One line a row, the same fields; knobs as k=v;k=v; empty where JSON has null.
std::string to_csv(const Study& study);

/// Writes study.json, study.csv, index.html with its parts, and a plot a scene into `folder`, where the
/// pictures are expected to be. Returns what was left out because a program or package is missing, a sentence
/// each. Throws std::runtime_error if a file cannot be written.
std::vector<std::string> write_study(const Study& study, const std::filesystem::path& folder);

/// Cost against size, where it was measured. Then, for each scene, the most accurate setting, marked; those that none
/// beats in RMSE and time both, unless the fewest rays swept beat them in RMSE; each method's best, marked, and its
/// default.
void print_table(const Study& study, std::FILE* out = stdout);

}  // namespace penumbra::study
