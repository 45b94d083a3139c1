#include "settings.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "progress.hpp"

namespace penumbra::study {
namespace {

struct Method {
    const char* name;
    std::vector<Setting> (*settings)(Sweep);
};
constexpr std::array<Method, 4> methods = {{{"occlusion_texture", occlusion_texture_settings},
                                            {"penumbra_wedge", penumbra_wedge_settings},
                                            {"umbra_volume", umbra_volume_settings},
                                            {"soft_shadow_map", soft_shadow_map_settings}}};

Sweep default_sweep(const std::string& method, Subject subject) {
    if (subject == Subject::occlusion_textures && method != "occlusion_texture") return Sweep::one;
    if (subject == Subject::overlap && method != "penumbra_wedge") return Sweep::none;
    if (subject == Subject::lines) return Sweep::few;
    return Sweep::all;
}

}  // namespace

std::vector<float> ask(const Built& built, const std::vector<Vec3<float>>& points) {
    std::vector<float> result(points.size());
    in_parallel(points.size(), [&](std::size_t first, std::size_t count) {
        built.visibility(points.data() + first, count, result.data() + first);
    });
    return result;
}

void add_new(std::vector<Setting>& all, const Setting& one) {
    for (const Setting& there : all)
        if (there.knobs == one.knobs) return;
    all.push_back(one);
}

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const Method& method : methods) names.emplace_back(method.name);
    return names;
}

std::vector<Setting> settings_of(const std::string& name, Sweep sweep) {
    for (const Method& method : methods)
        if (name == method.name) return sweep == Sweep::none ? std::vector<Setting>() : method.settings(sweep);
    throw std::runtime_error("there is no method '" + name + "'");
}

std::vector<Setting> settings_for(const Scene& scene, const std::vector<std::string>& wanted, bool quick) {
    std::vector<Setting> all;
    for (const Method& method : methods) {
        const bool named = std::find(wanted.begin(), wanted.end(), method.name) != wanted.end();
        if (!wanted.empty() && !named) continue;
        const Sweep most = named ? Sweep::all : default_sweep(method.name, scene.subject);
        for (Setting& setting : settings_of(method.name, quick ? std::min(most, Sweep::few) : most))
            if (setting.takes(scene.light)) all.push_back(std::move(setting));
    }
    return all;
}

}  // namespace penumbra::study
