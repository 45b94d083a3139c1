// The study's plots.
#pragma once

#include <filesystem>
#include <string>

#include "result.hpp"

namespace penumbra::study {

// Both write <name>.gp and have gnuplot draw <name>.svg from it. False if gnuplot is missing or fails.

/// plot-<scene>: accuracy against time.
bool write_plot(const Study& study, const std::string& scene, const std::filesystem::path& folder);

/// plot-cost-<figure>: cost against size.
bool write_cost_plot(const CostFigure& figure, const std::filesystem::path& folder);

}  // namespace penumbra::study
