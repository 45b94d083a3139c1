// Measures settings of methods against ray-traced truth, and rays against themselves, on the same points in one run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <penumbra/geometry.hpp>
#include <vector>

#include "result.hpp"
#include "scene.hpp"

namespace penumbra::study {

/// A method built for one scene: what is timed is `visibility`, over a whole batch on one thread.
struct Built {
    std::function<void(const Vec3<float>* points, std::size_t count, float* result)> visibility;
    std::size_t bytes = 0;
};

/// A setting to measure.
struct Setting {
    std::string method;
    nlohmann::ordered_json knobs;
    bool is_default = false;
    std::function<Built(const Scene&)> build;
};

struct Effort {
    std::size_t points = 4096;  ///< that figures are measured on
    int truth_rays = 4096;      ///< a point
    int most_rays = 1024;       ///< of the sweep, from 4 on by doubling
    int rounds = 3;             ///< every timing is the median of so many, all settings in turn
    int width = 560, height = 420;
    int picture_rays = 256;  ///< a pixel of the true picture
};

/// Adds the scene's rows, rays and pictures to the study; pictures are written to `folder`. Says on stderr how far it
/// is.
void measure_scene(const Scene& scene, const std::vector<Setting>& settings, const Effort& effort,
                   const std::filesystem::path& folder, Study& study);

}  // namespace penumbra::study
