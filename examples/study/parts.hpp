// Light, penumbra and umbra: where they lie in a picture, as the truth has it and as a method does.
#pragma once

#include <string>
#include <vector>

#include "../pictures/picture.hpp"
#include "rays.hpp"
#include "result.hpp"
#include "view.hpp"

namespace penumbra::study {

using namespace pictures;

enum class Part { umbra, penumbra, light };  // from dark to bright

/// Visibility of exactly 0, between, exactly 1; one a point.
std::vector<Part> parts_of(const std::vector<float>& visibility);

/// The parts by `visibility` of few rays, at the view's points. Few rays miss thin slices of the light, which lie at
/// its rim where a part begins: from points near a border, the rim is traced too.
std::vector<Part> true_parts(const reference::Scene& traced, const Scene& scene, const View& view,
                             std::vector<float> visibility);

/// Of a setting's parts with the truth's.
Agreement agreement(const std::string& setting, const std::vector<Part>& parts, const std::vector<Part>& truth);

/// The parts in greys; where they are not the truth's, red if they are too bright and blue if they are too dark.
Image<Rgb> parts_picture(const View& view, const std::vector<Part>& parts, const std::vector<Part>& truth);

}  // namespace penumbra::study
