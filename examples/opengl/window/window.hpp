// The example in a window.
#pragma once

#include "../arguments.hpp"

namespace penumbra::opengl {

/// Until it is closed, or after `frames` frames. Throws std::runtime_error with a message for the user.
void run_window(const Arguments& arguments);

}  // namespace penumbra::opengl
