// Prefilters of occlusion textures: summed-area tables, N-Buffers or mip-maps of slices.
#pragma once

#include <glm/glm.hpp>
#include <penumbra/occlusion_texture/options.hpp>
#include <vector>

#include "../gl/texture.hpp"
#include "program_cache.hpp"

namespace penumbra::opengl {

/// A stack of slices, four to a layer of RGBA8, and what is made of them for occlusion_texture/shadow.glsl. Stacks are
/// filtered in step, so that a compute pass waits once for both masks and depths.
class SliceFilterPasses {
  public:
    struct Stack {
        Texture slices;                    ///< to be drawn to: layers [0, groups), level 0
        Texture rows;                      ///< tables by compute only, RGBA32UI: sums along rows
        Texture tables;                    ///< tables only, R32UI: a layer a slice
        std::vector<Framebuffer> targets;  ///< fragment passes only: what they write, in their order
    };

    SliceFilterPasses() = default;
    /// `size` is what slices need; of `groups` layers.
    SliceFilterPasses(ProgramCache& programs, SliceFilter filter, bool compute, glm::ivec2 size, int groups,
                      int stacks);

    const Texture& slices(int stack) const { return stacks_[static_cast<std::size_t>(stack)].slices; }
    /// What the shading pass samples.
    const Texture& filtered(int stack) const {
        return filter_ == SliceFilter::summed_area ? stacks_[static_cast<std::size_t>(stack)].tables : slices(stack);
    }
    /// Slices to a layer of it.
    int channels() const { return filter_ == SliceFilter::summed_area ? 1 : 4; }
    int levels() const { return levels_; }
    /// After slices were drawn.
    void run() const;

  private:
    void make_n_buffers(ProgramCache& programs, glm::ivec2 size);
    void make_tables(ProgramCache& programs, glm::ivec2 size);
    void draw_levels() const;
    void dispatch_levels() const;
    void draw_steps() const;
    void dispatch_scans() const;

    SliceFilter filter_ = SliceFilter::summed_area;
    bool compute_ = false;
    int groups_ = 0, levels_ = 1;
    std::vector<Stack> stacks_;
    const Program *level_ = nullptr, *first_ = nullptr, *last_ = nullptr;
    Texture scratch_[2];  // tables by fragment passes, RGBA32UI: steps write them in turn
    Framebuffer scratch_targets_[2];
    std::vector<glm::ivec2> reaches_;  // of the steps
};

}  // namespace penumbra::opengl
