// Measures settings of methods against ray-traced truth, and rays against themselves, on the same points in one run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "result.hpp"
#include "../scenes/scene.hpp"
#include "settings.hpp"

namespace penumbra::study {

using namespace scenes;

struct Effort {
    std::size_t points = 4096;  ///< that errors are measured at
    std::size_t timed = 4096;   ///< points that are timed
    int truth_rays = 4096;      ///< a point
    int most_rays = 1024;       ///< of the sweep, from 4 on by doubling
    int rounds = 5;             ///< every timing is the median of at most so many, all settings in turn
    int width = 560, height = 420;
    int picture_rays = 256;  ///< a pixel of the true picture

    // Errors are rare and large, at contacts and edges, so they need many places; batches are timed on neighbours, as a
    // picture would have them.
    static constexpr std::size_t error_run = 4, timed_run = 64;
};

/// Adds the scene's rows, rays and pictures to the study; pictures are written to `folder`. Says on stderr how far it
/// is.
void measure_scene(const Scene& scene, const std::vector<Setting>& settings, const Effort& effort,
                   const std::filesystem::path& folder, Study& study);

}  // namespace penumbra::study
