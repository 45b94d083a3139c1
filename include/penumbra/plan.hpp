// Simulate only the effects that a scene calls for: plans with a bound on what they leave out, and shadows built by
// them.
#pragma once

#include <penumbra/plan/cost.hpp>
#include <penumbra/plan/effect.hpp>
#include <penumbra/plan/extents.hpp>
#include <penumbra/plan/method_front.hpp>
#include <penumbra/plan/planned_shadow.hpp>
#include <penumbra/plan/planner.hpp>
