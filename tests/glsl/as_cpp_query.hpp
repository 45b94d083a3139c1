// Whole queries as C++, with the options that are defined at the moment; may be included again and again, each time in
// another namespace below glsl. Forgets options and include guards, so that the next one starts afresh. All methods but
// for those that PENUMBRA_WITHOUT_... leaves out.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"  // some options leave a parameter unused
#include "../../shaders/penumbra/light.glsl"
#include "../../shaders/penumbra/plan/extents.glsl"
#ifndef PENUMBRA_WITHOUT_SLICES
#include "../../shaders/penumbra/occlusion_texture/shadow.glsl"
#endif
#ifndef PENUMBRA_WITHOUT_WEDGES
#include "../../shaders/penumbra/penumbra_wedge/clip.glsl"
#include "../../shaders/penumbra/penumbra_wedge/coverage.glsl"
#include "../../shaders/penumbra/penumbra_wedge/edge_union.glsl"
#include "../../shaders/penumbra/penumbra_wedge/overlap.glsl"
#include "../../shaders/penumbra/penumbra_wedge/packing.glsl"
#include "../../shaders/penumbra/penumbra_wedge/shadow.glsl"
#include "../../shaders/penumbra/penumbra_wedge/silhouette.glsl"
#include "../../shaders/penumbra/penumbra_wedge/wedge.glsl"
#endif
#ifndef PENUMBRA_WITHOUT_MAPS
#include "../../shaders/penumbra/soft_shadow_map/discontinuity.glsl"
#include "../../shaders/penumbra/soft_shadow_map/light_interval.glsl"
#include "../../shaders/penumbra/soft_shadow_map/light_map.glsl"
#include "../../shaders/penumbra/soft_shadow_map/linear_visibility.glsl"
#include "../../shaders/penumbra/soft_shadow_map/row_segments.glsl"
#include "../../shaders/penumbra/soft_shadow_map/skin.glsl"
#include "../../shaders/penumbra/soft_shadow_map/skin_maps.glsl"
#endif
#ifndef PENUMBRA_WITHOUT_VOLUMES
#include "../../shaders/penumbra/umbra_volume/cut_share.glsl"
#include "../../shaders/penumbra/umbra_volume/d_buffer.glsl"
#include "../../shaders/penumbra/umbra_volume/d_buffer_view.glsl"
#include "../../shaders/penumbra/umbra_volume/disk_coverage.glsl"
#include "../../shaders/penumbra/umbra_volume/disk_visibility.glsl"
#include "../../shaders/penumbra/umbra_volume/extrusion.glsl"
#include "../../shaders/penumbra/umbra_volume/silhouette.glsl"
#endif
#pragma GCC diagnostic pop

// What was compiled.
#ifndef PENUMBRA_WITHOUT_SLICES
struct Query {
    using Slices = PENUMBRA_SLICE_SAMPLER;
    using Info = penumbra_OcclusionTexture;
    static constexpr int filter = PENUMBRA_OCCLUSION_TEXTURE_FILTER;
    static constexpr int combination = PENUMBRA_OCCLUSION_TEXTURE_COMBINATION;
    static constexpr int channels = PENUMBRA_OCCLUSION_TEXTURE_CHANNELS;
    static constexpr int cells = PENUMBRA_OCCLUSION_TEXTURE_CELLS;
    static constexpr int plane = PENUMBRA_OCCLUSION_TEXTURE_PLANE;
    static constexpr int self_shadow = PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW;
    static constexpr float bias = PENUMBRA_OCCLUSION_TEXTURE_BIAS;

    static float visibility(Slices masks, Slices depths, const Info& info, vec3 point_ls) {
        return penumbra_visibility(masks, depths, info, point_ls);
    }
};

#endif
#ifndef PENUMBRA_WITHOUT_WEDGES
struct WedgeQuery {
    using Info = penumbra_WedgeShadow;
    static constexpr int overlap = PENUMBRA_PENUMBRA_WEDGE_OVERLAP;
    static constexpr int silhouette = PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE;
    static constexpr int bitmask_size = PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE;
    static constexpr float tolerance = PENUMBRA_PENUMBRA_WEDGE_TOLERANCE;

    static float visibility(sampler2D wedges, const Info& info, vec3 point_ls) {
        return penumbra_visibility(wedges, info, point_ls);
    }
};

#endif
#ifndef PENUMBRA_WITHOUT_MAPS
struct SkinMapQuery {
    using View = penumbra_LightMapView;
    static constexpr bool hard = PENUMBRA_SOFT_SHADOW_MAP_HARD != 0;
    static constexpr bool edges = PENUMBRA_SOFT_SHADOW_MAP_EDGES != 0;

    static float visibility(sampler2D maps, sampler2D both, const View& view, int count, vec3 point_ls) {
        return penumbra_visibility(maps, both, view, count, point_ls);
    }
};

struct RowSegmentQuery {
    using View = penumbra_LightMapView;
    static constexpr bool mask = PENUMBRA_SOFT_SHADOW_MAP_MASK != 0;

    static float visibility(sampler2D segments, const View& view, float first, float last, vec3 point_ls) {
        return penumbra_visibility(segments, view, first, last, point_ls);
    }
};

#endif
#ifndef PENUMBRA_WITHOUT_VOLUMES
struct DBufferQuery {
    using View = penumbra_DBufferView;
    static constexpr int layers = PENUMBRA_UMBRA_VOLUME_LAYERS;
    static constexpr int form = PENUMBRA_UMBRA_VOLUME_VISIBILITY;
    static constexpr int share = PENUMBRA_UMBRA_VOLUME_SHARE;
    static constexpr int depth = PENUMBRA_UMBRA_VOLUME_DEPTH;

    static float visibility(sampler2D crossings, sampler2D edges, const View& view, float radius, vec3 point_ls) {
        return penumbra_visibility(crossings, edges, view, radius, point_ls);
    }
};
#endif

#undef PENUMBRA_BOXES_GLSL
#undef PENUMBRA_COMBINE_GLSL
#undef PENUMBRA_GEOMETRY_GLSL
#undef PENUMBRA_KERNEL_GLSL
#undef PENUMBRA_LIGHT_GLSL
#undef PENUMBRA_MIPMAP_GLSL
#undef PENUMBRA_NUMERIC_GLSL
#undef PENUMBRA_N_BUFFER_GLSL
#undef PENUMBRA_OCCLUSION_TEXTURE_SHADOW_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_BITMASK_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_BLENDING_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_CLIP_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_COVERAGE_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_EDGE_UNION_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_OVERLAP_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_PACKING_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_POINT_TILE_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_RADIAL_PART_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_SHADOW_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_TILE_SUMS_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_UNION_BLENDING_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_WEDGE_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_WEDGE_INDEX_GLSL
#undef PENUMBRA_PENUMBRA_WEDGE_WEDGE_TEXELS_GLSL
#undef PENUMBRA_PLAN_EXTENTS_GLSL
#undef PENUMBRA_SLICES_GLSL
#undef PENUMBRA_SLICE_CAMERA_GLSL
#undef PENUMBRA_SOFT_SHADOW_MAP_DISCONTINUITY_GLSL
#undef PENUMBRA_SOFT_SHADOW_MAP_LIGHT_INTERVAL_GLSL
#undef PENUMBRA_SOFT_SHADOW_MAP_LIGHT_MAP_GLSL
#undef PENUMBRA_SOFT_SHADOW_MAP_LINEAR_VISIBILITY_GLSL
#undef PENUMBRA_SOFT_SHADOW_MAP_ROW_SEGMENTS_GLSL
#undef PENUMBRA_SOFT_SHADOW_MAP_SKIN_GLSL
#undef PENUMBRA_SOFT_SHADOW_MAP_SKIN_MAPS_GLSL
#undef PENUMBRA_SUMMED_AREA_GLSL
#undef PENUMBRA_UMBRA_VOLUME_CUT_SHARE_GLSL
#undef PENUMBRA_UMBRA_VOLUME_D_BUFFER_GLSL
#undef PENUMBRA_UMBRA_VOLUME_D_BUFFER_VIEW_GLSL
#undef PENUMBRA_UMBRA_VOLUME_DISK_COVERAGE_GLSL
#undef PENUMBRA_UMBRA_VOLUME_DISK_VISIBILITY_GLSL
#undef PENUMBRA_UMBRA_VOLUME_EXTRUSION_GLSL
#undef PENUMBRA_UMBRA_VOLUME_SILHOUETTE_GLSL
#undef PENUMBRA_OCCLUSION_TEXTURE_BIAS
#undef PENUMBRA_OCCLUSION_TEXTURE_CELLS
#undef PENUMBRA_OCCLUSION_TEXTURE_CHANNELS
#undef PENUMBRA_OCCLUSION_TEXTURE_COMBINATION
#undef PENUMBRA_OCCLUSION_TEXTURE_FILTER
#undef PENUMBRA_OCCLUSION_TEXTURE_PLANE
#undef PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW
#undef PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE
#undef PENUMBRA_PENUMBRA_WEDGE_CELLS
#undef PENUMBRA_PENUMBRA_WEDGE_OVERLAP
#undef PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE
#undef PENUMBRA_PENUMBRA_WEDGE_TOLERANCE
#undef PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES
#undef PENUMBRA_SOFT_SHADOW_MAP_EDGES
#undef PENUMBRA_SOFT_SHADOW_MAP_HARD
#undef PENUMBRA_SOFT_SHADOW_MAP_MASK
#undef PENUMBRA_UMBRA_VOLUME_DEPTH
#undef PENUMBRA_UMBRA_VOLUME_LAYERS
#undef PENUMBRA_UMBRA_VOLUME_SHARE
#undef PENUMBRA_UMBRA_VOLUME_VISIBILITY
#undef PENUMBRA_LIGHT_UNION_PARTS
#undef PENUMBRA_SLICE_SAMPLER
#undef PENUMBRA_WEDGE_PARTS
