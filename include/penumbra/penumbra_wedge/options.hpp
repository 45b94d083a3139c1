// The knobs of penumbra-wedge shadows, and what they trade.
#pragma once

#include <penumbra/detail/error.hpp>
#include <penumbra/penumbra_wedge/silhouette.hpp>
#include <string>

namespace penumbra {

/// How what several silhouettes block of the light combines, one silhouette a mesh but for the last two.
enum class OverlapRule {
    additive,             ///< plain wedges: right where silhouettes do not overlap, too dark elsewhere
    maximum,              ///< right where one hides behind the other
    product,              ///< overlaps are as random, over the whole light
    product_quadrants,    ///< the same in each quarter of the light
    rectangles,           ///< overlap by bounding rectangles in each quarter: the paper
    rectangles_centroid,  ///< the same with centres of gravity: the paper's future work
    rectangle_product,    ///< rectangles as random, in any order of silhouettes
    bitmask,              ///< where silhouettes lie, cell by cell, beside their exact areas
    exact                 ///< the area of all together
};

struct PenumbraWedgeOptions {
    OverlapRule overlap = OverlapRule::exact;
    /// Cells along each side of the light for OverlapRule::bitmask, and for `exact` where a point sees more than 256
    /// edges before the light: 8, 16 or 32.
    int bitmask_size = 32;
    SilhouetteFrom silhouette = SilhouetteFrom::point;
    /// `bitmask` and `exact`: overlaps are left out where they can change visibility by no more, 0 to 1; by masks half
    /// a cell in any case. plan() sets it.
    float tolerance = 0.0F;
};

/// Reports an option out of its range by name and value. True if there is none.
inline bool validate(const PenumbraWedgeOptions& options) {
    const int size = options.bitmask_size;
    return detail::require(size == 8 || size == 16 || size == 32,
                           [&] { return "options.bitmask_size = " + std::to_string(size) + " is not 8, 16 or 32"; }) &&
           detail::require(options.tolerance >= 0.0F && options.tolerance <= 1.0F, [&] {
               return "options.tolerance = " + detail::text(static_cast<double>(options.tolerance)) +
                      " is not in [0, 1]";
           });
}

}  // namespace penumbra
