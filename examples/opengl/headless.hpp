// Pictures, times and comparisons without a window.
#pragma once

#include "arguments.hpp"

namespace penumbra::opengl {

/// Draws `frames` frames, writes what is asked for and prints the time of each pass. Throws std::runtime_error with a
/// message for the user, also where the driver complains.
void run_headless(const Arguments& arguments);

}  // namespace penumbra::opengl
