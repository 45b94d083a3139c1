// The passes that draw soft shadow maps, run on the driver, against the C++: channels of the C++'s own maps but for
// roundings, maps but for texels on edges.
#include <doctest/doctest.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "context.hpp"
#include "float_texture.hpp"
#include "map_cases.hpp"
#include "program.hpp"

using namespace penumbra;
using test::Api;
using test::Context;
using test::FloatTexture;
using test::Program;

namespace {

/// A texture to draw to, and to read without filtering.
class Target {
  public:
    Target(GLenum format, int width, int height) : width_(width), height_(height) {
        glGenTextures(1, &name_);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, name_);
        glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    ~Target() { glDeleteTextures(1, &name_); }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    void bind(int unit) const {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(GL_TEXTURE_2D, name_);
    }
    /// What is drawn next goes to these, and to a depth buffer.
    static void attach(const std::vector<const Target*>& colors, const Target* depth = nullptr) {
        static thread_local GLuint framebuffer = 0;
        glDeleteFramebuffers(1, &framebuffer);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        std::vector<GLenum> targets;
        for (const Target* color : colors) {
            targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
            glFramebufferTexture2D(GL_FRAMEBUFFER, targets.back(), GL_TEXTURE_2D, color->name_, 0);
        }
        if (depth != nullptr)
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->name_, 0);
        glDrawBuffers(static_cast<GLsizei>(targets.size()), targets.data());
        glViewport(0, 0, colors[0]->width_, colors[0]->height_);
        REQUIRE(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
    }
    /// All four channels; of a float format.
    Image<glm::vec4> read() const {
        attach({this});
        Image<glm::vec4> texels(width_, height_);
        glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, texels.data());
        REQUIRE(glGetError() == GL_NO_ERROR);
        return texels;
    }

  private:
    GLuint name_ = 0;
    int width_, height_;
};

constexpr float none = LightMap<float>::none;

/// A scene's maps, and what the C++ makes of them.
struct Case {
    SoftShadowMapOptions options;
    std::vector<Mesh<float>> casters, receivers{test::line_scene_floor<float>()};
    LightMapGeometry<float> geometry;
    std::vector<LightMap<float>> maps;

    Case(const test::Scene& scene, const SoftShadowMapOptions& of)
        : options(of),
          casters(scene.casters),
          geometry(light_map_geometry<float>(casters, receivers, {{-scene.light.x, 4, 0}, {scene.light.x, 4, 0}},
                                             of.resolution)) {
        if (geometry.view.empty()) return;
        const detail::LightMapMaker<float> maker(geometry);
        for (int i = 0; i < options.samples; ++i)
            maps.push_back(maker.make(even_position(geometry.half_length, i, options.samples)));
    }
    int rows() const { return options.resolution * options.samples; }
    /// One of the images of all maps, as `surfaces` and `blocked` have them.
    template <class Value>
    Image<glm::vec4> texels(Value&& value) const {
        Image<glm::vec4> result(options.resolution, rows());
        for (int y = 0; y < rows(); ++y)
            for (int x = 0; x < options.resolution; ++x) {
                const LightMap<float>& map = maps[static_cast<std::size_t>(y / options.resolution)];
                result(x, y) = glm::vec4(value(map, x, y % options.resolution));
            }
        return result;
    }
    Image<glm::vec4> surfaces() const {
        return texels([](const LightMap<float>& map, int x, int y) {
            return map.receiver(x, y) < map.caster(x, y) ? -map.receiver(x, y) : map.caster(x, y);
        });
    }
    Image<glm::vec4> blocked() const {
        return texels([](const LightMap<float>& map, int x, int y) { return map.blocked(x, y); });
    }
    SkinMapTexels truth() const {
        std::vector<const LightMap<float>*> all;
        for (const LightMap<float>& map : maps) all.push_back(&map);
        return skin_map_texels(SkinMaps<float>(geometry.view, all, options.mode, options.transition, options.detector,
                                               geometry.step(options.step)));
    }
    void set(const Program& program) const {
        program.use();
        program.set("penumbra_view.slopes.min", geometry.view.slopes.min);
        program.set("penumbra_view.slopes.max", geometry.view.slopes.max);
        program.set("penumbra_view.resolution", geometry.view.resolution);
        program.set("penumbra_count", options.samples);
        program.set("penumbra_half_length", geometry.half_length);
        program.set("penumbra_step", geometry.step(options.step));
        program.set("penumbra_nearest", static_cast<float>(geometry.nearest));
        program.set("penumbra_light.origin", geometry.frame.origin);
        program.set("penumbra_light.u", geometry.frame.u);
        program.set("penumbra_light.v", geometry.frame.v);
        program.set("penumbra_light.normal", geometry.frame.normal);
        program.set("penumbra_world", glm::mat4(1.0F));
        program.set("penumbra_near", static_cast<float>(geometry.near));
        program.set("penumbra_farthest", static_cast<float>(geometry.farthest));
    }
    bool any_solid() const {
        return std::any_of(geometry.casters.begin(), geometry.casters.end(), [](const auto& c) { return c.solid; });
    }
};

/// The passes after light_map.frag.
class SkinPasses {
  public:
    SkinPasses(const Context& context, const SoftShadowMapOptions& options)
        : has_edges_(test::has_edges(options)),
          discontinuities_(context, full_screen, "soft_shadow_map/discontinuities.frag", defines(options)),
          rows_(context, full_screen, "soft_shadow_map/discontinuity_rows.frag", {}),
          skins_(context, full_screen, "soft_shadow_map/skins.frag", defines(options)) {}

    /// Of textures `surfaces` at unit 1 and `blocked` at unit 2.
    SkinMapTexels run(const Case& of) const {
        const int marks = (of.options.resolution + 31) / 32, height = of.rows();
        const Target onward(GL_RG32UI, marks, height), backward(GL_RG32UI, marks, height);
        const Target rows(GL_RG32UI, (marks + 31) / 32, height);
        const Target maps(GL_RGBA32F, of.options.resolution, height), edges(GL_RGBA32F, of.options.resolution, height);
        Target::attach({&onward, &backward});
        of.set(discontinuities_), discontinuities_.set("penumbra_surfaces", 1);
        discontinuities_.draw_full_screen();
        Target::attach({&rows});
        onward.bind(3), backward.bind(4);
        rows_.use(), rows_.set("penumbra_onward", 3), rows_.set("penumbra_backward", 4);
        rows_.draw_full_screen();
        if (has_edges_)
            Target::attach({&maps, &edges});
        else
            Target::attach({&maps});
        rows.bind(5);
        of.set(skins_);
        skins_.set("penumbra_surfaces", 1), skins_.set("penumbra_blocked", 2);
        skins_.set("penumbra_onward", 3), skins_.set("penumbra_backward", 4), skins_.set("penumbra_rows", 5);
        skins_.draw_full_screen();
        return {maps.read(), has_edges_ ? edges.read() : Image<glm::vec4>()};
    }

  private:
    static constexpr const char* full_screen = "occlusion_texture/full_screen.vert";
    static Program::Options defines(const SoftShadowMapOptions& options) {
        const auto define = [](const char* name, int value) {
            return std::string("PENUMBRA_SOFT_SHADOW_MAP_") + name + " " + std::to_string(value);
        };
        return {define("HARD", options.mode == LinearMode::hard), define("SOLID", 0),
                define("TRANSITION", static_cast<int>(options.transition)),
                define("DETECTOR", static_cast<int>(options.detector))};
    }

    bool has_edges_;
    Program discontinuities_, rows_, skins_;
};

/// Channels that differ by more than a rounding: a skin ends within one of a texel's border or centre.
struct Wrong {
    int texels = 0, of = 0;  ///< `of`: those that see part of the light
    int depths = 0;          ///< those that are not equal
    float position = 0.0F;   ///< the worst
    float edge = 0.0F;       ///< the worst, of those whose channels are right

    void add(const SkinMapTexels& got, const SkinMapTexels& truth) {
        for (std::size_t i = 0; i < truth.maps.size(); ++i) {
            const glm::vec4 a = got.maps.data()[i], b = truth.maps.data()[i];
            position = std::max(position, std::abs(a.w - b.w));
            depths += a.x != b.x;
            const auto is_part = [](float v) { return v > 0.0F && v < 1.0F; };
            for (const int c : {1, 2}) {
                of += is_part(b[c]);
                const bool wrong = !(std::abs(a[c] - b[c]) <= 1e-4F);
                texels += wrong;
                if (truth.edges.empty() || wrong || !is_part(b[c]) || !is_part(a[c])) continue;
                for (const int e : {2 * c - 2, 2 * c - 1})
                    edge = std::max(edge, std::abs(got.edges.data()[i][e] - truth.edges.data()[i][e]));
            }
        }
    }
};

void check_skins(const SoftShadowMapOptions& options, Api api) {
    const Context context(api);
    const SkinPasses passes(context, options);
    Wrong wrong;
    for (const test::Scene& scene : test::map_scenes()) {
        const Case of(scene, options);
        if (of.maps.empty()) continue;
        const FloatTexture surfaces(of.surfaces(), 1), blocked(of.blocked(), 2);
        wrong.add(passes.run(of), of.truth());
    }
    std::printf("%-16s %d of %3d, detector %d, %-8s%6d of %7d parts, positions %.2g, edges %.2g\n",
                test::map_name(options).c_str(), options.samples, options.resolution,
                static_cast<int>(options.detector), api == Api::es ? "ES" : "desktop", wrong.texels, wrong.of,
                static_cast<double>(wrong.position), static_cast<double>(wrong.edge));
    CAPTURE(test::map_name(options));
    CAPTURE(static_cast<int>(options.detector));
    CAPTURE(options.samples);
    CAPTURE(options.resolution);
    CHECK(wrong.depths == 0);
    CHECK(wrong.position <= 1e-6F);
    CHECK(wrong.edge <= 1e-4F);
    CHECK(wrong.texels <= wrong.of / 1000);
    if (options.mode != LinearMode::hard && options.resolution > 1) CHECK(wrong.of > 1000);
}

/// Maps as the passes draw them.
struct Drawn {
    Image<glm::vec4> surfaces, blocked, insides;
};

Drawn draw_maps(const Context& context, const Case& of) {
    const auto program = [&](const char* what) {
        return Program::Options{std::string("PENUMBRA_LIGHT_MAP PENUMBRA_LIGHT_MAP_") + what};
    };
    const char *vertex = "soft_shadow_map/light_map.vert", *fragment = "soft_shadow_map/light_map.frag";
    const Program casters(context, vertex, fragment, program("CASTERS"));
    const Program insides(context, vertex, fragment, program("INSIDES"));
    const Program receivers(context, vertex, fragment, program("RECEIVERS"));
    const int size = of.options.resolution, height = of.rows();
    const Target surface(GL_R32F, size, height), block(GL_R32F, size, height), inside(GL_R32F, size, height);
    const Target depth(GL_DEPTH_COMPONENT32F, size, height), inside_depth(GL_DEPTH_COMPONENT32F, size, height);
    const float far[4] = {none, none, none, none}, one = 1.0F;
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    const auto each_map = [&](const Program& with, auto&& draw) {
        of.set(with);
        for (int map = 0; map < of.options.samples; ++map) {
            glViewport(0, map * size, size, size);
            with.set("penumbra_from", of.maps[static_cast<std::size_t>(map)].position);
            draw();
        }
    };
    Target::attach({&surface, &block}, &depth);
    for (const int target : {0, 1}) glClearBufferfv(GL_COLOR, target, far);
    glClearBufferfv(GL_DEPTH, 0, &one);
    each_map(casters, [&] {
        for (std::size_t i = 0; i < of.casters.size(); ++i) {
            casters.set("penumbra_solid", of.geometry.casters[i].solid ? 1 : 0);
            casters.draw_triangles(of.casters[i]);
        }
    });
    Target::attach({&inside}, &inside_depth);
    glClearBufferfv(GL_COLOR, 0, far);
    glClearBufferfv(GL_DEPTH, 0, &one);
    surface.bind(1), block.bind(2);
    of.set(insides), insides.set("penumbra_surfaces", 1), insides.set("penumbra_blocked", 2);
    each_map(insides, [&] {
        for (const Mesh<float>& mesh : of.casters) insides.draw_triangles(mesh);
    });
    Target::attach({&surface}, &depth);
    each_map(receivers, [&] {
        for (const Mesh<float>& mesh : of.receivers) receivers.draw_triangles(mesh);
    });
    glDisable(GL_DEPTH_TEST);
    return {surface.read(), block.read(), inside.read()};
}

}  // namespace

TEST_CASE("channels and edges of the C++'s maps, with every transition and detector") {
    for (const StepDetector detector : {StepDetector::slope_aware, StepDetector::laplacian})
        for (const SkinTransition transition :
             {SkinTransition::linear, SkinTransition::rational, SkinTransition::exact})
            for (const glm::ivec2& size : {glm::ivec2(2, 256), glm::ivec2(5, 97)}) {
                SoftShadowMapOptions options = test::map_options(LinearMode::skins, transition, size.x, size.y);
                options.detector = detector;
                check_skins(options, Api::desktop);
                if (size.y == 97) check_skins(options, Api::es);
            }
    check_skins(test::map_options(LinearMode::skins, SkinTransition::exact, 2, 1100), Api::desktop);  // rows of rows
    check_skins(test::map_options(LinearMode::skins, SkinTransition::exact, 2, 1), Api::desktop);
    check_skins(test::map_options(LinearMode::skins, SkinTransition::exact, 33, 33), Api::desktop);
    for (const Api api : {Api::desktop, Api::es})
        check_skins(test::map_options(LinearMode::hard, SkinTransition::exact, 3, 64), api);
}

TEST_CASE("maps drawn on the driver are the C++'s, but for texels on edges") {
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        int wrong = 0, texels = 0, steep = 0;
        for (const test::Scene& scene : test::map_scenes()) {
            const Case of(scene, test::map_options(LinearMode::hard, SkinTransition::exact, 3, 256));
            if (of.maps.empty()) continue;
            const Drawn drawn = draw_maps(context, of);
            const Image<glm::vec4> surfaces = of.surfaces(), blocked = of.blocked();
            for (std::size_t i = 0; i < surfaces.size(); ++i) {
                const float a = drawn.surfaces.data()[i].x, b = surfaces.data()[i].x;
                const float from = std::min(std::abs(drawn.blocked.data()[i].x), drawn.insides.data()[i].x);
                texels += b < none;
                const bool is_wrong = !(std::abs(a - b) <= 0.01F * std::abs(b));
                wrong += is_wrong || !(std::abs(from - blocked.data()[i].x) <= 0.01F * from);
                steep += !is_wrong && !(std::abs(a - b) <= 1e-4F * std::abs(b));
            }
        }
        std::printf("%-8s %d texels, %d different, %d by more than 1e-4\n", api == Api::es ? "ES" : "desktop", texels,
                    wrong, steep);
        CHECK(texels > 1000000);
        CHECK(wrong <= texels / 2000);
        CHECK(steep <= texels / 500);  // drivers move vertices to 1/256 texel
    }
}
