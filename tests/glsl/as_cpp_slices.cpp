// The twins of kernels, cameras, slices and boxes, compiled as C++, against the C++ in float.
#include <doctest/doctest.h>

#include <penumbra/detail/boxes.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/occlusion_texture/slices.hpp>

#include "as_cpp_compare.hpp"

using namespace penumbra::test::as_cpp;

namespace {

penumbra::SliceCamera<float> camera(const float* i) {
    penumbra::SliceCamera<float> c;
    c.convergence = i[0], c.origin_tx = v2(i + 1), c.scale_tx = v2(i + 3);
    return c;
}
glsl::penumbra_SliceCamera camera_twin(const float* i) { return {i[0], v2(i + 1), v2(i + 3), 1, 1}; }
penumbra::SliceRange<float> range(const float* i) { return {i[0], i[1], static_cast<int>(i[2])}; }
glsl::penumbra_SliceRange range_twin(const float* i) { return {i[0], i[1], static_cast<int>(i[2])}; }

}  // namespace

TEST_CASE("occlusion_texture") {
    compare<3>(
        "kernel_scale, kernel_size",
        CALL { return floats(penumbra::kernel_scale(i[0], i[1]), penumbra::kernel_size(i[0], i[1], i[2])); },
        CALL { return floats(glsl::penumbra_kernel_scale(i[0], i[1]), glsl::penumbra_kernel_size(i[0], i[1], i[2])); },
        moderate_all<3>, 8, [](const float* i) { return std::max(1.0F, std::abs(i[2])); });
    compare<8>(
        "kernel_rect", CALL { return ends(penumbra::kernel_rect(i[0], v3(i + 1), rect(i + 4))); },
        CALL { return ends(glsl::penumbra_kernel_rect(i[0], v3(i + 1), rect_twin(i + 4))); }, moderate_all<8>, 8,
        [](const float* i) { return largest(i + 1, 2) + largest(i + 4, 4); });
    const Change seen = [](float* i) {
        moderate_all<13>(i), i[0] = share(i[0]);
        for (const int k : {5, 7, 8}) i[k] = std::abs(i[k]);  // depths
    };
    compare<13>(
        "SliceCamera::project",
        CALL {
            const auto v = camera(i).project(v3(i + 5));
            return floats(v.x, v.y, v.depth, v.w);
        },
        CALL { return floats(glsl::penumbra_project(camera_twin(i), v3(i + 5))); }, seen, 8,
        [](const float* i) {
            const float w = 1.0F + i[0] * i[7];
            return std::max(w, largest(i + 5, 2) * largest(i + 3, 2) + largest(i + 1, 2) * w);
        });
    compare<13>(
        "SliceCamera::footprint", CALL { return ends(camera(i).footprint(i[5], v3(i + 6), rect(i + 9))); },
        CALL { return ends(glsl::penumbra_footprint(camera_twin(i), i[5], v3(i + 6), rect_twin(i + 9))); }, seen, 16,
        [](const float* i) {
            const float w = 1.0F + i[0] * i[5];
            return largest(i + 1, 2) + (largest(i + 6, 2) + largest(i + 9, 4)) * largest(i + 3, 2) / w;
        });
    // depths at and within a few ULP of boundaries; without same bits only half-way between them
    const Change sliced = [](float* i) {
        i[0] = moderate(i[0]), i[1] = i[3] > 0.0F ? std::abs(moderate(i[1])) : 0.0F, i[2] = whole(i[2], 1, 64);
        i[3] = whole(i[3], 0, 64), i[4] = penumbra::clamp(moderate(i[4]), -2.0F, 66.0F);
        if (!same_bits) {
            i[0] = std::floor(i[0]), i[1] = std::ldexp(1.0F, static_cast<int>(whole(i[1], -2, 6)));
            i[4] = std::floor(i[4]) + 0.5F;
        }
        i[4] = i[0] + i[1] * i[4];
    };
    compare<5>(
        "SliceRange",
        CALL {
            const int slice = static_cast<int>(i[3]);
            return floats(range(i).top(slice), range(i).bottom(slice), range(i).slice_of(i[4]));
        },
        CALL {
            const int slice = static_cast<int>(i[3]);
            return floats(glsl::penumbra_top(range_twin(i), slice), glsl::penumbra_bottom(range_twin(i), slice),
                          glsl::penumbra_slice_of(range_twin(i), i[4]));
        },
        sliced, 4, [](const float* i) { return std::abs(i[0]) + 65.0F * i[1]; });
    compare<3>(
        "relative_depth", CALL { return floats(penumbra::relative_depth(i[0], i[1], i[2])); },
        CALL { return floats(glsl::penumbra_relative_depth(i[0], i[1], i[2])); },
        [](float* i) { moderate_all<3>(i), i[1] = std::abs(i[1]); }, 8, [](const float*) { return 4.0F; });
    compare<3>(
        "slice_plane_depth",
        CALL {
            return floats(penumbra::slice_plane_depth(i[0], i[1], i[2], penumbra::SlicePlane::bottom),
                          penumbra::slice_plane_depth(i[0], i[1], i[2], penumbra::SlicePlane::middle));
        },
        CALL {
            return floats(glsl::penumbra_slice_plane_depth(i[0], i[1], i[2], PENUMBRA_SLICE_PLANE_BOTTOM),
                          glsl::penumbra_slice_plane_depth(i[0], i[1], i[2], PENUMBRA_SLICE_PLANE_MIDDLE));
        },
        moderate_all<3>, 4, largest_of<3>);
    compare<3>(
        "slice_weight",
        CALL {
            return floats(penumbra::slice_weight(i[0], i[1], i[2], penumbra::SelfShadow::fade),
                          penumbra::slice_weight(i[0], i[1], i[2], penumbra::SelfShadow::clear),
                          penumbra::slice_weight(i[0], i[1], i[2], penumbra::SelfShadow::mean_depth));
        },
        CALL {
            return floats(glsl::penumbra_slice_weight(i[0], i[1], i[2], PENUMBRA_SELF_SHADOW_FADE),
                          glsl::penumbra_slice_weight(i[0], i[1], i[2], PENUMBRA_SELF_SHADOW_CLEAR),
                          glsl::penumbra_slice_weight(i[0], i[1], i[2], PENUMBRA_SELF_SHADOW_MEAN_DEPTH));
        },
        [](float* i) { i[0] = 4.0F * share(i[0]), i[1] = share(i[1]), i[2] = std::max(0.001F, share(i[2])); }, 8,
        [](const float* i) { return 4.0F / i[2]; });
}

TEST_CASE("boxes") {
    compare<5>(
        "detail::widen",
        CALL {
            float low = i[0], high = i[1];
            penumbra::detail::widen(low, high, i[4]);
            const auto box = penumbra::detail::widen(rect(i));
            return floats(low, high, box.min, box.max);
        },
        CALL {
            const auto box = glsl::penumbra_widen(rect_twin(i));
            return floats(glsl::penumbra_widen(v2(i), i[4]), box.min, box.max);
        },
        [](float* i) { i[4] = std::max(0.0625F, share(i[4])); }, 4,
        [](const float* i) { return std::min(largest(i, 4), 1e9F); });
    const Change positive = [](float* i) {  // sides in eighths, whose ratios round only at exact ties
        moderate_all<4>(i);
        if (!same_bits)
            for (int k = 0; k < 4; ++k) i[k] = whole(i[k], 0, 4000) / 8.0F;
        i[2] = i[0] + 0.0625F + std::abs(i[2]), i[3] = i[1] + 0.0625F + std::abs(i[3]);
    };
    compare<4>(
        "detail::square_tiles", CALL { return tiles(penumbra::detail::square_tiles(rect(i))); },
        CALL { return tiles(glsl::penumbra_square_tiles(rect_twin(i))); }, positive, 8, largest_of<4>);
}
