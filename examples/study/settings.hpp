// The settings that the study measures.
#pragma once

#include <vector>

#include "measure.hpp"

namespace penumbra::study {

/// Settings of OcclusionTextureShadow: slices, rules, filters and the rest, swept around the default; `quick` takes a
/// handful.
std::vector<Setting> occlusion_texture_settings(bool quick);

}  // namespace penumbra::study
