// The query of penumbra wedges, compiled as C++, against the C++ with the same casters.
#include <doctest/doctest.h>

#include "as_cpp.hpp"

#define PENUMBRA_WITHOUT_MAPS
#define PENUMBRA_WITHOUT_SLICES
#define PENUMBRA_WITHOUT_VOLUMES
namespace glsl {

namespace additive {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_ADDITIVE
#include "as_cpp_query.hpp"
}  // namespace additive

namespace additive_center {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_ADDITIVE
#define PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE PENUMBRA_SILHOUETTE_LIGHT_CENTER
#include "as_cpp_query.hpp"
}  // namespace additive_center

namespace maximum {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_MAXIMUM
#include "as_cpp_query.hpp"
}  // namespace maximum

namespace product {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_PRODUCT
#include "as_cpp_query.hpp"
}  // namespace product

namespace product_quadrants {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_PRODUCT_QUADRANTS
#include "as_cpp_query.hpp"
}  // namespace product_quadrants

namespace rectangles {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_RECTANGLES
#define PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE PENUMBRA_SILHOUETTE_LIGHT_CENTER
#include "as_cpp_query.hpp"
}  // namespace rectangles

namespace rectangles_centroid {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_RECTANGLES_CENTROID
#include "as_cpp_query.hpp"
}  // namespace rectangles_centroid

namespace rectangle_product {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_RECTANGLE_PRODUCT
#include "as_cpp_query.hpp"
}  // namespace rectangle_product

namespace bitmask_8 {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_BITMASK
#define PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE 8
#include "as_cpp_query.hpp"
}  // namespace bitmask_8

namespace bitmask_16_center {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_BITMASK
#define PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE 16
#define PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE PENUMBRA_SILHOUETTE_LIGHT_CENTER
#include "as_cpp_query.hpp"
}  // namespace bitmask_16_center

namespace bitmask_tolerant {
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_BITMASK
#define PENUMBRA_PENUMBRA_WEDGE_TOLERANCE 0.02f
#include "as_cpp_query.hpp"
}  // namespace bitmask_tolerant

namespace exact {
#define PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES 256
#include "as_cpp_query.hpp"
}  // namespace exact

namespace exact_center {
#define PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES 256
#define PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE PENUMBRA_SILHOUETTE_LIGHT_CENTER
#include "as_cpp_query.hpp"
}  // namespace exact_center

namespace exact_tolerant {
#define PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES 256
#define PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE 8
#define PENUMBRA_PENUMBRA_WEDGE_TOLERANCE 0.02f
#include "as_cpp_query.hpp"
}  // namespace exact_tolerant

}  // namespace glsl

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "wedge_cases.hpp"

using namespace penumbra::test;

namespace {

// Same operations, same order: the same bits.
#ifdef __FP_FAST_FMAF  // unless compilers fuse products and sums as they please
constexpr double tolerance = 2e-5;
#else
constexpr double tolerance = 0;
#endif
const int count = std::getenv("PENUMBRA_SHADERS") != nullptr ? 2048 : 4096;  // fewer for mutants.sh

template <class Query>
typename Query::Info info_of(const penumbra::WedgeTexels& texels) {
    typename Query::Info info;
    info.half_size = texels.half_size, info.scale = texels.scale;
    info.tolerance = texels.tolerance, info.nodes = texels.nodes;
    return info;
}

template <class Query>
penumbra::PenumbraWedgeOptions options_of() {
    return {static_cast<penumbra::OverlapRule>(Query::overlap), Query::bitmask_size,
            static_cast<penumbra::SilhouetteFrom>(Query::silhouette), Query::tolerance};
}

template <class Query>
void compare() {
    const penumbra::PenumbraWedgeOptions options = options_of<Query>();
    for (const Scene& scene : scenes()) {
        const WedgeCase query(scene, options, count);
        const auto info = info_of<Query>(query.texels);
        Difference difference;
        for (std::size_t i = 0; i < query.truth.size(); ++i)
            difference.add(Query::visibility({&query.texels.texels}, info, query.points_ls[i]), query.truth[i]);
        std::printf("%-26s %-22s %d points, %4d in penumbra  worst %.3g\n", wedge_name(options).c_str(), scene.name,
                    count, query.penumbrae(), difference.worst);
        CAPTURE(wedge_name(options));
        CAPTURE(scene.name);
        CHECK(difference.worst <= tolerance);
        const auto sees = [&](float v) { return std::count(query.truth.begin(), query.truth.end(), v) > count / 40; };
        CHECK(sees(1.0F));
        if (scene.casters.empty()) continue;
        CHECK(sees(0.0F));
        CHECK((query.penumbrae() > count / 10) == (scene.light.x > 0));
    }
}

/// Texels of a sphere of 20480 triangles that a point reads, on average.
template <class Query>
void read_by(int bound) {
    constexpr int asked = 1000;
    const Scene scene{"a sphere", {scaled_at(icosphere<float>(5), 0.8F, {0, 1.5F, 0})}, {0.5F, 0.5F}};
    const WedgeCase query(scene, options_of<Query>(), asked);
    std::size_t reads = 0;
    for (const glm::vec3& point : query.points_ls)
        Query::visibility({&query.texels.texels, &reads}, info_of<Query>(query.texels), point);
    std::printf("%d texels, %d read by a point of at most %d\n", static_cast<int>(query.texels.texels.size()),
                static_cast<int>(reads / asked), bound);
    CHECK(reads < static_cast<std::size_t>(asked * bound));
}

}  // namespace

TEST_CASE("visibility is that of the C++, bit for bit, by every rule") {
    compare<glsl::additive::WedgeQuery>();
    compare<glsl::additive_center::WedgeQuery>();
    compare<glsl::maximum::WedgeQuery>();
    compare<glsl::product::WedgeQuery>();
    compare<glsl::product_quadrants::WedgeQuery>();
    compare<glsl::rectangles::WedgeQuery>();
    compare<glsl::rectangles_centroid::WedgeQuery>();
    compare<glsl::rectangle_product::WedgeQuery>();
    compare<glsl::bitmask_8::WedgeQuery>();
    compare<glsl::bitmask_16_center::WedgeQuery>();
    compare<glsl::bitmask_tolerant::WedgeQuery>();
    compare<glsl::exact::WedgeQuery>();
    compare<glsl::exact_center::WedgeQuery>();
    compare<glsl::exact_tolerant::WedgeQuery>();
}

TEST_CASE("a query reads what is near the silhouette, not the mesh") {
    read_by<glsl::additive::WedgeQuery>(1050);
    read_by<glsl::additive_center::WedgeQuery>(870);
}

TEST_CASE("points that are not finite, on the light's plane or behind it see everything") {
    const WedgeCase query(scenes()[1], {}, 1);
    const auto info = info_of<glsl::WedgeQuery>(query.texels);
    constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3& point : {glm::vec3(0, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0, 0, nan), glm::vec3(nan, 0, 4),
                                   glm::vec3(0, infinity, 4), glm::vec3(0, 0, infinity), glm::vec3(-3e38F, 0, 4)})
        CHECK(glsl::WedgeQuery::visibility({&query.texels.texels}, info, point) == 1.0F);
}
