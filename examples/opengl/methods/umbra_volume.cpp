// Soft shadows of a disk light from one picture of its umbra and penumbra volumes, taken from its centre.
//
// What an engine provides: the silhouettes of its casters and the volumes that start from them, by the library on the
// host, in light space, whenever light and casters move against each other; 32-bit float textures to draw to, one of
// RGBA32F, three of R32F or RG32F, one of RGBA32UI and three depth buffers; and world-space positions of what it
// shades. It gets, per frame: three draws of the casters, one full-screen pass, two draws of volumes for each layer,
// and a function that its shading calls per light, which reads one or two texels and the edges that they name.
#include <algorithm>
#include <limits>
#include <memory>
#include <penumbra/umbra_volume/d_buffer_texels.hpp>
#include <penumbra/umbra_volume/d_buffer_vertices.hpp>
#include <penumbra/umbra_volume/shadow.hpp>
#include <tuple>
#include <utility>

#include "method.hpp"
#include "planned.hpp"

namespace penumbra::opengl {
namespace {

constexpr std::string_view shade = R"glsl(
uniform highp sampler2D crossings, edges;
uniform penumbra_LightFrame light;
uniform float radius;
uniform penumbra_DBufferView view;
void main() {
    vec4 point = penumbra_point();
    if (point.w == 0.0) discard;
    visible = penumbra_is_lit()
                  ? 1.0
                  : penumbra_visibility(crossings, edges, view, radius, penumbra_to_light(light, point.xyz));
}
)glsl";

/// Triangles whose vertices are a position and a few numbers more.
class Triangles {
  public:
    /// Of `Vertex`, all floats; in their order, or by `indices` where there are any.
    template <class Vertex>
    void upload(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices = {}) {
        make();
        count_ = static_cast<GLsizei>(indices.empty() ? vertices.size() : indices.size());
        indexed_ = !indices.empty();
        glBindVertexArray(arrays_.name());
        glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                     GL_STATIC_DRAW);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                     indices.data(), GL_STATIC_DRAW);
        constexpr GLint numbers = sizeof(Vertex) / sizeof(float) - 3;
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
        glEnableVertexAttribArray(1);
        glVertexAttribPointer(1, numbers, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                              reinterpret_cast<const void*>(3 * sizeof(float)));
        glBindVertexArray(0);
    }

    void draw() const {
        if (count_ == 0) return;
        glBindVertexArray(arrays_.name());
        if (indexed_)
            glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
        else
            glDrawArrays(GL_TRIANGLES, 0, count_);
        glBindVertexArray(0);
    }

  private:
    void make() {
        if (arrays_.name() != 0) return;
        GLuint names[3];
        glGenVertexArrays(1, &names[0]);
        glGenBuffers(2, &names[1]);
        arrays_ = Handle<DeleteArrays>(names[0]);
        vertices_ = Handle<DeleteBuffer>(names[1]);
        indices_ = Handle<DeleteBuffer>(names[2]);
    }

    struct DeleteBuffer {
        void operator()(GLuint name) const { glDeleteBuffers(1, &name); }
    };
    struct DeleteArrays {
        void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
    };
    Handle<DeleteArrays> arrays_;
    Handle<DeleteBuffer> vertices_, indices_;
    GLsizei count_ = 0;
    bool indexed_ = false;
};

class UmbraVolumeMethod final : public Method {
  public:
    UmbraVolumeMethod() { options_.mode = DiskMode::d_buffer; }  // sums over edges have no query in GLSL

    bool takes(const scenes::Light& light) const override { return std::holds_alternative<DiskLight<float>>(light); }
    std::vector<Knob> knobs() override;
    void prepare(const scenes::Scene& scene, const Geometry&) override;
    std::optional<TileView> tile_view() const override;
    void draw(const Geometry&, const Frame& frame, Timers& timers) override;
    std::string plan(const scenes::Scene& scene, float tolerance) override;
    Query by_cpp(const scenes::Scene& scene) const override;

  private:
    void make_programs();
    void make_textures();
    /// What casters.vert and volumes.vert ask.
    void begin(const Program& program, const Frame& frame) const;
    void draw_casters(const Frame& frame) const;
    void draw_volumes(const Frame& frame, int layer) const;

    UmbraVolumeOptions options_;

    // what the light sees
    LightFrame<float> frame_{};
    float radius_ = 0.0F, nearest_ = 0.0F, far_ = 0.0F;  // depths: of the nearest vertex, and where volumes end
    DBufferView<float> view_{};
    bool has_casters_ = false;
    Triangles caster_triangles_, umbra_triangles_, penumbra_triangles_;
    Texture edges_;

    std::tuple<int, CutVisibility, CutShare, DBufferDepth> programs_are_for_{};
    Program nearest_surfaces_, second_surfaces_, coverage_bits_, blocking_, volumes_, volumes_behind_, shade_;

    std::tuple<int, int> textures_are_for_{};
    Texture nearest_surface_, nearest_depth_, second_surface_, second_depth_, coverage_;  // of casters.frag
    Texture crossings_, first_edges_, depth_;                                             // of volumes.frag
    Framebuffer nearest_target_, second_target_, coverage_target_, crossing_target_, first_target_;
};

std::vector<Knob> UmbraVolumeMethod::knobs() {
    return {number_knob("resolution", options_.resolution, 16, 2048),
            number_knob("layers", options_.layers, 1, 2),
            choice_knob("visibility", options_.visibility, {"exact", "cubic", "square_root"}),
            choice_knob("share", options_.share, {"edge", "depths"}),
            choice_knob("depth", options_.depth, {"light_plane", "euclidean"}),
            choice_knob("silhouette", options_.silhouette, {"disk", "light_center"})};
}

std::string UmbraVolumeMethod::plan(const scenes::Scene& scene, float tolerance) {
    const auto plan = planned<UmbraVolumeShadow<float>>(scene, options_, tolerance);
    options_.layers = plan.options.layers, options_.silhouette = plan.options.silhouette;
    return plan.text();
}

Query UmbraVolumeMethod::by_cpp(const scenes::Scene& scene) const {
    return query_of<UmbraVolumeShadow<float>>(scene.casters, std::get<DiskLight<float>>(scene.light), options_);
}

void UmbraVolumeMethod::prepare(const scenes::Scene& scene, const Geometry&) {
    const auto& light = std::get<DiskLight<float>>(scene.light);
    frame_ = light_frame(light), radius_ = light.radius;
    const DBufferGeometry<float> geometry =
        d_buffer_geometry(scene.casters, frame_, radius_, options_.resolution, options_.silhouette);
    view_ = {geometry.slopes, options_.resolution, options_.depth};
    far_ = static_cast<float>(geometry.far), nearest_ = far_;
    const DBufferVertices vertices = d_buffer_vertices(geometry, radius_);
    for (const DBufferCasterVertex& v : vertices.casters) nearest_ = std::min(nearest_, v.position.z);
    has_casters_ = !vertices.triangles.empty();
    caster_triangles_.upload(vertices.casters, vertices.triangles);
    umbra_triangles_.upload(vertices.umbra);
    penumbra_triangles_.upload(vertices.penumbra);
    edges_ = Texture(hiding_edge_texels(geometry.edges));
    make_programs();
    make_textures();
}

std::optional<TileView> UmbraVolumeMethod::tile_view() const {
    const Vec2<float> seen = extent(view_.slopes);
    const float texel = has_casters_ ? std::max(seen.x, seen.y) / static_cast<float>(view_.resolution) : 0.0F;
    return TileView{frame_, {Vec2<float>(radius_), true}, 0.0F, texel};
}

void UmbraVolumeMethod::make_programs() {
    const auto wanted = std::make_tuple(options_.layers, options_.visibility, options_.share, options_.depth);
    if (!shade_.empty() && wanted == std::exchange(programs_are_for_, wanted)) return;
    programs_are_for_ = wanted;
    const auto option = [](const char* name, auto value) {
        return std::string("PENUMBRA_UMBRA_VOLUME_") + name + " " + std::to_string(static_cast<int>(value));
    };
    const auto caster_program = [](const char* what) {
        return Program(
            Source{{}, {library("umbra_volume/casters.vert")}},
            Source{{std::string("PENUMBRA_CASTERS PENUMBRA_CASTERS_") + what}, {library("umbra_volume/casters.frag")}});
    };
    nearest_surfaces_ = caster_program("NEAREST");
    second_surfaces_ = caster_program("SECOND");
    coverage_bits_ = caster_program("COVERAGE");
    std::vector<std::string> options{option("LAYERS", options_.layers), option("VISIBILITY", options_.visibility),
                                     option("SHARE", options_.share), option("DEPTH", options_.depth)};
    blocking_ = Program::full_screen({options, {library("umbra_volume/blocking.frag")}});
    shade_ = Program::full_screen(
        {options, {shading_head, library("light.glsl"), library("umbra_volume/d_buffer.glsl"), shade}});
    const auto volume_program = [&](int layer) {
        options.push_back(option("LAYER", layer));
        return Program(Source{{}, {library("umbra_volume/volumes.vert")}},
                       Source{options, {library("umbra_volume/volumes.frag")}});
    };
    volumes_ = volume_program(0);
    options.pop_back();
    volumes_behind_ = options_.layers > 1 ? volume_program(1) : Program();
}

void UmbraVolumeMethod::make_textures() {
    const auto wanted = std::make_tuple(options_.resolution, options_.layers);
    if (wanted == std::exchange(textures_are_for_, wanted)) return;
    const int size = options_.resolution, layers = options_.layers;
    nearest_surface_ = Texture(GL_RG32F, {size, size});
    nearest_depth_ = Texture(GL_DEPTH_COMPONENT32F, {size, size});
    second_surface_ = Texture(GL_R32F, {size, size});
    second_depth_ = Texture(GL_DEPTH_COMPONENT32F, {size, size});
    coverage_ = Texture(GL_RGBA32UI, {size, size});
    crossings_ = Texture(GL_RGBA32F, {size, 2 * layers * size});
    depth_ = Texture(GL_DEPTH_COMPONENT32F, {size, 2 * layers * size});
    first_edges_ = layers > 1 ? Texture(GL_R32F, {size, 2 * size}) : Texture();
    nearest_target_ = Framebuffer({{nearest_surface_}}, &nearest_depth_);
    second_target_ = Framebuffer({{second_surface_}}, &second_depth_);
    coverage_target_ = Framebuffer({{coverage_}});
    crossing_target_ = Framebuffer({{crossings_}}, &depth_);
    first_target_ = layers > 1 ? Framebuffer({{crossings_}, {first_edges_}}, &depth_) : Framebuffer();
}

void UmbraVolumeMethod::begin(const Program& program, const Frame& frame) const {
    const float from = 0.999F * nearest_, to = far_;
    program.use();
    program.set("penumbra_view.slopes.min", view_.slopes.min);
    program.set("penumbra_view.slopes.max", view_.slopes.max);
    program.set("penumbra_view.resolution", view_.resolution);
    program.set(
        "penumbra_clip_z",
        (frame.reverse_depth ? glm::vec2(-from, from * to) : glm::vec2(to + from, -2.0F * from * to)) / (to - from));
}

void UmbraVolumeMethod::draw(const Geometry&, const Frame& frame, Timers& timers) {
    if (has_casters_) {
        {
            const Timers::Scope scope(timers, "casters");
            draw_casters(frame);
        }
        {
            const Timers::Scope scope(timers, "volumes");
            draw_volumes(frame, 0);
        }
        if (options_.layers > 1) {
            const Timers::Scope scope(timers, "second layer");
            draw_volumes(frame, 1);
        }
    }
    const Timers::Scope scope(timers, "shade");
    State{}.set();
    frame.target.bind();
    shade_.use();
    tell_points(shade_, frame);
    shade_.set("crossings", 1, crossings_);
    shade_.set("edges", 2, edges_);
    shade_.set("light", frame_);
    shade_.set("radius", radius_);
    shade_.set("view.slopes.min", view_.slopes.min);
    shade_.set("view.slopes.max", view_.slopes.max);
    shade_.set("view.resolution", view_.resolution);
    shade_.draw_full_screen();
}

/// The two nearest surfaces, which casters there are, and from both where rays are blocked.
void UmbraVolumeMethod::draw_casters(const Frame& frame) const {
    const float farthest = frame.reverse_depth ? 0.0F : 1.0F;
    State nearest;
    nearest.depth = frame.reverse_depth ? GL_GREATER : GL_LESS;
    nearest.set();
    nearest_target_.clear_color(0, glm::vec4(0.0F));
    nearest_target_.clear_depth(farthest);
    begin(nearest_surfaces_, frame);
    caster_triangles_.draw();

    second_target_.clear_color(0, glm::vec4(0.0F));
    second_target_.clear_depth(farthest);
    begin(second_surfaces_, frame);
    second_surfaces_.set("penumbra_nearest", 0, nearest_surface_);
    caster_triangles_.draw();

    State{}.set();
    coverage_target_.clear_integers(0, glm::uvec4(0U));
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_OR);
    begin(coverage_bits_, frame);
    caster_triangles_.draw();
    glDisable(GL_COLOR_LOGIC_OP);

    constexpr float none = std::numeric_limits<float>::max();
    crossing_target_.clear_color(0, glm::vec4(none, 0.0F, 0.0F, none));
    crossing_target_.clear_depth(farthest);
    glViewport(0, 0, options_.resolution, options_.resolution);
    begin(blocking_, frame);
    blocking_.set("penumbra_nearest", 0, nearest_surface_);
    blocking_.set("penumbra_second", 1, second_surface_);
    blocking_.draw_full_screen();
}

/// The nearest crossings of umbrae and of penumbrae, or the nearest of another edge.
void UmbraVolumeMethod::draw_volumes(const Frame& frame, int layer) const {
    const bool keeps_edges = layer == 0 && options_.layers > 1;
    const Framebuffer& target = keeps_edges ? first_target_ : crossing_target_;
    if (keeps_edges) target.clear_color(1, glm::vec4(-1.0F));
    target.bind();
    State nearest;
    nearest.depth = frame.reverse_depth ? GL_GREATER : GL_LESS;
    nearest.set();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // where rays are blocked stays
    const Program& program = layer == 0 ? volumes_ : volumes_behind_;
    begin(program, frame);
    program.set("penumbra_coverage", 0, coverage_);
    if (layer > 0) program.set("penumbra_edges", 1, first_edges_);
    const auto draw = [&](const Triangles& triangles, bool is_umbra) {
        const int row = (2 * layer + (is_umbra ? 0 : 1)) * options_.resolution;
        glViewport(0, row, options_.resolution, options_.resolution);
        program.set("penumbra_umbra", is_umbra);
        program.set("penumbra_row", row);
        triangles.draw();
    };
    draw(umbra_triangles_, true);
    draw(penumbra_triangles_, false);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace

std::unique_ptr<Method> make_umbra_volume(const Capabilities&) { return std::make_unique<UmbraVolumeMethod>(); }

}  // namespace penumbra::opengl
