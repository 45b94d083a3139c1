#include "light.hpp"

#include <fmt/format.h>

#include <cmath>

namespace penumbra::scenes {
namespace {

using Rectangle = RectLight<float>;
using Disk = DiskLight<float>;
using Line = LinearLight<float>;

const char* kind_name(const Rectangle&) { return "rectangle"; }
const char* kind_name(const Disk&) { return "disk"; }
const char* kind_name(const Line&) { return "line"; }

Vec3<float> center(const Line& light) { return 0.5F * (light.a + light.b); }
template <class Other>
Vec3<float> center(const Other& light) {
    return light.center;
}

std::string size_text(const Rectangle& light) {
    return fmt::format("{:.3g} × {:.3g}", 2.0F * glm::length(light.half_u), 2.0F * glm::length(light.half_v));
}
std::string size_text(const Disk& light) { return fmt::format("of radius {:.3g}", light.radius); }
std::string size_text(const Line& light) { return fmt::format("of length {:.3g}", glm::length(light.b - light.a)); }

Light with_size(const Rectangle& light, float size) {
    return Rectangle{light.center, light.half_u * size, light.half_v * size};
}
Light with_size(const Disk& light, float size) { return Disk{light.center, light.normal, light.radius * size}; }
Light with_size(const Line& light, float size) {
    const Vec3<float> middle = center(light), half = 0.5F * (light.b - light.a) * size;
    return Line{middle - half, middle + half};
}

LightFrame<float> downwards(const Line& light) { return light_frame(light, Vec3<float>(0.0F, -1.0F, 0.0F)); }
float half_length(const Line& light) { return 0.5F * glm::length(light.b - light.a); }

Disk as_disk(const Disk& light) { return light; }
Disk as_disk(const Line& light) { return {center(light), downwards(light).normal, half_length(light)}; }
Disk as_disk(const Rectangle& light) {
    const Vec2<float> half = half_size(light);
    return {light.center, light_frame(light).normal, std::sqrt(4.0F * half.x * half.y / pi<float>)};
}

Rectangle as_rectangle(const Rectangle& light) { return light; }
Rectangle as_rectangle(const Line& light) {
    const LightFrame<float> frame = downwards(light);
    return {center(light), frame.u * half_length(light), frame.v * half_length(light)};
}
Rectangle as_rectangle(const Disk& light) {
    const LightFrame<float> frame = light_frame(light);
    const float half = 0.5F * std::sqrt(pi<float>) * light.radius;
    return {light.center, frame.u * half, frame.v * half};
}

Line as_line(const Line& light) { return light; }
Line as_line(const Rectangle& light) { return {light.center - light.half_u, light.center + light.half_u}; }
Line as_line(const Disk& light) {
    const Vec3<float> along = light_frame(light).u * light.radius;
    return {light.center - along, light.center + along};
}

std::vector<Vec3<float>> corners(const Line& light) { return {light.a, light.b}; }
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

std::vector<std::string> light_kinds() { return {kind_name(Rectangle()), kind_name(Disk()), kind_name(Line())}; }

std::string kind_of(const Light& light) {
    return std::visit([](const auto& it) { return kind_name(it); }, light);
}

Vec3<float> center_of(const Light& light) {
    return std::visit([](const auto& it) { return center(it); }, light);
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
    const std::size_t count = points.size() > 2 ? points.size() : 1;  // a line does not lead back
    for (std::size_t i = 0; i < count; ++i) pieces.push_back({points[i], points[(i + 1) % points.size()]});
    return pieces;
}

Light as_kind(const Light& light, const std::string& kind) {
    const auto converted = [&](const auto& it) -> Light {
        if (kind == kind_name(Line())) return as_line(it);
        if (kind == kind_name(Disk())) return as_disk(it);
        return as_rectangle(it);
    };
    return std::visit(converted, light);
}

}  // namespace penumbra::scenes
