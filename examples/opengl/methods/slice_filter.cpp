#include "slice_filter.hpp"

#include <algorithm>
#include <penumbra/numeric.hpp>

namespace penumbra::opengl {
namespace {

int levels_of(glm::ivec2 size) {
    int levels = 1;
    while (1 << (levels - 1) < std::max(size.x, size.y)) ++levels;
    return levels;
}

}  // namespace

SliceFilterPasses::SliceFilterPasses(ProgramCache& programs, SliceFilter filter, bool compute, glm::ivec2 size,
                                     int groups, int stacks)
    : filter_(filter), compute_(compute && filter != SliceFilter::mipmap), groups_(groups) {
    if (filter != SliceFilter::summed_area) levels_ = levels_of(size);
    stacks_.resize(static_cast<std::size_t>(stacks));
    if (filter == SliceFilter::n_buffer) make_n_buffers(programs, size);
    if (filter == SliceFilter::summed_area) make_tables(programs, size);
    if (filter ==
        SliceFilter::mipmap)  // squares of a power of two: each level is half of the one before, as in the C++
        for (Stack& stack : stacks_)
            stack.slices = Texture::array(GL_RGBA8, glm::ivec2(1 << (levels_ - 1)), groups, levels_);
}

void SliceFilterPasses::make_n_buffers(ProgramCache& programs, glm::ivec2 size) {
    level_ = compute_ ? &programs.compute({{}, {library("occlusion_texture/n_buffer_level.comp")}})
                      : &programs.full_screen({{}, {library("occlusion_texture/n_buffer_level.frag")}});
    for (Stack& stack : stacks_) {
        stack.slices = Texture::array(GL_RGBA8, size, groups_ * levels_);
        if (compute_) continue;
        for (int layer = groups_; layer < groups_ * levels_; ++layer)
            stack.targets.emplace_back(std::vector<Framebuffer::Target>{{stack.slices, layer}});
    }
}

/// A table has a row and a column more than the slices.
void SliceFilterPasses::make_tables(ProgramCache& programs, glm::ivec2 size) {
    const glm::ivec2 sums = size + 1;
    for (Stack& stack : stacks_) {
        stack.slices = Texture::array(GL_RGBA8, size, groups_);
        stack.tables = Texture::array(GL_R32UI, sums, 4 * groups_);
        if (compute_) {
            stack.rows = Texture::array(GL_RGBA32UI, sums, groups_);
            continue;
        }
        for (int layer = 0; layer < 4 * groups_; layer += 4)
            stack.targets.emplace_back(std::vector<Framebuffer::Target>{{stack.tables, layer},
                                                                        {stack.tables, layer + 1},
                                                                        {stack.tables, layer + 2},
                                                                        {stack.tables, layer + 3}});
    }
    if (compute_) {
        const std::string_view scan = library("occlusion_texture/summed_area_scan.comp");
        first_ = &programs.compute({{"PENUMBRA_SCAN_COLUMNS 0"}, {scan}});
        last_ = &programs.compute({{"PENUMBRA_SCAN_COLUMNS 1", "PENUMBRA_SCAN_CHANNELS 1"}, {scan}});
        return;
    }
    const std::string_view step = library("occlusion_texture/summed_area_step.frag");
    first_ = &programs.full_screen({{}, {step}});
    last_ = &programs.full_screen({{"PENUMBRA_STEP_CHANNELS 1"}, {step}});
    for (int i = 0; i < 2; ++i) {
        scratch_[i] = Texture::array(GL_RGBA32UI, sums, 1);
        scratch_targets_[i] = Framebuffer({{scratch_[i]}});
    }
    reaches_ = {{0, 0}};
    for (int reach = 1; reach < sums.x; reach *= 4) reaches_.emplace_back(reach, 0);
    for (int reach = 1; reach < sums.y; reach *= 4) reaches_.emplace_back(0, reach);
}

void SliceFilterPasses::run() const {
    if (filter_ == SliceFilter::mipmap)
        for (const Stack& stack : stacks_) stack.slices.generate_mipmap();
    else if (filter_ == SliceFilter::n_buffer)
        compute_ ? dispatch_levels() : draw_levels();
    else
        compute_ ? dispatch_scans() : draw_steps();
    if (compute_) glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SliceFilterPasses::draw_levels() const {
    State{}.set();
    level_->use();
    for (const Stack& stack : stacks_) {
        level_->set("penumbra_levels", 0, stack.slices);
        for (int before = 0; before < groups_ * (levels_ - 1); ++before) {
            stack.targets[static_cast<std::size_t>(before)].bind();
            level_->set("penumbra_layer", before);
            level_->set("penumbra_level", before / groups_);
            level_->draw_full_screen();
        }
    }
}

void SliceFilterPasses::dispatch_levels() const {
    level_->use();
    for (int level = 1; level < levels_; ++level) {
        level_->set("penumbra_layers", groups_ * glm::ivec2(level - 1, level));
        level_->set("penumbra_level", level - 1);
        for (const Stack& stack : stacks_) {
            stack.slices.bind_image(0, GL_READ_ONLY);
            stack.slices.bind_image(1, GL_WRITE_ONLY);
            const glm::uvec2 tiles = (glm::uvec2(stack.slices.size()) + 7U) / 8U;
            glDispatchCompute(tiles.x, tiles.y, static_cast<GLuint>(groups_));
        }
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
}

void SliceFilterPasses::draw_steps() const {
    State{}.set();
    for (const Stack& stack : stacks_) {
        for (int group = 0; group < groups_; ++group) {
            for (std::size_t i = 0; i < reaches_.size(); ++i) {
                const bool is_last = i + 1 == reaches_.size();
                const Program& step = is_last ? *last_ : *first_;
                (is_last ? stack.targets[static_cast<std::size_t>(group)] : scratch_targets_[i % 2]).bind();
                step.use();
                step.set("penumbra_slices", 0, stack.slices);
                step.set("penumbra_sums", 1, scratch_[1 - i % 2]);
                step.set("penumbra_layer", i == 0 ? group : 0);
                step.set("penumbra_reach", reaches_[i]);
                step.draw_full_screen();
            }
        }
    }
}

void SliceFilterPasses::dispatch_scans() const {
    first_->use();
    for (const Stack& stack : stacks_) {
        first_->set("penumbra_slices", 0, stack.slices);
        stack.rows.bind_image(0, GL_WRITE_ONLY);
        glDispatchCompute(static_cast<GLuint>(stack.rows.size().y), static_cast<GLuint>(groups_), 1);
    }
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    last_->use();
    for (const Stack& stack : stacks_) {
        stack.tables.bind_image(0, GL_WRITE_ONLY);
        stack.rows.bind_image(1, GL_READ_ONLY);
        glDispatchCompute(static_cast<GLuint>(stack.rows.size().x), static_cast<GLuint>(groups_), 1);
    }
}

}  // namespace penumbra::opengl
