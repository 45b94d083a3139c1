// What can be chosen about umbra volumes.
#pragma once

#include <penumbra/detail/error.hpp>
#include <string>

namespace penumbra {

/// What decides how much of a disk light a point sees.
enum class DiskMode {
    edge_sum,  ///< the exact sum over all edges on the silhouette as the point sees it
    d_buffer   ///< one or two edges, looked up in a picture of umbra and penumbra volumes from the light's centre
};

/// How occlusions of several silhouettes become one, for sums over edges.
enum class DiskOverlap {
    additive,  ///< their sum, at most 1
    maximum,   ///< the largest
    product,   ///< as if each left its share of every part of the light
    bitmask,   ///< by masks of cells over the disk, which say how much is new
    exact      ///< the area of all together
};

/// V(t): what is visible behind a straight edge that leaves the share t of the diameter across it.
enum class CutVisibility {
    exact,
    cubic,       ///< the paper's 3t² − 2t³: off by up to 0.039
    square_root  ///< the paper's √t for small casters: off by up to 0.306
};

/// From where the D-buffer's t comes.
enum class CutShare {
    edge,   ///< from the edge itself: exact for that edge
    depths  ///< from the depths of edge and volume, the paper: exact for edges parallel to the light
};

/// What a D-buffer's depths are.
enum class DBufferDepth {
    light_plane,  ///< distances from the light's plane
    euclidean     ///< distances from the light's centre, the paper
};

/// Between which faces a volume's edges lie.
enum class VolumeSilhouette {
    disk,         ///< those that see all of the disk, and those that see none: right for any size of the light
    light_center  ///< those that its centre sees, for umbra and penumbra alike: what a point light would have
};

struct UmbraVolumeOptions {
    DiskMode mode = DiskMode::edge_sum;

    // sums over edges
    DiskOverlap overlap = DiskOverlap::exact;
    /// Cells along the light's diameter for DiskOverlap::bitmask, and for `exact` where a point sees more than 256 edges
    /// before the light: 8, 16 or 32.
    int bitmask_size = 32;
    /// `bitmask` and `exact`: overlaps are left out where they can change visibility by no more, 0 to 1; by masks half a
    /// cell in any case. plan() sets it.
    float tolerance = 0.0F;

    // D-buffers
    int resolution = 1024;  ///< texels along a side, 1 to 16384
    int layers = 2;         ///< edges a texel keeps on each side of a caster, 1 or 2: the paper, and its future work
    CutVisibility visibility = CutVisibility::exact;
    CutShare share = CutShare::edge;
    DBufferDepth depth = DBufferDepth::light_plane;
    VolumeSilhouette silhouette = VolumeSilhouette::disk;
};

/// Reports the first option out of its domain by name and value. True if there is none.
inline bool validate(const UmbraVolumeOptions& options) {
    const auto report = [](const char* name, int value, const char* domain) {
        return detail::require(false, [&] {
            return std::string("options.") + name + " = " + std::to_string(value) + " is not " + domain;
        });
    };
    if (options.bitmask_size != 8 && options.bitmask_size != 16 && options.bitmask_size != 32)
        return report("bitmask_size", options.bitmask_size, "8, 16 or 32");
    if (!(options.tolerance >= 0.0F && options.tolerance <= 1.0F))
        return detail::require(false, [&] {
            return "options.tolerance = " + detail::text(static_cast<double>(options.tolerance)) + " is not in [0, 1]";
        });
    if (options.resolution < 1 || options.resolution > 16384)
        return report("resolution", options.resolution, "from 1 to 16384");
    if (options.layers != 1 && options.layers != 2) return report("layers", options.layers, "1 or 2");
    return true;
}

}  // namespace penumbra
