// Every public template for float and double, so that each variant compiles bodies and not only declarations.
#include <penumbra/penumbra.hpp>

#define INSTANTIATE(T)                                                                                             \
    template T saturate(T);                                                                                        \
    template T saturated_ratio(T, T);                                                                              \
    template T safe_ratio(T, T, T);                                                                                \
    template T mix(T, T, T);                                                                                       \
    template T exp2_int(int);                                                                                      \
    template Vec3<T> normalize_or(const Vec3<T>&, const Vec3<T>&);                                                 \
    template T safe_length(const Vec3<T>&);                                                                        \
    template Vec3<T> any_perpendicular(const Vec3<T>&);                                                            \
    template T area(const Rect2<T>&);                                                                              \
    template Rect2<T> intersect(const Rect2<T>&, const Rect2<T>&);                                                 \
    template T signed_distance(const Plane<T>&, const Vec3<T>&);                                                   \
    template struct LightFrame<T>;                                                                                 \
    template LightFrame<T> light_frame(const RectLight<T>&, const Vec3<T>&);                                       \
    template LightFrame<T> light_frame(const DiskLight<T>&);                                                       \
    template LightFrame<T> light_frame(const LinearLight<T>&, const Vec3<T>&);                                     \
    template bool validate(const RectLight<T>&);                                                                   \
    template bool validate(const DiskLight<T>&);                                                                   \
    template bool validate(const LinearLight<T>&);                                                                 \
    template bool validate(const Mesh<T>&, const std::string&);                                                    \
    template Box3<T> bounds(const std::vector<Mesh<T>>&);                                                          \
    template EdgeAdjacency edge_adjacency(const Mesh<T>&);                                                         \
    template Mesh<T> weld(const Mesh<T>&);                                                                         \
    template class Image<T>;                                                                                       \
    template T bilinear(const Image<std::uint8_t>&, T, T);                                                         \
    template void rasterize(const RasterVertex<T>&, const RasterVertex<T>&, const RasterVertex<T>&, int, int, T,   \
                            void (&)(int, int, T));                                                                \
    template T combine_product(T, T);                                                                              \
    template T combine_mean(T, T);                                                                                 \
    template T combine(const T*, std::size_t, Combination);                                                        \
    template OcclusionBounds<T> occlusion_bounds(const T*, std::size_t);                                           \
    template T kernel_scale(T, T);                                                                                 \
    template T kernel_size(T, T, T);                                                                               \
    template Rect2<T> kernel_rect(T, const Vec3<T>&, const Rect2<T>&);                                             \
    template class MipMap<T>;                                                                                      \
    template class NBuffer<T>;                                                                                     \
    template class OcclusionTextureShadow<T>;                                                                      \
    template T edge_coverage(const Vec2<T>&, const Vec2<T>&, const Rect2<T>&);                                     \
    template CoverageMoments<T> edge_moments(const Vec2<T>&, const Vec2<T>&, const Rect2<T>&);                     \
    template T loop_coverage(const Vec2<T>*, std::size_t, const Rect2<T>&);                                        \
    template ProjectedEdge<T> project_edge(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&, const Rect2<T>&);       \
    template void project_loop(const Vec3<T>*, std::size_t, const Vec3<T>&, const Rect2<T>&,                       \
                               void (&)(const Vec2<T>&, const Vec2<T>&));                                          \
    template T loop_coverage(const Vec3<T>*, std::size_t, const Vec3<T>&, const Rect2<T>&);                        \
    template T triangle_coverage(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&, const Vec3<T>&, const Rect2<T>&); \
    template struct RadialPartBuilder<T>;                                                                          \
    template RadialPart<T> empty_part();                                                                           \
    template RadialPart<T> full_part();                                                                            \
    template RadialPart<T> valid_part(const RadialPart<T>&);                                                       \
    template Rect2<T> quadrant(const Rect2<T>&, int);                                                              \
    template T overlap_area(const RadialPart<T>&, const RadialPart<T>&);                                           \
    template T overlap_area_centroid(const RadialPart<T>&, const RadialPart<T>&);                                  \
    template RadialPart<T> blend(const RadialPart<T>&, const RadialPart<T>&);                                      \
    template RadialPart<T> blend_centroid(const RadialPart<T>&, const RadialPart<T>&);                             \
    template struct RectangleProduct<T>;                                                                           \
    template PackedParts pack_parts(const std::array<RadialPart<T>, 4>&);                                          \
    template std::array<RadialPart<T>, 4> unpack_parts(const PackedParts&);                                        \
    template class PenumbraWedgeShadow<T>;                                                                         \
    template Vec3<T> face_normal(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&);                                  \
    template T silhouette_tolerance(const Box3<T>&);                                                               \
    template Wedge<T> wedge(const Vec3<T>&, const Vec3<T>&, const Vec2<T>&);                                       \
    template HalfWedge<T> half_wedge(const Wedge<T>&, WedgeHalf);                                                  \
    template bool contains(const Wedge<T>&, const Vec3<T>&);                                                       \
    template bool contains(const HalfWedge<T>&, const Vec3<T>&);                                                   \
    template Vec3<T> wedge_vertex(const Vec3<T>&, const Vec3<T>&, const Vec2<T>&, const Box3<T>&, int);            \
    template int face_winding(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&, T, Surface);                         \
    template std::vector<SilhouetteEdge> silhouette(const Mesh<T>&, const EdgeAdjacency&, const Vec3<T>&,          \
                                                    SilhouetteFrom);                                               \
    template T disk_visibility(T);                                                                                 \
    template T disk_visibility_cubic(T);                                                                           \
    template T disk_visibility_sqrt(T);                                                                            \
    template T disk_visibility(T, T, T);                                                                           \
    template T disk_visibility_between(T, T, T);                                                                   \
    template T disk_edge_coverage(const Vec2<T>&, const Vec2<T>&, T);                                              \
    template NearFarPoints<T> near_far_points(const Vec3<T>&, const DiskLight<T>&);                                \
    template DiskSight disk_sight(const Vec3<T>&, const Vec3<T>&, const DiskLight<T>&, T);                         \
    template VolumeSilhouettes volume_silhouettes(const Mesh<T>&, const DiskLight<T>&);                            \
    template Mesh<T> volume_mesh(const Mesh<T>&, const VolumeSilhouettes&, T, VolumeKind, T, T);                   \
    template std::vector<ConvexPolygon<Vec3<T>, 16>> trimmed_umbra(const std::vector<VolumeSide<T>>&, T);          \
    template T edge_cut_share(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&, T);                                  \
    template T penumbra_cut_share(T, T, T);                                                                        \
    template T umbra_cut_share(T, T, T);                                                                           \
    template class DBuffer<T>;                                                                                     \
    template class UmbraVolumeShadow<T>;                                                                           \
    template ExtrusionPoints<T> extrusion_points(const Vec3<T>&, const Vec3<T>&, const LightFrame<T>&, T);         \
    template ExtrusionPoints<T> extrusion_points(const Vec3<T>&, const Vec3<T>&, const DiskLight<T>&);             \
    template T edge_visibility(const RowPoint<T>&, const RowPoint<T>&, T, T);                                      \
    template T skin_visibility(T);                                                                                 \
    template T skin_visibility(T, T, T, T);                                                                        \
    template LightInterval<T> hidden_interval(const RowPoint<T>&, const RowPoint<T>&, const RowPoint<T>&, T, T);   \
    template class LightUnion<T>;                                                                                  \
    template class LightMask<T>;                                                                                   \
    template T laplacian_of_gaussian(const glm::mat<3, 3, T, glm::defaultp>&);                                     \
    template bool is_laplacian_step(T, T, T);                                                                      \
    template bool is_step(const Vec3<T>&, const Vec3<T>&, T, T);                                                   \
    template Skin<T> warp_skin(T, T, T, T, T);                                                                     \
    template T receiver_under_edge(const Skin<T>&, const RowPoint<T>&, const RowPoint<T>&, T);                     \
    template struct LightMapView<T>;                                                                               \
    template struct LightMap<T>;                                                                                   \
    template class SkinMaps<T>;                                                                                    \
    template class RowSegments<T>;                                                                                 \
    template T narrowest_gap(const LightMapView<T>&, const LightMap<T>&, T);                                       \
    template int samples_for_gap(T, T, int);                                                                       \
    template class SoftShadowMap<T>;                                                                               \
    template std::vector<LinearLight<T>> polygon_edges(const std::vector<Vec3<T>>&);                               \
    template std::vector<LinearLight<T>> polygon_lines(const std::vector<Vec3<T>>&, int);                          \
    template class SoftShadowMaps<T>;

namespace penumbra {

INSTANTIATE(float)
INSTANTIATE(double)
template class Image<std::uint8_t>;
template class MipMap<std::uint8_t>;
template class NBuffer<std::uint8_t>;
template class NBuffer<SliceTexel>;
template class SummedArea<std::uint32_t>;
template class SummedArea<std::uint64_t>;

}  // namespace penumbra
