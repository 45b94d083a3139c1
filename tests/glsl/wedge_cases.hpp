// How the query of penumbra wedges is compared with the C++.
#pragma once

#include <algorithm>
#include <penumbra/penumbra_wedge/wedge_texels.hpp>
#include <string>
#include <vector>

#include "glsl/scenes.hpp"

namespace penumbra::test {

/// What follows "#define ", for the GLSL; with room for as many edges as the C++ keeps, or for others.
inline std::vector<std::string> wedge_defines(
    const PenumbraWedgeOptions& options,
    int union_edges = static_cast<int>(penumbra::detail::UnionBlender<float>::most_edges)) {
    const auto define = [](const char* name, int value) {
        return std::string("PENUMBRA_PENUMBRA_WEDGE_") + name + " " + std::to_string(value);
    };
    return {define("OVERLAP", static_cast<int>(options.overlap)),
            define("SILHOUETTE", static_cast<int>(options.silhouette)), define("BITMASK_SIZE", options.bitmask_size),
            define("UNION_EDGES", union_edges),
            "PENUMBRA_PENUMBRA_WEDGE_TOLERANCE " + std::to_string(options.tolerance)};
}
inline std::string wedge_name(const PenumbraWedgeOptions& options) {
    constexpr const char* names[] = {"additive",  "maximum",           "product",  "quadrants", "rectangles",
                                     "centroids", "rectangle product", "bitmask ", "exact"};
    return names[static_cast<int>(options.overlap)] +
           (options.overlap == OverlapRule::bitmask ? std::to_string(options.bitmask_size) : "") +
           (options.silhouette == SilhouetteFrom::point ? "" : ", from the light") +
           (options.tolerance > 0.0F ? ", tolerant" : "");
}

/// A shadow of a scene, points in it, and what they see by the C++.
struct WedgeCase {
    PenumbraWedgeShadow<float> shadow;
    WedgeTexels texels;
    std::vector<Vec3<float>> points_ls;
    std::vector<float> truth;

    WedgeCase(const Scene& scene, const PenumbraWedgeOptions& options, int count)
        : shadow(scene.casters, {{0, 4, 0}, {scene.light.x, 0, 0}, {0, 0, scene.light.y}}, options),
          texels(wedge_texels(shadow)) {
        for (const Vec3<float>& point : points_in(scene, count)) {
            points_ls.push_back(penumbra::detail::to_scaled_light(shadow.frame(), point, 1.0F));
            truth.push_back(shadow.visibility(point));
        }
    }

    int penumbrae() const {
        return static_cast<int>(
            std::count_if(truth.begin(), truth.end(), [](float v) { return v > 0.0F && v < 1.0F; }));
    }
};

}  // namespace penumbra::test
