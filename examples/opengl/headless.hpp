// Pictures and times without a window.
#pragma once

#include <string>

#include "arguments.hpp"

namespace penumbra::opengl {

/// Draws `frames` frames, writes what is asked for and prints the time of each pass. Throws std::runtime_error with a
/// message for the user, also where the driver complains.
void run_headless(const Arguments& arguments);

/// Milliseconds of each pass, and the error, of every method on spheres, bunny and foliage at 1080p and 4K; as a table
/// to standard output and as CSV to `file`.
void run_timings(const std::string& file, const std::string& gl);

}  // namespace penumbra::opengl
