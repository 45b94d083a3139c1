// The queries of soft shadow maps, compiled as C++, against the C++ with the same casters.
#include <doctest/doctest.h>

#include "as_cpp.hpp"

#define PENUMBRA_WITHOUT_SLICES
#define PENUMBRA_WITHOUT_VOLUMES
#define PENUMBRA_WITHOUT_WEDGES
namespace glsl {

namespace hard {
#define PENUMBRA_SOFT_SHADOW_MAP_HARD 1
#define PENUMBRA_SOFT_SHADOW_MAP_MASK 1
#include "as_cpp_query.hpp"
}  // namespace hard

namespace channels {
#define PENUMBRA_SOFT_SHADOW_MAP_EDGES 0
#include "as_cpp_query.hpp"
}  // namespace channels

}  // namespace glsl

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "map_cases.hpp"

using namespace penumbra::test;
using penumbra::LinearMode;
using penumbra::SkinTransition;

namespace {

// Same operations, same order: the same bits.
#ifdef __FP_FAST_FMAF  // unless compilers fuse products and sums as they please; then ends of segments that are hardly
constexpr double tolerance = 4e-5;  // nearer than the point may lie elsewhere
constexpr int exceptions = 16;
#else
constexpr double tolerance = 0;
constexpr int exceptions = 0;
#endif
const int count = std::getenv("PENUMBRA_SHADERS") != nullptr ? 4096 : 16384;  // fewer for mutants.sh

template <class Query>
typename Query::View view_of(const MapCase& query) {
    typename Query::View view;
    view.slopes.min = query.view().slopes.min, view.slopes.max = query.view().slopes.max;
    view.resolution = query.view().resolution;
    return view;
}

template <class Query>
float seen_in_maps(const MapCase& query, const glm::vec3& point_ls, std::size_t* reads = nullptr) {
    return Query::visibility({&query.maps.maps, reads}, {&query.maps.edges, reads}, view_of<Query>(query),
                             query.shadow.maps().count(), point_ls);
}
template <class Query>
float seen_by_segments(const MapCase& query, const glm::vec3& point_ls, std::size_t* reads = nullptr) {
    return Query::visibility({&query.segments.segments, reads}, view_of<Query>(query), query.shadow.segments().first(),
                             query.shadow.segments().last(), point_ls);
}

/// By the query of these options.
float seen(const MapCase& query, const glm::vec3& point_ls, std::size_t* reads = nullptr) {
    switch (query.shadow.options().mode) {
        case LinearMode::hard:
            return seen_in_maps<glsl::hard::SkinMapQuery>(query, point_ls, reads);
        case LinearMode::skins:
            return has_edges(query.shadow.options())
                       ? seen_in_maps<glsl::SkinMapQuery>(query, point_ls, reads)
                       : seen_in_maps<glsl::channels::SkinMapQuery>(query, point_ls, reads);
        case LinearMode::intervals:
            return seen_by_segments<glsl::RowSegmentQuery>(query, point_ls, reads);
        case LinearMode::interval_mask:
            break;
    }
    return seen_by_segments<glsl::hard::RowSegmentQuery>(query, point_ls, reads);
}
static_assert(glsl::hard::SkinMapQuery::hard && glsl::hard::RowSegmentQuery::mask);
static_assert(!glsl::channels::SkinMapQuery::hard && !glsl::channels::SkinMapQuery::edges);
static_assert(!glsl::SkinMapQuery::hard && glsl::SkinMapQuery::edges && !glsl::RowSegmentQuery::mask);

void compare(const penumbra::SoftShadowMapOptions& options) {
    for (const Scene& scene : map_scenes()) {
        const MapCase query(scene, options, count);
        Difference difference;
        difference.small = tolerance;
        for (std::size_t i = 0; i < query.truth.size(); ++i)
            difference.add(seen(query, query.points_ls[i]), query.truth[i]);
        CAPTURE(map_name(options));
        CAPTURE(options.samples);
        CAPTURE(scene.name);
        CAPTURE(difference.worst);
        CHECK(difference.flips <= exceptions);
        if (options.resolution == 1) continue;
        std::printf("%-16s %-20s %d of %3d: %d points, %4d in penumbra  worst %.3g\n", map_name(options).c_str(),
                    scene.name, options.samples, options.resolution, count, query.penumbrae(), difference.worst);
        const auto sees = [&](float v) { return std::count(query.truth.begin(), query.truth.end(), v); };
        CHECK(sees(1.0F) > count / 40);
        if (scene.casters.empty()) continue;
        CHECK(query.penumbrae() + sees(0.0F) > count / 40);
        if (scene.light.x > 0 && options.samples == 2) continue;  // no skins of what is around the light's middle
        CHECK((query.penumbrae() > count / 40) == (scene.light.x > 0));
    }
}

}  // namespace

TEST_CASE("visibility is that of the C++, bit for bit, with every option") {
    for (const glm::ivec2& size : {glm::ivec2(2, 1), glm::ivec2(2, 97), glm::ivec2(3, 256), glm::ivec2(5, 97)})
        for (const penumbra::SoftShadowMapOptions& options : all_map_modes(size.x, size.y)) compare(options);
}

TEST_CASE("segments in more than one row of texels, each read twice at most") {
    const Scene scene{"a fence", fence<float>().casters, {0.5F, 0.0F}};
    for (const LinearMode mode : {LinearMode::intervals, LinearMode::interval_mask}) {
        const MapCase query(scene, map_options(mode, SkinTransition::exact, 5, 256), count);
        REQUIRE(query.segments.segments.height() > 1);
        const std::vector<std::uint32_t>& starts = query.shadow.segments().starts();
        std::size_t most = 0, worst = 0;
        for (std::size_t y = 0; y + 1 < starts.size(); ++y)
            most = std::max<std::size_t>(most, starts[y + 1] - starts[y]);
        Difference difference;
        for (std::size_t i = 0; i < query.truth.size(); ++i) {
            std::size_t reads = 0;
            difference.add(seen(query, query.points_ls[i], &reads), query.truth[i]);
            worst = std::max(worst, reads);
        }
        CHECK(difference.worst <= tolerance);
        CHECK(worst <= 1 + 2 * most);
    }
}

TEST_CASE("of each map, a texel, its edges and positions are read") {
    for (const penumbra::SoftShadowMapOptions& options : all_map_modes(5, 97)) {
        if (has_segments(options)) continue;
        const MapCase query(map_scenes().front(), options, count);
        const std::size_t each = has_edges(options) ? 4 : 2;
        std::size_t worst = 0;
        for (const glm::vec3& point : query.points_ls) {
            std::size_t reads = 0;
            seen(query, point, &reads);
            worst = std::max(worst, reads);
        }
        CHECK(worst > 2 + 2 * 5 - 1);
        CHECK(worst <= 2 + each * 5);
    }
}

TEST_CASE("all of the light is 1 where weights sum to less") {
    std::vector<penumbra::LightMap<float>> maps;
    for (const float position : {-1.0F, -0.9F, -0.8F, -0.4F}) {
        penumbra::LightMap<float> map;
        map.position = position;
        map.blocked = map.caster = map.receiver = penumbra::Image<float>(1, 1, penumbra::LightMap<float>::none);
        maps.push_back(map);
    }
    const penumbra::LightMapView<float> view{{{-1, -1}, {1, 1}}, 1};
    const penumbra::SkinMaps<float> all(view, {&maps[0], &maps[1], &maps[2], &maps[3]}, LinearMode::hard,
                                        SkinTransition::exact, penumbra::StepDetector::slope_aware, 1e-3F);
    const penumbra::SkinMapTexels texels = skin_map_texels(all);
    glsl::hard::penumbra_LightMapView borders;
    borders.slopes.min = view.slopes.min, borders.slopes.max = view.slopes.max, borders.resolution = 1;
    const glm::vec3 point(0, 0, 4);
    CHECK(all.visibility(point) == 1.0F);
    CHECK(glsl::hard::SkinMapQuery::visibility({&texels.maps}, {&texels.edges}, borders, 4, point) == 1.0F);
}

TEST_CASE("points that are not finite, on the light's plane or behind it, and all without casters, see everything") {
    constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float big = std::numeric_limits<float>::max();
    for (const penumbra::SoftShadowMapOptions& options : all_map_modes(3, 16)) {
        CAPTURE(map_name(options));
        for (const Scene& scene : map_scenes()) {
            CAPTURE(scene.name);
            const MapCase query(scene, options, 1);
            for (const glm::vec3& point :
                 {glm::vec3(0, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0, 0, nan), glm::vec3(nan, 0, 4),
                  glm::vec3(0, infinity, 4), glm::vec3(0, 0, infinity), glm::vec3(-big, 0, 4), glm::vec3(0, big, 4),
                  glm::vec3(1, 1, 1e-38F), glm::vec3(1e6F, 0, 1e-38F)})
                CHECK(seen(query, point) == 1.0F);
        }
        // nothing at all, and casters beyond the slopes of maps
        const Scene aside{"aside", {box_mesh<float>({100, 3, 0}, {0.05F, 0.05F, 0.05F})}, {0.5F, 0.5F}};
        for (const Scene& scene : {Scene{"none", {}, {0.5F, 0.5F}}, aside}) {
            CAPTURE(scene.name);
            const MapCase query(scene, options, 64);
            CHECK(query.maps.maps.empty());
            CHECK(query.segments.segments.empty());
            for (const glm::vec3& point : query.points_ls) CHECK(seen(query, point) == 1.0F);
        }
    }
}
