// The light of a scene: a rectangle or a disk.
#pragma once

#include <penumbra/light.hpp>
#include <string>
#include <variant>
#include <vector>

namespace penumbra::study {

using Light = std::variant<RectLight<float>, DiskLight<float>>;

/// "rectangle", "disk".
std::vector<std::string> light_kinds();
std::string kind_of(const Light& light);

Vec3<float> center_of(const Light& light);

/// "rectangle 4 × 4, 9 above the ground", the ground being at y = 0.
std::string text_of(const Light& light);

/// Sides or radius multiplied by `size`.
Light scaled(const Light& light, float size);

/// The rim in straight pieces: a disk's in 64, whose ends are on it.
std::vector<LinearLight<float>> rim(const Light& light);

/// A light of that kind with the same centre, direction and area.
Light as_kind(const Light& light, const std::string& kind);

}  // namespace penumbra::study
