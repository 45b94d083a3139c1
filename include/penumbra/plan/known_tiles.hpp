// A batch of points, of which neighbours are not asked where it is known what all of them see.
//
// For methods by images: what they answer changes from texel to texel, but large parts of a picture lie before
// everything that hides the light, and some behind. Source: ours.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/detail/variation.hpp>
#include <penumbra/light.hpp>
#include <penumbra/plan/tile_box.hpp>
#include <penumbra/plan/tile_query.hpp>

namespace penumbra::detail {

/// `Shadow` has visibility(points, count, result); `Known`, a callable, has the Variation of a box in light space: lit,
/// no change at all, or unknown.
template <class T, class Shadow, class Known>
class KnownTiles {
  public:
    KnownTiles(const Shadow& shadow, const Known& known, const LightFrame<T>& frame)
        : shadow_(shadow), known_(known), frame_(frame) {}

    /// `answers`, if any, is told how each point came by its answer.
    void operator()(const Vec3<T>* points, std::size_t count, T* result, PointAnswer* answers) const {
        const auto ask = [&](std::size_t first, std::size_t end) {
            if (first == end) return;
            shadow_.visibility(points + first, end - first, result + first);
            if (answers) std::fill(answers + first, answers + end, PointAnswer::own);
        };
        std::size_t asked = 0, unknown = 0;  // up to where all are answered; how many tiles in a row were not known
        for (std::size_t first = 0; first < count;) {
            const std::size_t n = std::min(tile, count - first);
            const Box3<T> box = box_of(points + first, n);
            const bool is_place = is_finite(box.min) && is_finite(box.max);
            const Variation<T> variation = is_place ? known_(seen_from(frame_, box)) : Variation<T>::unknown();
            if (!variation.known) {
                first += n + tile * std::min(++unknown / patience, most_passed);
                continue;
            }
            unknown = 0;
            ask(asked, first);
            asked = first + n;
            T all = T(1);
            if (!variation.lit) shadow_.visibility(points + first, 1, &all);
            std::fill_n(result + first, n, all);
            if (answers) std::fill_n(answers + first, n, variation.lit ? PointAnswer::lit : PointAnswer::shared);
            if (answers && !variation.lit) answers[first] = PointAnswer::own;
            first = asked;
        }
        ask(asked, count);
    }

  private:
    static constexpr std::size_t tile = 64;
    static constexpr std::size_t patience = 4, most_passed = 7;  ///< tiles, before the next is tested

    const Shadow& shadow_;
    const Known& known_;
    const LightFrame<T>& frame_;
};

}  // namespace penumbra::detail
