#include "viewer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace penumbra::opengl {
namespace {

/// A kind of light that a method is for.
std::string kind_for(const Method& method, const scenes::Light& light) {
    for (const std::string& kind : scenes::light_kinds())
        if (method.takes(scenes::as_kind(light, kind))) return kind;
    throw std::logic_error("a method is for no kind of light");
}

double knob_value(const Knob& knob, const std::string& text) {
    for (std::size_t i = 0; i < knob.names.size(); ++i)
        if (knob.names[i] == text) return static_cast<double>(i);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc() && end == text.data() + text.size() && knob.names.empty();
    const bool is_within = value >= knob.least * (1.0 - 1e-6) && value <= knob.most * (1.0 + 1e-6);  // as floats
    if (!is_number || !is_within || (knob.whole && value != std::floor(value))) {
        std::string domain = std::to_string(knob.least) + " to " + std::to_string(knob.most);
        if (!knob.names.empty()) domain.clear();
        for (const std::string& name : knob.names) domain += (domain.empty() ? "" : ", ") + name;
        throw std::runtime_error("knob " + knob.name + " is " + domain + ", not '" + text + "'");
    }
    return std::clamp(value, knob.least, knob.most);
}

}  // namespace

std::vector<std::string> methods_for(const scenes::Light& light, const Capabilities& can) {
    std::vector<std::string> names;
    for (const std::string& name : method_names())
        if (make_method(name, can)->takes(light)) names.push_back(name);
    return names;
}

Viewer::Viewer(scenes::Scene scene, const std::string& method, const Capabilities& can, bool reverse_depth)
    : can_(can), renderer_(reverse_depth && can.reverse_depth) {
    scene_ = std::move(scene);
    set_method(method);
    set_scene(scene_);
}

void Viewer::set_scene(scenes::Scene scene) {
    scene_ = std::move(scene);
    renderer_.set_scene(scene_);
    truth_.set_casters(scene_);
    set_light(scene_.light);
}

void Viewer::set_light(const scenes::Light& light) {
    scene_.light = light;
    if (!method_->takes(light)) set_method(methods_for(light, can_).front());
    is_prepared_ = false;
    truth_is_old_ = true;
}

void Viewer::set_camera(const scenes::Camera& camera) {
    scene_.camera = camera;
    truth_is_old_ = true;
}

void Viewer::set_method(const std::string& name) {
    method_ = make_method(name, can_);
    method_name_ = name;
    plan_words_.clear();
    timers_.clear();
    is_prepared_ = false;
    if (!method_->takes(scene_.light)) set_light(scenes::as_kind(scene_.light, kind_for(*method_, scene_.light)));
}

std::vector<Knob> Viewer::knobs() {
    std::vector<Knob> knobs = method_->knobs();
    if (method_->tile_view()) knobs.push_back(choice_knob("tiles", tiles_, {"off", "on", "show"}));
    return knobs;
}

void Viewer::knob_changed() { is_prepared_ = false; }

const std::string& Viewer::plan(float tolerance) {
    plan_words_ = method_->plan(scene_, tolerance);
    knob_changed();
    return plan_words_;
}

void Viewer::set_knob(const std::string& setting) {
    const std::size_t equals = setting.find('=');
    const std::string name = setting.substr(0, equals);
    std::string names;
    for (const Knob& knob : knobs()) {
        names += (names.empty() ? "" : ", ") + knob.name;
        if (knob.name != name || equals == std::string::npos) continue;
        knob.set(knob_value(knob, setting.substr(equals + 1)));
        return knob_changed();
    }
    throw std::runtime_error(method_name_ + " has no knob '" + name + "' (name=value); it has " + names);
}

void Viewer::draw_frame() {
    timers_.next_frame();
    if (!is_prepared_) {
        method_->prepare(scene_, renderer_.geometry());
        if (has_tiles()) tile_classes_.prepare(scene_, *method_->tile_view());
    }
    is_prepared_ = true;
    renderer_.draw(scene_, *method_, has_tiles() ? &tile_classes_ : nullptr, timers_);
    const bool needs_truth = show.picture == Picture::difference || show.split < 1.0F;
    if (needs_truth && traces && (truth_is_old_ || truth_size_ != renderer_.size())) restart_truth();
    show_truth();
    presenter_.draw(renderer_, truth_image_, tiles_ == Tiles::show ? tiles() : nullptr, scene_, show);
}

void Viewer::restart_truth() {
    Asked asked = this->asked();
    truth_.start(scene_.light, std::move(asked.points));
    truth_pixels_ = std::move(asked.pixels);
    truth_is_old_ = false;
    truth_size_ = renderer_.size();
    truth_seen_ = 0;
}

void Viewer::show_truth() {
    const glm::ivec2 size = renderer_.size();
    std::vector<float> visible;
    const bool is_new = truth_.fetch(truth_seen_, visible);
    if (!is_new && !truth_image_.empty() && truth_image_.size() == size) return;
    std::vector<float> image(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), -1.0F);
    if (truth_size_ == size)
        for (std::size_t i = 0; i < visible.size(); ++i) image[truth_pixels_[i]] = visible[i];
    if (truth_image_.empty() || truth_image_.size() != size) truth_image_ = Texture(GL_R32F, size);
    truth_image_.upload(GL_RED, GL_FLOAT, image.data());
}

Image<pictures::Rgb> Viewer::screenshot() const {
    const glm::ivec2 size = picture().size();
    const std::vector<std::uint8_t> bytes = picture().bytes();
    Image<pictures::Rgb> result(size.x, size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t at = static_cast<std::size_t>((size.y - 1 - y) * size.x + x) * 4;
            result(x, y) = pictures::Rgb(bytes[at], bytes[at + 1], bytes[at + 2]);
        }
    return result;
}

Viewer::Asked Viewer::asked() const {
    const std::vector<float> at = renderer_.positions().floats(4), visible = renderer_.visibility().floats(1);
    Asked result;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        if (!(at[4 * i + 3] > 0.0F)) continue;
        result.points.emplace_back(at[4 * i], at[4 * i + 1], at[4 * i + 2]);
        result.pixels.push_back(i);
        result.visible.push_back(visible[i]);
    }
    return result;
}

std::vector<float> Viewer::by_cpp(const std::vector<Vec3<float>>& points) const {
    std::vector<float> visible(points.size());
    method_->by_cpp(scene_)(points.data(), points.size(), visible.data());
    return visible;
}

std::vector<float> Viewer::by_rays(int rays) {
    if (truth_is_old_ || truth_size_ != renderer_.size()) restart_truth();
    return truth_.wait_for(rays);
}

}  // namespace penumbra::opengl
