// A scene and settings, measured: what tables and pictures are made of.
#pragma once

#include <penumbra/reference/embree.hpp>
#include <string>
#include <vector>

#include "measure.hpp"
#include "rays.hpp"
#include "result.hpp"
#include "settings.hpp"
#include "view.hpp"

namespace penumbra::study {

/// What is measured of a scene: where, and against what.
struct Measured {
    const Scene& scene;
    const Effort& effort;
    View view;
    Points points, timed;
    reference::Scene traced;
    std::vector<float> truth;
    std::vector<bool> overlap;
    SceneInfo info;
};

/// A setting of a method, built, and what is known of it.
struct Candidate {
    Built built;
    Row row;
    std::string special;
};

}  // namespace penumbra::study
