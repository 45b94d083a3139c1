// Knobs as a plan has them.
#pragma once

#include <penumbra/plan/planner.hpp>
#include <variant>

#include "../../scenes/scene.hpp"

namespace penumbra::opengl {

/// The plan of a method with these options, over the scene's casters and its ground. `scene.light` is of its kind.
template <class Shadow>
Plan<Shadow> planned(const scenes::Scene& scene, const typename Shadow::Options& full, float tolerance) {
    PlanSettings<Shadow> settings;
    settings.full = full;
    return plan_for<Shadow>(scene.casters, std::get<typename Shadow::Light>(scene.light), {scene.ground}, tolerance,
                            settings);
}

}  // namespace penumbra::opengl
