#include "light_edit.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace penumbra::opengl {

using scenes::Light;

Light moved(const Light& light, const Vec3<float>& by) {
    Light result = light;
    if (auto* rectangle = std::get_if<RectLight<float>>(&result)) rectangle->center += by;
    if (auto* disk = std::get_if<DiskLight<float>>(&result)) disk->center += by;
    if (auto* line = std::get_if<LinearLight<float>>(&result)) line->a += by, line->b += by;
    return result;
}

Light turned(const Light& light, const Vec3<float>& axis, float angle) {
    const glm::mat3 turn(glm::rotate(glm::mat4(1.0F), angle, axis));
    const Vec3<float> center = scenes::center_of(light);
    Light result = light;
    if (auto* rectangle = std::get_if<RectLight<float>>(&result)) {
        rectangle->half_u = turn * rectangle->half_u;
        rectangle->half_v = turn * rectangle->half_v;
    }
    if (auto* disk = std::get_if<DiskLight<float>>(&result)) disk->normal = turn * disk->normal;
    if (auto* line = std::get_if<LinearLight<float>>(&result)) {
        line->a = center + turn * (line->a - center);
        line->b = center + turn * (line->b - center);
    }
    return result;
}

std::vector<LightSize> sizes_of(const Light& light) {
    if (const auto* rectangle = std::get_if<RectLight<float>>(&light))
        return {{"half width", glm::length(rectangle->half_u)}, {"half height", glm::length(rectangle->half_v)}};
    if (const auto* disk = std::get_if<DiskLight<float>>(&light)) return {{"radius", disk->radius}};
    const auto& line = std::get<LinearLight<float>>(light);
    return {{"half length", 0.5F * glm::length(line.b - line.a)}};
}

Light resized(const Light& light, std::size_t index, float value) {
    Light result = light;
    const float factor = value / sizes_of(light)[index].value;
    if (auto* rectangle = std::get_if<RectLight<float>>(&result))
        (index == 0 ? rectangle->half_u : rectangle->half_v) *= factor;
    if (auto* disk = std::get_if<DiskLight<float>>(&result)) disk->radius = value;
    if (auto* line = std::get_if<LinearLight<float>>(&result)) {
        const Vec3<float> half = (line->b - line->a) * (0.5F * factor), center = scenes::center_of(light);
        line->a = center - half;
        line->b = center + half;
    }
    return result;
}

}  // namespace penumbra::opengl
