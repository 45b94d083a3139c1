// The panel beside the picture: what is shown, by what, and what it costs.
#pragma once

#include "../viewer.hpp"

namespace penumbra::opengl {

/// What was pressed on it.
struct Pressed {
    bool screenshot = false;
    bool pause = false;
    bool camera = false;  ///< the scene was changed: so must be the camera
};

/// Draws the panel with Dear ImGui and carries out what is chosen on it.
Pressed draw_panel(Viewer& viewer, bool is_paused);

}  // namespace penumbra::opengl
