// Visibility channels: for each texel of a map, how much of the light towards the next map its surface sees, by the
// skins of that map's discontinuities.
//
// Where no skin is, 1: a point sees min(1, the sum of both maps' channels) of the light between them, and a map that
// does not see the point adds nothing. Skins cover what lies strictly behind them, one texel more at both ends, and the
// least counts where they overlap. Channels of ½ in place of 1, as the paper has them, leave seams of one texel.
#pragma once

#include <algorithm>
#include <cmath>
#include <penumbra/image.hpp>
#include <penumbra/soft_shadow_map/discontinuity.hpp>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>
#include <penumbra/soft_shadow_map/options.hpp>
#include <penumbra/soft_shadow_map/skin.hpp>

namespace penumbra {

/// How the light between two maps is seen: of one of them, towards the other.
template <class T>
struct VisibilityChannel {
    Image<T> visible;          ///< what a texel's surface sees, in [0, 1]
    Image<RowPoint<T>> edges;  ///< what hides the rest, where visible < 1: only for SkinTransition::exact
};

namespace detail {

/// Draws the skins of `source` into the channel of `target` that looks towards it.
template <class T>
class SkinPainter {
  public:
    SkinPainter(const LightMapView<T>& view, const LightMap<T>& source, const LightMap<T>& target,
                SkinTransition transition, StepDetector detector, T step)
        : view_(view), source_(source), target_(target), transition_(transition), detector_(detector), step_(step) {}

    VisibilityChannel<T> paint() {
        const int size = view_.resolution;
        channel_.visible = Image<T>(size, size, T(1));
        if (transition_ == SkinTransition::exact) channel_.edges = Image<RowPoint<T>>(size, size);
        if (source_.position == target_.position) return channel_;
        const bool onward = source_.position < target_.position;  // casters' sides that the target sees past
        for (int y = 0; y < size; ++y)
            for (int x = 0; x + 1 < size; ++x) {
                const int near = onward ? x : x + 1, far = onward ? x + 1 : x;
                const T edge_depth = source_.caster(near, y), far_depth = source_.surface(far, y);
                if (!(edge_depth < LightMap<T>::none) || !(edge_depth < far_depth)) continue;
                if (source_.surface(near, y) < edge_depth || !steps(x, y)) continue;
                const T slope = view_.column_slope(static_cast<T>(x + 1));
                const Skin<T> skin = warp_skin(slope, LightMap<T>::inverse(edge_depth), LightMap<T>::inverse(far_depth),
                                               source_.position, target_.position);
                draw(skin, y, receiver_under(skin, far, far + (far - near), y));
            }
        return channel_;
    }

  private:
    /// Is there a step between columns x and x + 1?
    bool steps(int x, int y) const {
        if (detector_ == StepDetector::slope_aware) {
            const auto depth = [&](int i) {
                return i >= 0 && i < view_.resolution ? source_.surface(i, y) : LightMap<T>::none;
            };
            return is_step(Vec3<T>(depth(x), depth(x - 1), depth(x - 2)),
                           Vec3<T>(depth(x + 1), depth(x + 2), depth(x + 3)), step_, LightMap<T>::none);
        }
        return is_laplacian_step(laplacian(x, y), laplacian(x + 1, y), step_);
    }
    T laplacian(int x, int y) const {
        const int last = view_.resolution - 1;
        glm::mat<3, 3, T, glm::defaultp> depths;
        T farthest = T(0);  // nothing counts as what is at twice the farthest depth around
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                depths[i][j] = source_.surface(clamp(x + i - 1, 0, last), clamp(y + j - 1, 0, last));
                if (depths[i][j] < LightMap<T>::none) farthest = std::max(farthest, depths[i][j]);
            }
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (!(depths[i][j] < LightMap<T>::none)) depths[i][j] = T(2) * farthest;
        return laplacian_of_gaussian(depths);
    }

    /// Under the skin's edge, of a receiver that goes on as it is seen behind it.
    T receiver_under(const Skin<T>& skin, int far, int beyond, int y) const {
        const auto at = [&](int x) {
            const T inverse = LightMap<T>::inverse(source_.surface(x, y));
            const T slope = view_.column_slope(static_cast<T>(x) + T(0.5));
            return RowPoint<T>{slope + source_.position * inverse, inverse};
        };
        if (beyond < 0 || beyond >= view_.resolution || steps(std::min(far, beyond), y)) return skin.far.inverse_depth;
        return receiver_under_edge(skin, at(far), at(beyond), target_.position);
    }

    void draw(const Skin<T>& skin, int y, T receiver_at_edge) {
        const T size = static_cast<T>(view_.resolution);
        const T at_edge = view_.column(skin.edge.slope), at_far = view_.column(skin.far.slope);
        const int first = static_cast<int>(clamp(std::floor(std::min(at_edge, at_far)) - T(1), T(0), size));
        const int end = static_cast<int>(clamp(std::floor(std::max(at_edge, at_far)) + T(2), T(0), size));
        const T edge_depth = T(1) / skin.edge.inverse_depth;
        for (int x = first; x < end; ++x) {
            const T surface = target_.surface(x, y);
            const T share = skin_share(skin, view_.column_slope(static_cast<T>(x) + T(0.5)));
            const T inverse = LightMap<T>::inverse(surface);
            if (!(surface > edge_depth + step_) || !(inverse < skin_inverse_depth(skin, share))) continue;
            const T visible = visibility(skin, share, inverse, receiver_at_edge);
            if (!(visible < channel_.visible(x, y))) continue;
            channel_.visible(x, y) = visible;
            if (transition_ == SkinTransition::exact) {
                const T at = skin.edge.slope + target_.position * skin.edge.inverse_depth;
                channel_.edges(x, y) = {at, skin.edge.inverse_depth};
            }
        }
    }
    T visibility(const Skin<T>& skin, T share, T receiver, T receiver_at_edge) const {
        const T edge = skin.edge.inverse_depth, far = skin.far.inverse_depth;
        if (transition_ == SkinTransition::linear) return skin_visibility(share);
        if (transition_ == SkinTransition::rational)
            return skin_visibility(share, edge, far, mix(receiver_at_edge, far, share));
        return skin_visibility(share, edge, far, receiver);
    }

    const LightMapView<T>& view_;
    const LightMap<T>&source_, &target_;
    SkinTransition transition_;
    StepDetector detector_;
    T step_;
    VisibilityChannel<T> channel_;
};

}  // namespace detail

/// The channel of `target` towards `source`, which look from two positions on a light with nothing but skins between.
template <class T>
VisibilityChannel<T> visibility_channel(const LightMapView<T>& view, const LightMap<T>& source,
                                        const LightMap<T>& target, SkinTransition transition, StepDetector detector,
                                        T step) {
    return detail::SkinPainter<T>(view, source, target, transition, detector, step).paint();
}

}  // namespace penumbra
