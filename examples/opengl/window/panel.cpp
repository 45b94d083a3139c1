#include "panel.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "light_edit.hpp"

namespace penumbra::opengl {
namespace {

/// A choice among names; true if another than `current` was chosen, which then is in it.
bool choose(const char* label, const std::vector<std::string>& names, std::string& current) {
    bool is_new = false;
    if (!ImGui::BeginCombo(label, current.c_str())) return false;
    for (const std::string& name : names)
        if (ImGui::Selectable(name.c_str(), name == current) && name != current) {
            current = name;
            is_new = true;
        }
    ImGui::EndCombo();
    return is_new;
}

bool choose_scene(Viewer& viewer) {
    std::string scene = viewer.scene().name, kind = scenes::kind_of(viewer.scene().light),
                method = viewer.method_name();
    const bool is_new = choose("scene", scenes::scene_names(), scene);
    if (is_new) viewer.set_scene(scenes::make_scene(scene));
    if (choose("light", scenes::light_kinds(), kind)) viewer.set_light(scenes::as_kind(viewer.scene().light, kind));
    if (choose("method", method_names(), method)) viewer.set_method(method);
    return is_new;
}

void edit_light(Viewer& viewer) {
    const scenes::Light light = viewer.scene().light;
    const Vec3<float> center = scenes::center_of(light);
    Vec3<float> at = center;
    if (ImGui::DragFloat3("centre", &at.x, 0.02F)) viewer.set_light(moved(light, at - center));
    const std::vector<LightSize> sizes = sizes_of(light);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        float size = sizes[i].value;
        if (ImGui::DragFloat(sizes[i].name, &size, 0.01F, 0.001F, 20.0F, "%.3f", ImGuiSliderFlags_AlwaysClamp))
            viewer.set_light(resized(light, i, size));
    }
    float turn[2] = {0.0F, 0.0F};
    if (ImGui::DragFloat2("turn, tilt", turn, 0.01F, -1.0F, 1.0F, "drag"))
        viewer.set_light(
            turned(turned(light, Vec3<float>(0.0F, 1.0F, 0.0F), turn[0]), Vec3<float>(0.0F, 0.0F, 1.0F), turn[1]));
}

void turn_knobs(Viewer& viewer) {
    for (const Knob& knob : viewer.knobs()) {
        const double before = knob.get();
        double after = before;
        if (!knob.names.empty()) {
            std::string name = knob.names[static_cast<std::size_t>(before)];
            if (choose(knob.name.c_str(), knob.names, name))
                after = static_cast<double>(std::find(knob.names.begin(), knob.names.end(), name) - knob.names.begin());
        } else if (knob.whole) {
            int value = static_cast<int>(before);
            ImGui::SliderInt(knob.name.c_str(), &value, static_cast<int>(knob.least), static_cast<int>(knob.most), "%d",
                             ImGuiSliderFlags_AlwaysClamp);
            after = value;
        } else {
            auto value = static_cast<float>(before);
            ImGui::SliderFloat(knob.name.c_str(), &value, static_cast<float>(knob.least), static_cast<float>(knob.most),
                               "%.4f", ImGuiSliderFlags_AlwaysClamp);
            if (value != static_cast<float>(before)) after = static_cast<double>(value);
        }
        if (after == before) continue;
        knob.set(after);
        viewer.knob_changed();
    }
}

void plan(Viewer& viewer) {
    static float tolerance = 0.02F;
    ImGui::SliderFloat("tolerance", &tolerance, 0.0F, 0.2F, "%.3f", ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::Button("Turn knobs as planned")) viewer.plan(tolerance);
    if (!viewer.plan_words().empty()) ImGui::TextWrapped("%s", viewer.plan_words().c_str());
}

void choose_picture(Viewer& viewer) {
    static const std::vector<std::string> names{"shaded", "visibility", "difference"};
    std::string name = names[static_cast<std::size_t>(viewer.show.picture)];
    if (choose("picture", names, name))
        viewer.show.picture = static_cast<Picture>(std::find(names.begin(), names.end(), name) - names.begin());
    ImGui::SliderFloat("split", &viewer.show.split, 0.0F, 1.0F, "truth from %.2f on");
    ImGui::Checkbox("trace the truth", &viewer.traces);
    ImGui::Text("%d rays a point", viewer.truth_rays());
}

void show_times(const Timers& timers) {
    float sum = 0.0F;
    for (const Timers::Pass& pass : timers.passes()) {
        if (pass.milliseconds.empty()) continue;
        const std::vector<float> history(pass.milliseconds.begin(), pass.milliseconds.end());
        const float most = *std::max_element(history.begin(), history.end());
        ImGui::PlotLines(fmt::format("{:.3f} ms {}", history.back(), pass.name).c_str(), history.data(),
                         static_cast<int>(history.size()), 0, nullptr, 0.0F, most, ImVec2(90.0F, 18.0F));
        sum += history.back();
    }
    ImGui::Text("%.3f ms on the GPU", static_cast<double>(sum));
}

}  // namespace

Pressed draw_panel(Viewer& viewer, bool is_paused) {
    Pressed pressed;
    ImGui::SetNextWindowPos(ImVec2(8.0F, 8.0F), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(ImVec2(330.0F, 0.0F), ImGuiCond_FirstUseEver);
    ImGui::Begin("penumbra");
    pressed.camera = choose_scene(viewer);
    if (ImGui::CollapsingHeader("Light", ImGuiTreeNodeFlags_DefaultOpen)) edit_light(viewer);
    if (ImGui::CollapsingHeader("Knobs", ImGuiTreeNodeFlags_DefaultOpen)) turn_knobs(viewer);
    if (ImGui::CollapsingHeader("Plan")) plan(viewer);
    if (ImGui::CollapsingHeader("Picture", ImGuiTreeNodeFlags_DefaultOpen)) choose_picture(viewer);
    if (ImGui::CollapsingHeader("Time", ImGuiTreeNodeFlags_DefaultOpen)) show_times(viewer.timers());
    pressed.screenshot = ImGui::Button("Screenshot (S)");
    ImGui::SameLine();
    pressed.pause = ImGui::Button(is_paused ? "Go on (space)" : "Pause (space)");
    ImGui::TextDisabled("Drag: turn; shift: move; wheel: zoom.\nRight button: light; shift: height; wheel: size.");
    ImGui::End();
    return pressed;
}

}  // namespace penumbra::opengl
