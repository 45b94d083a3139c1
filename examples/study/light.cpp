#include "light.hpp"

#include <fmt/format.h>

#include <cmath>

namespace penumbra::study {
namespace {

using Rectangle = RectLight<float>;
using Disk = DiskLight<float>;

const char* kind_name(const Rectangle&) { return "rectangle"; }
const char* kind_name(const Disk&) { return "disk"; }

std::string size_text(const Rectangle& light) {
    return fmt::format("{:.3g} × {:.3g}", 2.0F * glm::length(light.half_u), 2.0F * glm::length(light.half_v));
}
std::string size_text(const Disk& light) { return fmt::format("of radius {:.3g}", light.radius); }

Light with_size(const Rectangle& light, float size) {
    return Rectangle{light.center, light.half_u * size, light.half_v * size};
}
Light with_size(const Disk& light, float size) { return Disk{light.center, light.normal, light.radius * size}; }

Disk as_other(const Rectangle& light) {
    const Vec2<float> half = half_size(light);
    return {light.center, light_frame(light).normal, std::sqrt(4.0F * half.x * half.y / pi<float>)};
}
Rectangle as_other(const Disk& light) {
    const LightFrame<float> frame = light_frame(light);
    const float half = 0.5F * std::sqrt(pi<float>) * light.radius;
    return {light.center, frame.u * half, frame.v * half};
}

std::vector<Vec3<float>> corners(const Rectangle& light) {
    const Vec3<float> u = light.half_u, v = light.half_v;
    return {light.center + u + v, light.center - u + v, light.center - u - v, light.center + u - v};
}
std::vector<Vec3<float>> corners(const Disk& light) {
    constexpr int count = 64;
    const LightFrame<float> frame = light_frame(light);
    std::vector<Vec3<float>> points;
    for (int i = 0; i < count; ++i) {
        const float angle = 2.0F * pi<float> * static_cast<float>(i) / count;
        points.push_back(light.center + light.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
    }
    return points;
}

}  // namespace

std::vector<std::string> light_kinds() { return {kind_name(Rectangle()), kind_name(Disk())}; }

std::string kind_of(const Light& light) {
    return std::visit([](const auto& it) { return kind_name(it); }, light);
}

Vec3<float> center_of(const Light& light) {
    return std::visit([](const auto& it) { return it.center; }, light);
}

std::string text_of(const Light& light) {
    const std::string size = std::visit([](const auto& it) { return size_text(it); }, light);
    return fmt::format("{} {}, {:.3g} above the ground", kind_of(light), size, center_of(light).y);
}

Light scaled(const Light& light, float size) {
    return std::visit([&](const auto& it) { return with_size(it, size); }, light);
}

std::vector<LinearLight<float>> rim(const Light& light) {
    const std::vector<Vec3<float>> points = std::visit([](const auto& it) { return corners(it); }, light);
    std::vector<LinearLight<float>> pieces;
    for (std::size_t i = 0; i < points.size(); ++i) pieces.push_back({points[i], points[(i + 1) % points.size()]});
    return pieces;
}

Light as_kind(const Light& light, const std::string& kind) {
    if (kind == kind_of(light)) return light;
    return std::visit([](const auto& it) -> Light { return as_other(it); }, light);
}

}  // namespace penumbra::study
