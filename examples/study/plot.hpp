// The accuracy-against-time plot of a scene as a picture, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>

#include "result.hpp"

namespace penumbra::study {

/// A name for files made from a scene's name: letters, digits, '-' and '_' only.
std::string file_name(const std::string& scene);

/// Writes plot-<scene>.gp, which holds its data, and has gnuplot draw plot-<scene>.svg from it. False if
/// gnuplot is missing or fails; the script is there all the same.
bool write_plot(const Study& study, const std::string& scene, const std::filesystem::path& folder);

}  // namespace penumbra::study
