#include "view.hpp"

#include <algorithm>
#include <numeric>

namespace penumbra::study {
namespace {

constexpr int tile = 8, block = 32;

/// The pixels of a square of the picture: its quarters one after the other, down to tiles, whose rows follow.
void add_square(int left, int top, int size, int width, int height, std::vector<std::size_t>& order) {
    if (left >= width || top >= height) return;
    if (size > tile) {
        const int half = size / 2;
        for (int k = 0; k < 4; ++k) add_square(left + k % 2 * half, top + k / 2 * half, half, width, height, order);
        return;
    }
    for (int y = top; y < std::min(top + size, height); ++y)
        for (int x = left; x < std::min(left + size, width); ++x)
            order.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x));
}

/// All pixels, tile by tile.
std::vector<std::size_t> tiled(int width, int height) {
    std::vector<std::size_t> order;
    for (int top = 0; top < height; top += block)
        for (int left = 0; left < width; left += block) add_square(left, top, block, width, height, order);
    return order;
}

}  // namespace

View look(const Scene& scene, int width, int height) {
    std::vector<Mesh<float>> surfaces = scene.casters;
    surfaces.push_back(scene.ground);
    const reference::Scene traced(surfaces);
    const Camera& camera = scene.camera;
    const Vec3<float> forward = glm::normalize(camera.target - camera.eye);
    const Vec3<float> right = glm::normalize(glm::cross(forward, Vec3<float>(0.0F, 1.0F, 0.0F)));
    const Vec3<float> up = glm::cross(right, forward);

    const Vec3<float> light = center_of(scene.light);

    View view;
    view.width = width;
    view.height = height;
    view.hit.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (const std::size_t i : tiled(width, height)) {
        const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
        const float unit = 2.0F * camera.width_tan / static_cast<float>(width);
        const float across = (static_cast<float>(x) + 0.5F - static_cast<float>(width) * 0.5F) * unit;
        const float above = (static_cast<float>(height) * 0.5F - static_cast<float>(y) - 0.5F) * unit;
        const Vec3<float> direction = glm::normalize(forward + right * across + up * above);
        const auto hit = traced.closest_hit(camera.eye, direction);
        if (!hit) continue;
        view.hit[i] = true;
        const Vec3<float>& point = hit->point;
        const Vec3<float> normal = glm::dot(hit->normal, direction) < 0.0F ? hit->normal : -hit->normal;
        const float cosine = glm::dot(normal, glm::normalize(light - point));
        if (!(cosine > 0.0F)) continue;
        view.points.push_back(point);
        view.pixel.push_back(i);
        view.cosine.push_back(cosine);
        view.on_caster.push_back(hit->mesh + 1 < surfaces.size());
    }
    return view;
}

std::vector<std::size_t> spread(const View& view, std::size_t count, std::size_t run) {
    const std::size_t all = view.points.size(), runs = std::max<std::size_t>(std::min(count, all) / run, 1);
    const std::size_t last = all - std::min(run, all);
    std::size_t step = runs * 5 / 8 + 1;
    while (std::gcd(step, runs) != 1) ++step;  // so that each run comes up once
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < runs; ++k)
        for (std::size_t i = 0; i < std::min(run, all); ++i) chosen.push_back(k * step % runs * last / runs + i);
    return chosen;
}

}  // namespace penumbra::study
