// The query of D-buffers, compiled as C++, against the C++ with the same casters.
#include <doctest/doctest.h>

#include "as_cpp.hpp"

#define PENUMBRA_WITHOUT_MAPS
#define PENUMBRA_WITHOUT_SLICES
#define PENUMBRA_WITHOUT_WEDGES
namespace glsl {

namespace one_layer {
#define PENUMBRA_UMBRA_VOLUME_LAYERS 1
#include "as_cpp_query.hpp"
}  // namespace one_layer

namespace one_layer_depths {
#define PENUMBRA_UMBRA_VOLUME_LAYERS 1
#define PENUMBRA_UMBRA_VOLUME_SHARE PENUMBRA_CUT_SHARE_DEPTHS
#include "as_cpp_query.hpp"
}  // namespace one_layer_depths

namespace the_paper {
#define PENUMBRA_UMBRA_VOLUME_LAYERS 1
#define PENUMBRA_UMBRA_VOLUME_VISIBILITY PENUMBRA_CUT_VISIBILITY_CUBIC
#define PENUMBRA_UMBRA_VOLUME_SHARE PENUMBRA_CUT_SHARE_DEPTHS
#define PENUMBRA_UMBRA_VOLUME_DEPTH PENUMBRA_D_BUFFER_DEPTH_EUCLIDEAN
#include "as_cpp_query.hpp"
}  // namespace the_paper

namespace euclidean {
#define PENUMBRA_UMBRA_VOLUME_DEPTH PENUMBRA_D_BUFFER_DEPTH_EUCLIDEAN
#include "as_cpp_query.hpp"
}  // namespace euclidean

namespace depths {
#define PENUMBRA_UMBRA_VOLUME_SHARE PENUMBRA_CUT_SHARE_DEPTHS
#include "as_cpp_query.hpp"
}  // namespace depths

namespace cubic {
#define PENUMBRA_UMBRA_VOLUME_VISIBILITY PENUMBRA_CUT_VISIBILITY_CUBIC
#include "as_cpp_query.hpp"
}  // namespace cubic

namespace square_root {
#define PENUMBRA_UMBRA_VOLUME_VISIBILITY PENUMBRA_CUT_VISIBILITY_SQUARE_ROOT
#define PENUMBRA_UMBRA_VOLUME_SHARE PENUMBRA_CUT_SHARE_DEPTHS
#include "as_cpp_query.hpp"
}  // namespace square_root

}  // namespace glsl

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "d_buffer_cases.hpp"

using namespace penumbra::test;

namespace {

// Same operations, same order: the same bits.
#ifdef __FP_FAST_FMAF  // unless compilers fuse products and sums as they please; then points in a plane with two edges
constexpr double tolerance = 4e-5;  // may take these otherwise
constexpr int exceptions = 16;
#else
constexpr double tolerance = 0;
constexpr int exceptions = 0;
#endif
const int count = std::getenv("PENUMBRA_SHADERS") != nullptr ? 8192 : 32768;  // fewer for mutants.sh

template <class Query>
penumbra::UmbraVolumeOptions options_of(int resolution) {
    penumbra::UmbraVolumeOptions options;
    options.resolution = resolution;
    options.layers = Query::layers;
    options.visibility = static_cast<penumbra::CutVisibility>(Query::form);
    options.share = static_cast<penumbra::CutShare>(Query::share);
    options.depth = static_cast<penumbra::DBufferDepth>(Query::depth);
    return options;
}

template <class Query>
float seen(const DBufferCase& query, const glm::vec3& point_ls, std::size_t* reads = nullptr) {
    typename Query::View view;
    view.slopes.min = query.d_buffer.view().slopes.min, view.slopes.max = query.d_buffer.view().slopes.max;
    view.resolution = query.d_buffer.view().resolution;
    return Query::visibility({&query.texels.crossings, reads}, {&query.texels.edges, reads}, view,
                             query.d_buffer.radius(), point_ls);
}

template <class Query>
void compare() {
    for (const int resolution : {1, 97, 256})
        for (const Scene& scene : d_buffer_scenes()) {
            const penumbra::UmbraVolumeOptions options = options_of<Query>(resolution);
            const DBufferCase query(scene, options, count);
            Difference difference;
            difference.small = tolerance;
            for (std::size_t i = 0; i < query.truth.size(); ++i)
                difference.add(seen<Query>(query, query.points_ls[i]), query.truth[i]);
            CAPTURE(d_buffer_name(options));
            CAPTURE(scene.name);
            CAPTURE(difference.worst);
            CHECK(difference.flips <= exceptions);
            if (resolution == 1) continue;
            std::printf("%-36s %-22s %4d: %d points, %4d in penumbra  worst %.3g\n", d_buffer_name(options).c_str(),
                        scene.name, resolution, count, query.penumbrae(), difference.worst);
            const auto sees = [&](float v) { return std::count(query.truth.begin(), query.truth.end(), v); };
            CHECK(sees(1.0F) > count / 40);
            if (scene.casters.empty()) continue;
            CHECK(query.penumbrae() + sees(0.0F) > count / 40);
            CHECK((query.penumbrae() > count / 40) == (scene.light.x > 0));
        }
}

}  // namespace

TEST_CASE("visibility is that of the C++, bit for bit, with every option") {
    compare<glsl::one_layer::DBufferQuery>();
    compare<glsl::one_layer_depths::DBufferQuery>();
    compare<glsl::the_paper::DBufferQuery>();
    compare<glsl::euclidean::DBufferQuery>();
    compare<glsl::depths::DBufferQuery>();
    compare<glsl::cubic::DBufferQuery>();
    compare<glsl::square_root::DBufferQuery>();
    compare<glsl::DBufferQuery>();
}

TEST_CASE("edges in more than one row of texels") {
    const Scene scene{"a sphere", {scaled_at(icosphere<float>(6), 0.8F, {0, 1.5F, 0})}, {0.5F, 0.5F}};
    const DBufferCase query(scene, options_of<glsl::DBufferQuery>(256), count);
    REQUIRE(query.texels.edges.height() > 1);
    std::size_t worst = 0;
    Difference difference;
    for (std::size_t i = 0; i < query.truth.size(); ++i) {
        std::size_t reads = 0;
        difference.add(seen<glsl::DBufferQuery>(query, query.points_ls[i], &reads), query.truth[i]);
        worst = std::max(worst, reads);
    }
    CHECK(difference.worst <= tolerance);
    // texels of crossings; of two edges, the other of a corner, two neighbours, and what is chained to four of them
    CHECK(worst <= 3 + 9 * 3);
}

TEST_CASE("points that are not finite, on the light's plane or behind it, and all without casters, see everything") {
    constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float big = std::numeric_limits<float>::max();
    for (const Scene& scene : d_buffer_scenes()) {
        const DBufferCase query(scene, options_of<glsl::DBufferQuery>(16), 1);
        for (const glm::vec3& point :
             {glm::vec3(0, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0, 0, nan), glm::vec3(nan, 0, 4),
              glm::vec3(0, infinity, 4), glm::vec3(0, 0, infinity), glm::vec3(-big, 0, 4), glm::vec3(1, 1, 1e-38F)})
            CHECK(seen<glsl::DBufferQuery>(query, point) == 1.0F);
    }
    // nothing at all, and casters behind the light
    const Scene behind{"behind", {box_mesh<float>({0, 6, 0}, {1, 1, 1})}, {0.5F, 0.5F}};
    for (const Scene& scene : {Scene{"none", {}, {0.5F, 0.5F}}, behind}) {
        const DBufferCase query(scene, options_of<glsl::DBufferQuery>(16), 64);
        CHECK(query.texels.crossings.empty());
        for (const glm::vec3& point : query.points_ls) CHECK(seen<glsl::DBufferQuery>(query, point) == 1.0F);
    }
}
