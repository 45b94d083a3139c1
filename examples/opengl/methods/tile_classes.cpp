#include "tile_classes.hpp"

#include <algorithm>
#include <string>

namespace penumbra::opengl {

std::vector<Box3<float>> caster_boxes(const scenes::Scene& scene, const TileView& view) {
    std::vector<Box3<float>> boxes;
    for (const Mesh<float>& mesh : scene.casters) {
        Box3<float> box = empty_box<float>();
        for (const Vec3<float>& p : mesh.positions) box = extend(box, view.frame.to_light(p));
        boxes.push_back(box);
        if (is_empty(box)) continue;
        const Vec3<float> reach = glm::max(glm::abs(box.min), glm::abs(box.max));
        const float rounding = 1e-5F * std::max({reach.x, reach.y, reach.z});
        const float texels = 2.0F * (view.texel + view.texel_slope * std::max(box.max.z, 0.0F));
        const Vec3<float> out = Vec3<float>(texels, texels, view.thickness) + rounding;
        boxes.back() = {box.min - out, box.max + out};
    }
    return boxes;
}

void TileClasses::prepare(const scenes::Scene& scene, const TileView& view) {
    constexpr int width = 1024;
    view_ = view;
    count_ = static_cast<int>(scene.casters.size());
    Image<glm::vec4> boxes(width, 2 * count_ / width + 1);
    glm::vec4* texel = boxes.data();
    for (const Box3<float>& box : caster_boxes(scene, view)) {
        *texel++ = glm::vec4(box.min, 0.0F);
        *texel++ = glm::vec4(box.max, 0.0F);
    }
    casters_ = Texture(boxes);
}

void TileClasses::draw(const Frame& frame) {
    const glm::ivec2 tiles = (frame.size + size - 1) / size;
    if (classify_.empty())
        classify_ =
            Program::full_screen({{"PENUMBRA_TILE_SIZE " + std::to_string(size)}, {library("plan/tile_classes.frag")}});
    if (classes_.empty() || classes_.size() != tiles) {
        classes_ = Texture(GL_R8UI, tiles);
        target_ = Framebuffer({{classes_}});
    }
    State{}.set();
    target_.bind();
    classify_.use();
    classify_.set("penumbra_positions", 0, frame.positions);
    classify_.set("penumbra_casters", 1, casters_);
    classify_.set("penumbra_count", count_);
    classify_.set("penumbra_light", view_.frame);
    classify_.set("penumbra_light_extent.half_size", view_.light.half_size);
    classify_.set("penumbra_light_extent.disk", view_.light.disk);
    classify_.draw_full_screen();
}

}  // namespace penumbra::opengl
