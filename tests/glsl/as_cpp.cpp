// The twins of the ground floors, compiled as C++, against the C++ in float.
#include <doctest/doctest.h>

#include <penumbra/combine.hpp>
#include <penumbra/light.hpp>

#include "as_cpp_compare.hpp"

using namespace penumbra::test::as_cpp;

TEST_CASE("numeric") {
    const Change ordered = [](float* i) {
        if (i[1] > i[2]) std::swap(i[1], i[2]);
    };
    compare<3>(
        "clamp", CALL { return floats(penumbra::clamp(i[0], i[1], i[2])); },
        CALL { return floats(glsl::penumbra_clamp(i[0], i[1], i[2])); }, ordered);
    compare<1>(
        "saturate", CALL { return floats(penumbra::saturate(i[0])); },
        CALL { return floats(glsl::penumbra_saturate(i[0])); }, anything);
    // the domain in which -ffast-math keeps the result
    const Change ratio = [](float* i) {
        i[1] = std::abs(i[1]);
        if (!same_bits && i[1] > 0.0F) i[1] = penumbra::clamp(i[1], 0x1p-100F, 0x1p120F);
    };
    compare<2>(
        "saturated_ratio", CALL { return floats(penumbra::saturated_ratio(i[0], i[1])); },
        CALL { return floats(glsl::penumbra_saturated_ratio(i[0], i[1])); }, ratio, 4, one);
    compare<3>(
        "safe_ratio", CALL { return floats(penumbra::safe_ratio(i[0], i[1], i[2])); },
        CALL { return floats(glsl::penumbra_safe_ratio(i[0], i[1], i[2])); },
        [](float* i) { i[0] = moderate(i[0]), i[1] = moderate(i[1]); }, 4);
    compare<3>(
        "mix", CALL { return floats(penumbra::mix(i[0], i[1], i[2])); },
        CALL { return floats(glsl::penumbra_mix(i[0], i[1], i[2])); },
        [](float* i) { moderate_all<2>(i), i[2] = share(i[2]); }, 4, largest_of<2>);
    compare<1>(
        "floor_log2, is_finite", CALL { return floats(penumbra::floor_log2(i[0]), penumbra::is_finite(i[0])); },
        CALL { return floats(glsl::penumbra_floor_log2(i[0]), glsl::penumbra_is_finite(i[0])); }, anything);
    compare<1>(
        "exp2_int", CALL { return floats(penumbra::exp2_int<float>(static_cast<int>(i[0]))); },
        CALL { return floats(glsl::penumbra_exp2_int(static_cast<int>(i[0]))); },
        [](float* i) { i[0] = whole(i[0], -126, 127); });
    for (const std::uint32_t bits : {0x7f800000U, 0xff800000U, 0x7fc00000U, 0x7f800001U, 1U, 0x807fffffU, 0U}) {
        float x = 0.0F;  // infinities, NaNs and denormals
        std::memcpy(&x, &bits, sizeof x);
        CHECK(glsl::penumbra_floor_log2(x) == penumbra::floor_log2(x));
        CHECK(glsl::penumbra_is_finite(x) == penumbra::is_finite(x));
    }
}

TEST_CASE("geometry") {
    compare<3>(
        "detail::largest_component", CALL { return floats(penumbra::detail::largest_component(v3(i))); },
        CALL { return floats(glsl::penumbra_largest_component(v3(i))); }, anything);
    compare<1>(
        "detail::exponent_to_unit", CALL { return floats(penumbra::detail::exponent_to_unit(i[0])); },
        CALL { return floats(glsl::penumbra_exponent_to_unit(i[0])); }, anything);
    compare<6>(
        "normalize_or", CALL { return floats(penumbra::normalize_or(v3(i), v3(i + 3))); },
        CALL { return floats(glsl::penumbra_normalize_or(v3(i), v3(i + 3))); }, anything, 8,
        [](const float* i) { return std::max(1.0F, largest(i + 3, 3)); });
    compare<3>(
        "safe_length", CALL { return floats(penumbra::safe_length(v3(i))); },
        CALL { return floats(glsl::penumbra_safe_length(v3(i))); },
        [](float* i) {
            for (int k = 0; k < 3; ++k) i[k] = std::abs(i[k]) > 0x1p126F ? 1.0F : i[k];
        },
        8);
    compare<3>(
        "any_perpendicular", CALL { return floats(penumbra::any_perpendicular(v3(i))); },
        CALL { return floats(glsl::penumbra_any_perpendicular(v3(i))); }, put_unit, 8, one);
    compare<4>(
        "extent, area", CALL { return floats(penumbra::extent(rect(i)), penumbra::area(rect(i))); },
        CALL { return floats(glsl::penumbra_extent(rect_twin(i)), glsl::penumbra_area(rect_twin(i))); },
        moderate_all<4>);
    compare<6>(
        "empty_rect, extend(Rect2)",
        CALL { return ends(penumbra::extend(penumbra::extend(penumbra::empty_rect<float>(), v2(i)), v2(i + 2))); },
        CALL {
            return ends(glsl::penumbra_extend(glsl::penumbra_extend(glsl::penumbra_empty_rect(), v2(i)), v2(i + 2)));
        },
        anything);
    compare<8>(
        "intersect", CALL { return ends(penumbra::intersect(rect(i), rect(i + 4))); },
        CALL { return ends(glsl::penumbra_intersect(rect_twin(i), rect_twin(i + 4))); }, anything);
    compare<6>(
        "is_empty(Box3)",
        CALL {
            return floats(penumbra::is_empty(penumbra::Box3<float>{v3(i), v3(i + 3)}));
        },
        CALL { return floats(glsl::penumbra_is_empty(glsl::penumbra_box3(v3(i), v3(i + 3)))); }, anything);
    compare<6>(
        "empty_box, extend(Box3)",
        CALL { return ends(penumbra::extend(penumbra::extend(penumbra::empty_box<float>(), v3(i)), v3(i + 3))); },
        CALL {
            return ends(glsl::penumbra_extend(glsl::penumbra_extend(glsl::penumbra_empty_box(), v3(i)), v3(i + 3)));
        },
        anything);
    CHECK(ends(glsl::penumbra_empty_rect()) == ends(penumbra::empty_rect<float>()));
    CHECK(ends(glsl::penumbra_empty_box()) == ends(penumbra::empty_box<float>()));
    compare<7>(
        "signed_distance",
        CALL {
            return floats(penumbra::signed_distance(penumbra::Plane<float>{v3(i), i[3]}, v3(i + 4)));
        },
        CALL {
            return floats(glsl::penumbra_signed_distance(glsl::penumbra_Plane{v3(i), i[3]}, v3(i + 4)));
        },
        moderate_all<7>, 4, [](const float* i) { return std::max(std::abs(i[3]), largest(i, 3) * largest(i + 4, 3)); });
}

TEST_CASE("light") {
    const Change frame = [](float* i) {  // a right-handed frame, and a point
        moderate_all<15>(i);
        const Floats f = axes(penumbra::light_frame(penumbra::DiskLight<float>{v3(i), v3(i + 3), 1.0F}));
        std::copy(f.begin(), f.end(), i);
    };
    const Size offset = [](const float* i) { return 2.0F * (largest(i, 3) + largest(i + 12, 3)); };
    compare<15>(
        "LightFrame::to_light",
        CALL {
            return floats(penumbra::LightFrame<float>{v3(i), v3(i + 3), v3(i + 6), v3(i + 9)}.to_light(v3(i + 12)));
        },
        CALL {
            return floats(
                glsl::penumbra_to_light(glsl::penumbra_make_frame(v3(i), v3(i + 3), v3(i + 6), v3(i + 9)), v3(i + 12)));
        },
        frame, 8, offset);
    compare<15>(
        "LightFrame::to_world",
        CALL {
            return floats(penumbra::LightFrame<float>{v3(i), v3(i + 3), v3(i + 6), v3(i + 9)}.to_world(v3(i + 12)));
        },
        CALL {
            return floats(
                glsl::penumbra_to_world(glsl::penumbra_make_frame(v3(i), v3(i + 3), v3(i + 6), v3(i + 9)), v3(i + 12)));
        },
        frame, 8, offset);
    compare<9>(
        "half_size",
        CALL {
            return floats(penumbra::half_size(penumbra::RectLight<float>{v3(i), v3(i + 3), v3(i + 6)}));
        },
        CALL {
            return floats(glsl::penumbra_half_size(glsl::penumbra_RectLight{v3(i), v3(i + 3), v3(i + 6)}));
        },
        moderate_all<9>, 8);
    // every third light has a side missing, every ninth both; sides otherwise as they come
    const Change sides = [](float* i) {
        moderate_all<12>(i);
        const int missing = static_cast<int>(whole(i[9] + i[4], 0, 8));
        for (int k = 3; k < 6; ++k) i[k] = missing <= 1 ? 0.0F : i[k];
        for (int k = 6; k < 9; ++k) i[k] = missing == 1 || missing == 2 ? 0.0F : i[k];
    };
    // unit vectors, but across two nearly parallel ones as bad as the angle between them: to 1e-3
    compare<12>(
        "light_frame(RectLight)",
        CALL {
            return axes(penumbra::light_frame(penumbra::RectLight<float>{v3(i), v3(i + 3), v3(i + 6)}, v3(i + 9)));
        },
        CALL {
            return axes(glsl::penumbra_light_frame(glsl::penumbra_RectLight{v3(i), v3(i + 3), v3(i + 6)}, v3(i + 9)));
        },
        sides, 1e4, [](const float* i) { return std::max(1.0F, largest(i, 3)); });
    compare<7>(
        "light_frame(DiskLight)",
        CALL {
            return axes(penumbra::light_frame(penumbra::DiskLight<float>{v3(i), v3(i + 3), i[6]}));
        },
        CALL {
            return axes(glsl::penumbra_light_frame(glsl::penumbra_DiskLight{v3(i), v3(i + 3), i[6]}));
        },
        moderate_all<7>, 16, [](const float* i) { return std::max(1.0F, largest(i, 3)); });
    compare<9>(
        "light_frame(LinearLight)",
        CALL {
            return axes(penumbra::light_frame(penumbra::LinearLight<float>{v3(i), v3(i + 3)}, v3(i + 6)));
        },
        CALL {
            return axes(glsl::penumbra_light_frame(glsl::penumbra_LinearLight{v3(i), v3(i + 3)}, v3(i + 6)));
        },
        moderate_all<9>, 1e4, [](const float* i) { return std::max(1.0F, largest(i, 6)); });
}

TEST_CASE("combine") {
    compare<2>(
        "combine_*, occlusion_bounds",
        CALL {
            const auto b = penumbra::occlusion_bounds(i[0], i[1]);
            return floats(penumbra::combine_product(i[0], i[1]), penumbra::combine_sum(i[0], i[1]),
                          penumbra::combine_max(i[0], i[1]), penumbra::combine_mean(i[0], i[1]), b.lower, b.upper);
        },
        CALL {
            const auto b = glsl::penumbra_occlusion_bounds(i[0], i[1]);
            return floats(glsl::penumbra_combine_product(i[0], i[1]), glsl::penumbra_combine_sum(i[0], i[1]),
                          glsl::penumbra_combine_max(i[0], i[1]), glsl::penumbra_combine_mean(i[0], i[1]), b.lower,
                          b.upper);
        },
        shares<2>, 4);
    compare<3>(
        "OcclusionAccumulator",
        CALL {
            penumbra::OcclusionAccumulator<float> all;
            Floats out = interval(all.bounds());
            for (int n = 0; n < 4; ++n) {
                for (int rule = 0; rule < 4; ++rule) put(out, all.result(static_cast<penumbra::Combination>(rule)));
                if (n < 3) all.add(i[n]);
            }
            put(out, all.bounds().lower), put(out, all.bounds().upper);
            return out;
        },
        CALL {
            glsl::penumbra_OcclusionAccumulator all = glsl::penumbra_no_occlusion();
            Floats out = interval(glsl::penumbra_bounds(all));
            for (int n = 0; n < 4; ++n) {
                for (int rule = 0; rule < 4; ++rule) put(out, glsl::penumbra_result(all, rule));
                if (n < 3) all = glsl::penumbra_add(all, i[n]);
            }
            put(out, glsl::penumbra_bounds(all).lower), put(out, glsl::penumbra_bounds(all).upper);
            return out;
        },
        shares<3>, 8, one);
}
