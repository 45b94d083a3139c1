// What every method costs on this machine's GPU, beside its error.
#pragma once

#include <string>

#include "arguments.hpp"

namespace penumbra::opengl {

/// Medians of each pass on spheres, bunny and foliage, by the methods as the README has them and by percentage-closer
/// soft shadows; at 1080p and 4K, or at the size that was asked for. A table to standard output, and CSV to `file`.
/// Errors are against rays from the same points. Throws std::runtime_error with a message for the user.
void run_timings(const std::string& file, const Arguments& arguments);

}  // namespace penumbra::opengl
