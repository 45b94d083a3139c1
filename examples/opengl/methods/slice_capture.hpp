// Occlusion textures as they are captured: the casters as the light sees them, and the passes that slice them.
#pragma once

#include <cstddef>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/occlusion_texture/options.hpp>
#include <vector>

#include "../geometry.hpp"
#include "../gl/texture.hpp"
#include "program_cache.hpp"

namespace penumbra::opengl {

/// What the host finds out: an engine may take bounds of its casters in place of their vertices.
struct SliceView {
    /// Casters that are drawn alike.
    struct Run {
        std::size_t first, end;
        bool encloses;    ///< closed, on the lit side, and options say that it matters
        bool inside_out;  ///< such a one whose triangles look inwards
    };
    LightFrame<float> frame;
    Vec2<float> half_size;  ///< of the light
    SliceCamera<float> camera;
    SliceRange<float> range;
    SliceFaces faces = SliceFaces::solid;
    bool closes_leaks = false;
    std::vector<Run> runs;

    SliceView() = default;
    SliceView(const std::vector<Mesh<float>>& casters, const RectLight<float>& light,
              const OcclusionTextureOptions& options);
    bool has_solids() const;  ///< that are to be filled
};

/// Draws casters to layers of slices, four slices a layer of RGBA8.
class SliceCapturePasses {
  public:
    SliceCapturePasses() = default;
    /// Final masks go to `masks`, depths to `depths` unless it is null; both outlive the passes.
    SliceCapturePasses(ProgramCache& programs, const Texture& masks, const Texture* depths, int groups, bool solids);

    /// `clip_zero_to_one`: see slice_capture.vert.
    void capture(const SliceView& view, const Geometry& geometry, bool clip_zero_to_one) const;
    /// Whether what is captured is not yet final.
    bool needs_resolve() const { return resolve_ != nullptr; }
    void resolve() const;

  private:
    /// Slices that one draw captures, up to 16.
    struct Draw {
        int first, groups;
        const Program *surfaces, *windings;
        Framebuffer surface_target, winding_target;
    };
    void begin(const Program& program, const Draw& draw, const SliceView& view, bool clip_zero_to_one) const;
    void draw_surfaces(const Draw& draw, const SliceView& view, const Geometry& geometry) const;
    void draw_windings(const Draw& draw, const SliceView& view, const Geometry& geometry) const;

    Texture masks_, depths_, windings_;  // as captured, where that is not yet final
    bool has_depths_ = false, has_solids_ = false;
    glm::ivec2 size_{0, 0};
    std::vector<Draw> draws_;
    const Program* resolve_ = nullptr;
    std::vector<Framebuffer> resolve_targets_;  // one a layer
};

}  // namespace penumbra::opengl
