// Which pictures are drawn of a scene that was measured.
#pragma once

#include <filesystem>
#include <vector>

#include "measured.hpp"

namespace penumbra::study {

/// The truth and the settings worth seeing; beside the truth, what figures of papers compare on such a scene.
void draw(const Measured& measured, const std::vector<Candidate>& candidates, const std::filesystem::path& folder,
          Study& study);

}  // namespace penumbra::study
