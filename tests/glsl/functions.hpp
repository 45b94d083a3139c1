// Every twin that reads no texture.
#pragma once

#include <vector>

#include "functions/combine.hpp"
#include "functions/geometry.hpp"
#include "functions/light.hpp"
#include "functions/numeric.hpp"
#include "functions/occlusion_texture.hpp"
#include "functions/penumbra_wedge_bitmask.hpp"
#include "functions/penumbra_wedge_coverage.hpp"
#include "functions/penumbra_wedge_overlap.hpp"
#include "functions/penumbra_wedge_packing.hpp"
#include "functions/penumbra_wedge_union.hpp"
#include "functions/penumbra_wedge_wedge.hpp"
#include "functions/plan.hpp"
#include "functions/soft_shadow_map.hpp"
#include "functions/soft_shadow_map_rows.hpp"
#include "functions/umbra_volume.hpp"
#include "functions/umbra_volume_d_buffer.hpp"

namespace penumbra::test::functions {

inline std::vector<Function> all() {
    std::vector<Function> result;
    add_numeric(result);
    add_geometry(result);
    add_light(result);
    add_combine(result);
    add_occlusion_texture(result);
    add_penumbra_wedge_bitmask(result);
    add_penumbra_wedge_coverage(result);
    add_penumbra_wedge_overlap(result);
    add_penumbra_wedge_packing(result);
    add_penumbra_wedge_union(result);
    add_penumbra_wedge_wedge(result);
    add_plan(result);
    add_soft_shadow_map(result);
    add_soft_shadow_map_rows(result);
    add_umbra_volume(result);
    add_umbra_volume_d_buffer(result);
    return result;
}

}  // namespace penumbra::test::functions

#undef PENUMBRA_TEXT
#undef GLSL
#undef V2
#undef V3
#undef RECT
#undef BOX
#undef EXTENT
#undef FRAME
#undef CAMERA
#undef RANGE
#undef PUT2
#undef PUT3
#undef PUT_RECT
