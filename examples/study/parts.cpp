#include "parts.hpp"

#include <algorithm>
#include <cstddef>

namespace penumbra::study {
namespace {

/// Is any pixel within `reach` of pixel `i`, in x and in y, in another part?
bool near_border(const Image<int>& part, std::size_t i, int reach) {
    const int width = part.width(), x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const int own = part(x, y);
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, part.height() - 1); ++v)
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u)
            if (part(u, v) >= 0 && part(u, v) != own) return true;
    return false;
}

}  // namespace

std::vector<Part> parts_of(const std::vector<float>& visibility) {
    std::vector<Part> parts;
    for (const float v : visibility) parts.push_back(v <= 0.0F ? Part::umbra : v < 1.0F ? Part::penumbra : Part::light);
    return parts;
}

std::vector<Part> true_parts(const reference::Scene& traced, const Scene& scene, const View& view,
                             std::vector<float> visibility) {
    constexpr int reach = 5;  // pixels
    const std::vector<Part> rough = parts_of(visibility);
    Image<int> part(view.width, view.height, -1);
    for (std::size_t i = 0; i < rough.size(); ++i) part.data()[view.pixel[i]] = static_cast<int>(rough[i]);
    std::vector<std::size_t> again;
    Points points;
    for (std::size_t i = 0; i < rough.size(); ++i) {
        if (rough[i] == Part::penumbra || !near_border(part, view.pixel[i], reach)) continue;
        again.push_back(i);
        points.push_back(view.points[i]);
    }
    const std::vector<float> at_rim = trace_rim(traced, scene, points, 2048);
    for (std::size_t k = 0; k < again.size(); ++k)
        if (at_rim[k] != visibility[again[k]]) visibility[again[k]] = 0.5F;
    return parts_of(visibility);
}

Agreement agreement(const std::string& setting, const std::vector<Part>& parts, const std::vector<Part>& truth) {
    double all = 0.0, shadow = 0.0, shadows = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const bool right = parts[i] == truth[i];
        all += right;
        if (truth[i] == Part::light) continue;
        shadow += right;
        shadows += 1.0;
    }
    return {setting, all / std::max(static_cast<double>(truth.size()), 1.0), shadows > 0.0 ? shadow / shadows : 1.0};
}

Image<Rgb> parts_picture(const View& view, const std::vector<Part>& parts, const std::vector<Part>& truth) {
    constexpr Rgb greys[] = {{70, 72, 78}, {150, 152, 158}, {240, 240, 238}}, nothing{196, 198, 202};
    Image<Rgb> picture(view.width, view.height, nothing);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const float error = parts[i] > truth[i] ? 0.8F : -0.8F;
        picture.data()[view.pixel[i]] =
            parts[i] == truth[i] ? greys[static_cast<int>(parts[i])] : difference_color(error, 1.0F);
    }
    return picture;
}

}  // namespace penumbra::study
