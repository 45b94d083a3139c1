// Everything that is looked at, in a window or without: a scene, a method, the truth, and what is shown of them.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../pictures/picture.hpp"
#include "../scenes/scene.hpp"
#include "context.hpp"
#include "gl/timers.hpp"
#include "methods/method.hpp"
#include "presenter.hpp"
#include "renderer.hpp"
#include "truth.hpp"

namespace penumbra::opengl {

/// Needs a current context for as long as it lives.
class Viewer {
  public:
    /// Reverse depth where it is wanted and the driver has it.
    Viewer(scenes::Scene scene, const std::string& method, const Capabilities& can, bool reverse_depth);

    const scenes::Scene& scene() const { return scene_; }
    const std::string& method_name() const { return method_name_; }
    const Method& method() const { return *method_; }
    Timers& timers() { return timers_; }
    const Renderer& renderer() const { return renderer_; }
    const Texture& picture() const { return presenter_.picture(); }
    /// Classes of the latest frame's tiles, if its method was asked by tiles.
    const Texture* tiles() const { return has_tiles() ? &tile_classes_.classes() : nullptr; }
    int truth_rays() const { return truth_.rays(); }

    // what can change; each takes effect with the next frame
    void set_scene(scenes::Scene scene);  ///< a light that the method is not for: another method
    void set_light(const scenes::Light& light);
    void set_camera(const scenes::Camera& camera);
    void set_method(
        const std::string& name);  ///< a method that is not for the light makes the light one that it is for
    /// The method's, and what tiles are for: "show" colours them by their classes.
    std::vector<Knob> knobs();
    void knob_changed();
    /// Turns the method's knobs as a plan has them; what it decided, an empty text where there are no plans.
    const std::string& plan(float tolerance);
    const std::string& plan_words() const { return plan_words_; }
    /// "name=value", the value a number or a name. Throws std::runtime_error with a message for the user.
    void set_knob(const std::string& setting);
    void resize(glm::ivec2 size) { renderer_.resize(size); }

    Show show;
    bool traces = true;  ///< whether the truth is traced

    void draw_frame();
    void show_in_window(glm::ivec2 size) const { presenter_.show_in_window(size); }
    /// The picture as it is on the GPU, top row first.
    Image<pictures::Rgb> screenshot() const;

    /// What the last frame asked, and what it got: by the method, by the C++ with the same knobs, by rays.
    struct Asked {
        std::vector<Vec3<float>> points;
        std::vector<std::size_t> pixels;  ///< row 0 at the bottom, as OpenGL has it
        std::vector<float> visible;
    };
    Asked asked() const;
    std::vector<float> by_cpp(const std::vector<Vec3<float>>& points) const;
    std::vector<float> by_rays(int rays);  ///< waits

  private:
    enum class Tiles { off, on, show };

    bool has_tiles() const { return tiles_ != Tiles::off && method_->tile_view().has_value(); }
    void restart_truth();
    void show_truth();

    Capabilities can_;
    scenes::Scene scene_;
    std::string method_name_;
    std::unique_ptr<Method> method_;
    std::string plan_words_;
    Tiles tiles_ = Tiles::off;
    TileClasses tile_classes_;
    Renderer renderer_;
    Presenter presenter_;
    Timers timers_;
    Truth truth_;
    Texture truth_image_;
    std::vector<std::size_t> truth_pixels_;
    int truth_seen_ = 0;
    glm::ivec2 truth_size_{0, 0};
    bool is_prepared_ = false, truth_is_old_ = true;
};

/// The methods for a light, in the order of method_names().
std::vector<std::string> methods_for(const scenes::Light& light, const Capabilities& can);

}  // namespace penumbra::opengl
