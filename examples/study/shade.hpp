// A view with light and shadows on it.
#pragma once

#include <vector>

#include "../pictures/picture.hpp"
#include "view.hpp"

namespace penumbra::study {

using namespace pictures;

/// The picture of `visibility` at the view's points; −1 elsewhere.
Image<float> image_of(const View& view, const std::vector<float>& visibility);

/// The view as a renderer would show it.
Image<Rgb> shade(const View& view, const std::vector<float>& visibility);

}  // namespace penumbra::study
