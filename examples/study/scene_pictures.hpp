// Pictures of a scene: its truth, settings beside it, what figures of papers compare, and its light, penumbra and
// umbra.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "result.hpp"
#include "settings.hpp"
#include "view.hpp"

namespace penumbra::study {

/// Visibility at a view's points, and what is written above its picture.
struct Shown {
    std::string title;
    std::vector<float> visibility;
};

/// Writes pictures of one scene into a folder.
class ScenePictures {
  public:
    /// `truth` is visibility at the view's points. Writes its picture.
    ScenePictures(const Scene& scene, const View& view, std::vector<float> truth, std::filesystem::path folder);

    /// A setting's picture, its difference, and a panel of both with the truth. `special` says what is special about
    /// the setting.
    Picture draw(const Row& row, const Built& built, const std::string& special) const;

    /// Light, penumbra and umbra as the truth has them, and as named settings do.
    Parts parts(const reference::Scene& traced,
                const std::vector<std::pair<std::string, const Built*>>& settings) const;

    /// The truth, for a triplet.
    Shown truth() const;
    /// Side by side, from left to right.
    Triplet triplet(const std::vector<Shown>& shown, const std::string& caption) const;

    /// Seconds that a picture of the setting would take, on all cores.
    double seconds(const Row& row) const;

  private:
    const Scene& scene_;
    const View& view_;
    std::vector<float> truth_;
    std::filesystem::path folder_;
    std::string file_;  // what names of files begin with
};

}  // namespace penumbra::study
