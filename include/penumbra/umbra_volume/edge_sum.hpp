// The exact mode for disk lights: sums over the edges that are on the silhouette as a point sees it.
//
// The one place where this method stands on another: which edges matter to a point, how points are asked about together
// and how casters unite is the same for every shape of light, and comes from penumbra_wedge's index and blending, which
// see the square around the disk. The areas are the disk's own (disk_coverage.hpp), and of a mask's cells only those
// count whose middle is on the disk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/combine.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/penumbra_wedge/bitmask.hpp>
#include <penumbra/penumbra_wedge/blending.hpp>
#include <penumbra/penumbra_wedge/caster_index.hpp>
#include <penumbra/penumbra_wedge/mask_blending.hpp>
#include <penumbra/penumbra_wedge/union_blending.hpp>
#include <penumbra/umbra_volume/disk_coverage.hpp>
#include <penumbra/umbra_volume/options.hpp>
#include <vector>

namespace penumbra::detail {

/// Of size × size cells of a square, those whose middle lies in the circle that fills it: a word for each column.
struct DiskCells {
    std::array<std::uint32_t, 32> columns{};
    int count = 0;

    DiskCells() = default;
    explicit DiskCells(int size) {
        for (int j = 0; j < size; ++j) {
            std::uint32_t& column = columns[static_cast<std::size_t>(j)];
            for (int k = 0; k < size; ++k) {
                const int x = 2 * j + 1 - size, y = 2 * k + 1 - size;  // in half cells from the centre
                if (x * x + y * y < size * size) column |= 1U << k;
            }
            count += count_bits(column);
        }
    }
};

/// A disk light, as RectShape is a rectangle. In line, so that loops over edges vectorise.
template <class T>
struct DiskShape {
    DiskUnits<T> disk;
    const DiskCells* mask;

    T area() const { return disk.area; }
    [[gnu::always_inline]] T coverage(T ax, T ay, T bx, T by) const {
        return disk_edge_coverage(ax, ay, bx, by, disk, LaneRoot());
    }
    [[gnu::always_inline]] T coverage(const ColumnEdge<T>&, T ax, T ay, T bx, T by) const {
        return coverage(ax, ay, bx, by);
    }
    std::uint32_t cells(int column, int) const { return mask->columns[static_cast<std::size_t>(column)]; }
    int cell_count(int) const { return mask->count; }
};

/// Visibility of a disk light. Cost, degenerate cases and the tolerance for points on casters are those of
/// PenumbraWedgeShadow. Error: of one silhouette that does not lie over itself that of disk_edge_coverage, and where
/// its edges land; of several, that of EdgeUnion.
template <class T>
class DiskEdgeSum {
  public:
    DiskEdgeSum() = default;
    /// Arguments in their domain: see validate(). Everything is visible past no casters. Radius 0 casts hard shadows:
    /// the light is as small as T can tell apart.
    DiskEdgeSum(const std::vector<Mesh<T>>& casters, const DiskLight<T>& light, const UmbraVolumeOptions& options)
        : overlap_(options.overlap),
          bitmask_size_(options.bitmask_size),
          tolerance_(static_cast<T>(options.tolerance)),
          mask_(options.bitmask_size) {
        const Box3<T> box = bounds(casters);
        if (is_empty(box)) return;
        casters_ = CasterIndex<T>(casters, box, light_frame(light), Vec2<T>(light.radius, light.radius),
                                  SilhouetteFrom::point);
    }

    /// Fractions of the light's area that `count` points (world space) see, in [0, 1]; faster if neighbours in the
    /// array are neighbours in space. 1 for points on or behind the light's plane, and for points that are not finite.
    void visibility(const Vec3<T>* points, std::size_t count, T* result) const {
        const DiskShape<T> light{DiskUnits<T>(casters_.scaled_half_size().x), &mask_};
        casters_.visibility(points, count, result, [&](const PointTile<T>& tile, bool may_give_up, T* occlusion) {
            const auto by_areas = [&](Combination rule) {
                AreaBlender<T, DiskShape<T>, 1> blender(tile, {{light}});
                const bool all = casters_.index().visit(tile, blender, may_give_up);
                if (all) blender.result(rule, occlusion);
                return all;
            };
            switch (overlap_) {
                case DiskOverlap::additive:
                    return by_areas(Combination::sum);
                case DiskOverlap::maximum:
                    return by_areas(Combination::max);
                case DiskOverlap::product:
                    return by_areas(Combination::product);
                case DiskOverlap::bitmask:
                    return blend_by_masks(casters_.index(), tile, light, bitmask_size_, tolerance_, may_give_up,
                                          occlusion);
                case DiskOverlap::exact:
                    break;
            }
            return blend_exactly(casters_.index(), tile, light, bitmask_size_, tolerance_, may_give_up, occlusion);
        });
    }

    /// See CasterIndex::variation().
    Variation<T> variation(const Box3<T>& box_ls, T radius, T most, const Vec3<T>* points, std::size_t count) const {
        return casters_.variation(box_ls, {pi<T> * radius * radius, true}, most,
                                  overlap_ == DiskOverlap::exact     ? OverlapChange::outline
                                  : overlap_ == DiskOverlap::bitmask ? OverlapChange::none
                                                                     : OverlapChange::sum,
                                  points, count);
    }
    std::size_t bytes() const { return casters_.index().bytes(); }

  private:
    DiskOverlap overlap_ = DiskOverlap::exact;
    int bitmask_size_ = 32;
    T tolerance_ = T(0);
    DiskCells mask_;
    CasterIndex<T> casters_;
};

}  // namespace penumbra::detail
