// A program without exceptions: bad arguments reach its own hook, and what could not be built answers "fully visible".
#include <cstdio>
#include <string>

namespace {
std::string last_error;
}
#define PENUMBRA_ON_ERROR(message) (last_error = (message))
#include <limits>
#include <penumbra/penumbra.hpp>

namespace {

int failures = 0;

void expect(bool condition, const char* what) {
    if (condition) return;
    ++failures;
    std::printf("failed: %s (last error: %s)\n", what, last_error.c_str());
}

}  // namespace

int main() {
    using namespace penumbra;
    Mesh<float> quad{{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}, {{0, 1, 2}, {0, 2, 3}}};
    const RectLight<float> light{{0, 4, 0}, {0.5F, 0, 0}, {0, 0, 0.5F}};
    expect(OcclusionTextureShadow<float>({quad}, light).visibility({0, 0, 0}) == 0.0F, "a good one is dark below");
    expect(last_error.empty(), "and reports nothing");

    OcclusionTextureOptions options;
    options.slices = 0;
    const OcclusionTextureShadow<float> no_slices({quad}, light, options);
    expect(last_error.find("options.slices = 0") != std::string::npos, "options are named");
    expect(no_slices.visibility({0, 0, 0}) == 1.0F, "no slices: fully visible");

    PenumbraWedgeOptions wedge_options;
    wedge_options.bitmask_size = 5;
    expect(PenumbraWedgeShadow<float>({quad}, light).visibility({0, 0, 0}) == 0.0F, "wedges are dark below, too");
    expect(PenumbraWedgeShadow<float>({quad}, light, wedge_options).visibility({0, 0, 0}) == 1.0F,
           "no such masks: visible");
    expect(last_error.find("options.bitmask_size = 5") != std::string::npos, "their options are named");

    quad.triangles[1].y = 7;
    const OcclusionTextureShadow<float> no_vertex({quad}, light);
    expect(last_error.find("casters[0].triangles[1] uses index 7") != std::string::npos, "casters are named");
    expect(no_vertex.visibility({0, 0, 0}) == 1.0F, "no vertex: fully visible");

    const Image<std::uint8_t> nothing(0, 3);
    expect(last_error.find("image size 0") != std::string::npos && nothing.empty(), "an image of no size is empty");
    const SummedArea<std::uint32_t> table(nothing);
    expect(last_error.find("image is empty") != std::string::npos, "an empty image is named");
    const Rect2<float> box{{0, 0}, {1, 1}};
    expect(table.mean(box) == 0.0F && table.sum(0, 0, 1, 1) == 0U, "and its means are 0");
    expect(NBuffer<float>(Image<float>()).mean(box) == 0.0F, "so are an N-Buffer's");
    expect(MipMap<float>(Image<float>()).mean(box) == 0.0F, "and a mip-map's");
    return failures;
}
