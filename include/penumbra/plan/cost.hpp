// What effects cost on this machine, and plans for a time in place of a tolerance.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <penumbra/plan/planner.hpp>
#include <vector>

namespace penumbra {

/// Nanoseconds a point, on one thread, of one method: with all its effects, and with all but one, on a scene of nine
/// boxes. An effect that the method does not have costs nothing.
struct MethodCost {
    double full = 0.0;
    std::array<double, effect_count> without{};
    double per_edge = 0.0;  ///< and for each silhouette edge in view of a point more than there: see edges_in_view()

    /// What is left of the time if an effect is left out, in (0, 1].
    double share_without(Effect effect) const {
        const double ns = without[static_cast<std::size_t>(effect)];
        return full > 0.0 && ns > 0.0 ? std::min(ns / full, 1.0) : 1.0;
    }
};

/// Of each method, and of its other mode where it has one.
struct CostTable {
    MethodCost penumbra_wedge, edge_sum, d_buffer, intervals, skins, occlusion_texture;
    double edges = 0.0;  ///< silhouette edges in view on the scene that was measured
};

inline const MethodCost& cost_of(const CostTable& costs, const PenumbraWedgeOptions&) { return costs.penumbra_wedge; }
inline const MethodCost& cost_of(const CostTable& costs, const OcclusionTextureOptions&) {
    return costs.occlusion_texture;
}
inline const MethodCost& cost_of(const CostTable& costs, const UmbraVolumeOptions& options) {
    return options.mode == DiskMode::edge_sum ? costs.edge_sum : costs.d_buffer;
}
inline const MethodCost& cost_of(const CostTable& costs, const SoftShadowMapOptions& options) {
    const bool by_maps = options.mode == LinearMode::skins || options.mode == LinearMode::hard;
    return by_maps ? costs.skins : costs.intervals;
}

namespace detail {

/// Nine boxes over a ground, each side of `cuts` × `cuts` quads, rounded to spheres if there is more than one; in and
/// around whose shadows points lie row by row.
template <class T>
struct CostScene {
    std::vector<Mesh<T>> casters, ground;
    std::vector<Vec3<T>> points;

    explicit CostScene(int cuts = 1) {
        ground.push_back({{Vec3<T>(T(-2), T(0), T(-2)), Vec3<T>(T(-2), T(0), T(2)), Vec3<T>(T(2), T(0), T(2)),
                           Vec3<T>(T(2), T(0), T(-2))},
                          {{0, 1, 2}, {0, 2, 3}}});
        for (int i = 0; i < 9; ++i) {
            const Vec3<T> center(static_cast<T>(i % 3) - T(1), T(1), static_cast<T>(i / 3) - T(1));
            Mesh<T> mesh;
            for (int side = 0; side < 6; ++side) add_side(mesh, center, side, cuts);
            casters.push_back(weld(mesh));
        }
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                points.emplace_back(static_cast<T>(x) * T(0.125) - T(2), T(0), static_cast<T>(y) * T(0.125) - T(2));
    }

  private:
    static void add_side(Mesh<T>& mesh, const Vec3<T>& center, int side, int cuts) {
        const int axis = side / 2;
        const T sign = side % 2 ? T(1) : T(-1);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size()),
                   row = static_cast<std::uint32_t>(cuts + 1);
        for (int i = 0; i <= cuts; ++i)
            for (int j = 0; j <= cuts; ++j) {
                Vec3<T> at;
                at[axis] = sign;
                at[(axis + 1) % 3] = sign * (T(2) * static_cast<T>(i) / static_cast<T>(cuts) - T(1));
                at[(axis + 2) % 3] = T(2) * static_cast<T>(j) / static_cast<T>(cuts) - T(1);
                mesh.positions.push_back(center + at * (cuts > 1 ? T(0.4) / std::sqrt(glm::dot(at, at)) : T(0.3)));
            }
        for (std::uint32_t i = first; i < first + row * (row - 1); i += row)
            for (std::uint32_t k = i; k + 1 < i + row; ++k) {
                mesh.triangles.emplace_back(k, k + row, k + row + 1);
                mesh.triangles.emplace_back(k, k + row + 1, k + 1);
            }
    }
};

/// How many silhouette edges a point on the receivers has in view, as a mean: a mesh of n triangles has some 3 √n, and
/// is in view within its wedges.
template <class T>
double edges_in_view(const SceneExtents<T>& extents, const std::vector<Mesh<T>>& casters) {
    double edges = 0.0, all = 0.0;
    for (const Box3<T>& r : extents.receivers) {
        const auto area_of = [](const Box3<T>& b) {
            return static_cast<double>(b.max.x - b.min.x) * static_cast<double>(b.max.y - b.min.y);
        };
        const double area = area_of(r);
        if (!(area > 0.0)) continue;
        all += area;
        for (std::size_t i = 0; i < extents.casters.size(); ++i) {
            const Box3<T> shadow = shadow_box(extents.casters[i], r, extents.light.half_size);
            if (is_empty(shadow)) continue;
            edges += area_of(shadow) * 3.0 * std::sqrt(static_cast<double>(casters[i].triangles.size()));
        }
    }
    return all > 0.0 ? edges / all : 0.0;
}

/// The best of three, each of several batches.
template <class Shadow>
double time_of(const Shadow& shadow, const std::vector<Vec3<typename Shadow::Real>>& points) {
    using Clock = std::chrono::steady_clock;
    std::vector<typename Shadow::Real> result(points.size());
    double best = 1e30;
    for (int round = 0; round < 3; ++round) {
        const auto start = Clock::now();
        std::size_t batches = 0;
        double ns = 0.0;
        while (ns < 1e6 && batches < 64) {
            shadow.visibility(points.data(), points.size(), result.data());
            ++batches;
            ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
        }
        best = std::min(best, ns / static_cast<double>(batches * points.size()));
    }
    return best;
}

template <class Shadow>
MethodCost measure_cost(const CostScene<typename Shadow::Real>& scene, const typename Shadow::Light& light,
                        const typename Shadow::Options& full, std::initializer_list<Effect> effects) {
    MethodCost cost;
    cost.full = time_of(Shadow(scene.casters, light, full), scene.points);
    for (const Effect effect : effects) {
        typename Shadow::Options options = full;
        leave_out(effect, options);
        cost.without[static_cast<std::size_t>(effect)] = time_of(Shadow(scene.casters, light, options), scene.points);
    }
    return cost;
}

}  // namespace detail

/// Measures all methods on nine boxes, and what more edges cost on nine spheres: half a second, once on a machine. The
/// machine should be idle; expect ±20 %.
template <class T>
CostTable measure_costs() {
    const detail::CostScene<T> scene;
    const Vec3<T> above(T(0), T(4), T(0)), along(T(0.5), T(0), T(0)), aside(T(0), T(0), T(0.5));
    const RectLight<T> rect{above, along, aside};
    const DiskLight<T> disk{above, Vec3<T>(T(0), T(-1), T(0)), T(0.5)};
    const LinearLight<T> line{above - along, above + along};
    UmbraVolumeOptions d_buffer;
    d_buffer.mode = DiskMode::d_buffer, d_buffer.resolution = 128;
    SoftShadowMapOptions intervals, skins;
    intervals.resolution = skins.resolution = 128;
    skins.mode = LinearMode::skins;
    OcclusionTextureOptions slices;
    slices.resolution = 256;
    CostTable costs;
    costs.penumbra_wedge =
        detail::measure_cost<PenumbraWedgeShadow<T>>(scene, rect, {}, {Effect::overlap, Effect::silhouettes_per_point});
    costs.edge_sum = detail::measure_cost<UmbraVolumeShadow<T>>(scene, disk, {}, {Effect::overlap});
    costs.d_buffer = detail::measure_cost<UmbraVolumeShadow<T>>(scene, disk, d_buffer,
                                                                {Effect::second_layer, Effect::volume_silhouette});
    costs.intervals = detail::measure_cost<SoftShadowMap<T>>(scene, line, intervals, {Effect::extra_samples});
    costs.skins =
        detail::measure_cost<SoftShadowMap<T>>(scene, line, skins, {Effect::extra_samples, Effect::exact_transition});
    costs.occlusion_texture = detail::measure_cost<OcclusionTextureShadow<T>>(
        scene, rect, slices, {Effect::leak_closing, Effect::self_shadow});
    const detail::CostScene<T> finer(6);
    const auto edges = [&](const detail::CostScene<T>& of) {
        return detail::edges_in_view(scene_extents(of.casters, rect, of.ground, false), of.casters);
    };
    const double more = edges(finer) - edges(scene);
    const double wedges = detail::time_of(PenumbraWedgeShadow<T>(finer.casters, rect), finer.points);
    const double sums = detail::time_of(UmbraVolumeShadow<T>(finer.casters, disk), finer.points);
    costs.edges = edges(scene);
    costs.penumbra_wedge.per_edge = std::max(wedges - costs.penumbra_wedge.full, 0.0) / more;
    costs.edge_sum.per_edge = std::max(sums - costs.edge_sum.full, 0.0) / more;
    return costs;
}

/// A guess at what a query with all effects costs on a scene, nanoseconds a point on one thread, from silhouettes in
/// view: up to ten times off where casters hide each other. Whoever can should measure it instead.
template <class T, class Options>
double predicted_full_ns(const SceneExtents<T>& extents, const std::vector<Mesh<T>>& casters, const Options& options,
                         const CostTable& costs) {
    const MethodCost& cost = cost_of(costs, options);
    const double edges = detail::edges_in_view(extents, casters), more = edges - costs.edges;
    if (more > 0.0) return cost.full + cost.per_edge * more;
    return cost.per_edge > 0.0 ? cost.full * (0.3 + 0.7 * edges / costs.edges) : cost.full;
}

/// What a query as planned may cost, nanoseconds a point on one thread, if one with all effects costs `full_ns`. The
/// shares of time that effects leave multiply; tiles, which pay by what a batch looks like, are not counted.
template <class Shadow>
double predicted_ns(const Plan<Shadow>& plan, const CostTable& costs, double full_ns) {
    if (plan.casters.empty()) return 0.0;
    double ns = full_ns;
    for (const auto& decision : plan.decisions)
        if (!decision.simulated) ns *= cost_of(costs, plan.options).share_without(decision.effect);
    return ns;
}

/// A plan for at most `most_ns` nanoseconds a point, as predicted, in place of a tolerance: leaves out what loses
/// nothing, then effects by what they lose for the time that they save, until it is fast enough or nothing is left that
/// saves time. Casters and penumbrae stay unless that loses nothing; plan.bound says what is lost. `full_ns` is what a
/// query with all effects costs on the scene, as its owner measured it; 0: what it costs on that of measure_costs().
template <class Shadow>
Plan<Shadow> plan_for_time(const std::vector<Mesh<typename Shadow::Real>>& casters, const typename Shadow::Light& light,
                           const std::vector<Mesh<typename Shadow::Real>>& receivers, double most_ns,
                           const CostTable& costs, double full_ns = 0.0, const PlanSettings<Shadow>& settings = {}) {
    using T = typename Shadow::Real;
    if (!validate(settings.full) || !validate(light)) return {};
    const MethodCost& cost = cost_of(costs, settings.full);
    double ns = full_ns > 0.0 ? full_ns : cost.full;
    const auto select_effects = [&](const std::vector<detail::Candidate<T>*>& candidates) {
        std::vector<detail::Candidate<T>*> order;
        T lost = T(0);
        for (detail::Candidate<T>* const candidate : candidates) {
            candidate->out = !(candidate->loss > T(0));
            const double share = cost.share_without(candidate->effect);
            if (candidate->out)
                ns *= share;
            else if (share < 1.0 && candidate->effect != Effect::penumbra)
                order.push_back(candidate);
        }
        const auto price = [&](const detail::Candidate<T>& candidate) {
            return static_cast<double>(candidate.loss) / -std::log(cost.share_without(candidate.effect));
        };
        std::stable_sort(order.begin(), order.end(),
                         [&](const auto* a, const auto* b) { return price(*a) < price(*b); });
        for (detail::Candidate<T>* const candidate : order) {
            if (ns <= most_ns) break;
            candidate->out = true;
            lost += candidate->loss;
            ns *= cost.share_without(candidate->effect);
        }
        return lost;
    };
    const auto select_casters = [](const std::vector<detail::Candidate<T>*>& candidates) {
        for (detail::Candidate<T>* const candidate : candidates) candidate->out = !(candidate->loss > T(0));
        return T(0);
    };
    return detail::Planner<Shadow>(casters, light, receivers, T(0), settings).make(select_effects, select_casters);
}

}  // namespace penumbra
