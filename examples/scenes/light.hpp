// The light of a scene: a rectangle, a disk or a line.
#pragma once

#include <penumbra/light.hpp>
#include <string>
#include <variant>
#include <vector>

namespace penumbra::scenes {

using Light = std::variant<RectLight<float>, DiskLight<float>, LinearLight<float>>;

/// "rectangle", "disk", "line".
std::vector<std::string> light_kinds();
std::string kind_of(const Light& light);

Vec3<float> center_of(const Light& light);

/// "rectangle 4 × 4, 9 above the ground", the ground being at y = 0.
std::string text_of(const Light& light);

/// Sides, radius or length multiplied by `size`.
Light scaled(const Light& light, float size);

/// The rim in straight pieces: a disk's in 64, whose ends are on it; a line is its own.
std::vector<LinearLight<float>> rim(const Light& light);

/// A light of that kind with the same centre and direction: rectangles and disks of the same area, a line along a
/// rectangle's first side or a disk's diameter. Of a line, the square or disk around it that emits downwards.
Light as_kind(const Light& light, const std::string& kind);

}  // namespace penumbra::scenes
