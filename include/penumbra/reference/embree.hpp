// Ray-traced visibility: the truth that everything else is measured against, as fast as Embree gives it.
// The one header that needs Embree (3 or 4); it is not part of penumbra.hpp.
//
// Rays run from the point to samples of the light. A triangle whose plane holds the point hides no area of the light
// from it, so hits on triangles whose plane passes within a tolerance of the point do not count. That is right for
// points on casters at any angle of incidence, and for coplanar neighbours; the price is that a caster parallel to the
// surface and nearer than the tolerance is overlooked. The tolerance is
//     16 ε R + 4 ε_T W,   R = half the diagonal of the casters' bounds, W = their largest world coordinate,
// with ε = 2^-24 and ε_T that of the casters' type: 1e-6 R near the origin; .02 for float casters 1e5 from it, which
// is what is left of their own coordinates. Give points on casters as exactly as that: Hit::point is. Rays end at
// 1 − 2^-16 of their length, so that a surface that coincides with the light does not hide it.
//
// Cost, casters of 50,000 random triangles, one thread, ns a ray for a light that fills .07 / .35 / 1 rad:
//     rays a point        4                   64                  1024
//     single              347 / 327 / 383     260 / 303 / 359     200 / 275 / 342
//     packet16            283 / 327 / 366     202 / 284 / 346     110 / 216 / 304
//     coherent16          324 / 773 / 1238    111 / 366 / 905      60 / 119 / 293
// 1 to 3 ns of it make the rays.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <penumbra/mesh.hpp>
#include <penumbra/reference/sampling.hpp>
#include <string>
#include <vector>

namespace penumbra::reference {

/// How rays are handed to Embree, each way on the intersectors that are cheapest for it.
enum class Rays {
    single,     ///< one at a time; one ray in some millions slips between two triangles that share an edge
    packet16,   ///< sixteen to neighbouring samples, or to several points where there are fewer samples; likewise
    coherent16  ///< sixteen that stay together on their way; watertight; from 16 to 500 rays a point on the cheapest
};

struct SampleOptions {
    int samples = 4096;  ///< rays a point, ≥ 1
    Sampler sampler = Sampler::sobol;
    Rays rays = Rays::coherent16;
    std::uint32_t seed = 0;  ///< another seed, another independent estimate
};

/// What a ray meets first. World space.
template <class T>
struct Hit {
    T distance;            ///< in units of the ray's direction
    std::size_t mesh;      ///< index in the casters
    std::size_t triangle;  ///< index in the mesh
    Vec3<T> normal;        ///< of unit length, towards the side from which the triangle is counter-clockwise
    Vec3<T> point;         ///< from the triangle's corners, so closer to it than origin + distance · direction
};

namespace detail {

// Embree 4 renamed what the flags are passed in.
#if RTC_VERSION_MAJOR >= 4
struct Context {
    RTCOccludedArguments arguments;

    explicit Context(bool coherent) {
        rtcInitOccludedArguments(&arguments);
        if (coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    }
    void occluded(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray, &arguments); }
    void occluded(RTCScene scene, const int* valid, RTCRay16& rays) { rtcOccluded16(valid, scene, &rays, &arguments); }
    void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray); }
};
#else
struct Context {
    RTCIntersectContext arguments;

    explicit Context(bool coherent) {
        rtcInitIntersectContext(&arguments);
        if (coherent) arguments.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }
    void occluded(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &arguments, &ray); }
    void occluded(RTCScene scene, const int* valid, RTCRay16& rays) { rtcOccluded16(valid, scene, &arguments, &rays); }
    void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &arguments, &ray); }
};
#endif

/// The casters in Embree, in local coordinates: relative to the middle of their bounds and scaled by a power of two to
/// a size near 1. Scenes far from the origin, tiny or huge lose nothing beyond the rounding of their own coordinates.
struct Traceable {
    RTCDevice device = nullptr;
    RTCScene watertight = nullptr, fast = nullptr;  // the same geometries
    Vec3<double> center{0.0, 0.0, 0.0};
    double scale = 1.0;
    float tolerance = 0.0F;

    Traceable() = default;
    Traceable(const Traceable&) = delete;
    Traceable& operator=(const Traceable&) = delete;
    ~Traceable() {
        if (fast) rtcReleaseScene(fast);
        if (watertight) rtcReleaseScene(watertight);
        if (device) rtcReleaseDevice(device);
    }

    RTCScene scene(Rays rays) const { return rays == Rays::coherent16 ? watertight : fast; }
    template <class T>
    Vec3<float> to_local(const Vec3<T>& point) const {
        return Vec3<float>((Vec3<double>(point) - center) * scale);
    }
    template <class T>
    Vec3<float> direction_to_local(const Vec3<T>& direction) const {
        return Vec3<float>(Vec3<double>(direction) * scale);
    }

    template <class T>
    void build(const std::vector<Mesh<T>>& casters) {
        Box3<T> box = empty_box<T>();
        for (const Mesh<T>& mesh : casters) {
            const Box3<T> part = bounds(mesh);
            if (!is_empty(part)) box = extend(extend(box, part.min), part.max);
        }
        if (is_empty(box)) return;
        const Vec3<double> low(box.min), high(box.max), far = glm::max(-low, high);
        const double radius = 0.5 * glm::length(high - low), largest = std::max({far.x, far.y, far.z});
        const double epsilon = 0.5 * static_cast<double>(std::numeric_limits<T>::epsilon());
        center = 0.5 * (low + high);
        scale = radius > 0.0 ? exp2_int<double>(-floor_log2(radius)) : 1.0;
        tolerance = static_cast<float>(scale * (radius * 0x1p-20 + 4.0 * epsilon * largest));

        device = rtcNewDevice(nullptr);
        if (!penumbra::detail::require(device, [] { return std::string("Embree gives no device"); })) return;
        watertight = rtcNewScene(device);
        fast = rtcNewScene(device);
        rtcSetSceneFlags(watertight, RTC_SCENE_FLAG_ROBUST);
        for (std::size_t i = 0; i < casters.size(); ++i)
            if (!casters[i].triangles.empty()) attach(casters[i], static_cast<unsigned>(i));
        for (const RTCScene scene : {watertight, fast}) {
            rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
            rtcCommitScene(scene);
        }
    }

    template <class T>
    void attach(const Mesh<T>& mesh, unsigned id) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* position = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
        for (const Vec3<T>& world : mesh.positions) {
            const Vec3<float> p = to_local(world);
            for (int k = 0; k < 3; ++k) *position++ = p[k];
        }
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
        for (const glm::uvec3& triangle : mesh.triangles)
            for (int k = 0; k < 3; ++k) *index++ = triangle[k];
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryOccludedFilterFunction(geometry, ignore_own_plane);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        rtcCommitGeometry(geometry);
        for (const RTCScene scene : {watertight, fast}) rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }

    /// Refuses hits on triangles whose plane passes within the tolerance of the ray's origin.
    static void ignore_own_plane(const RTCFilterFunctionNArguments* args) {
        const float tolerance = static_cast<const Traceable*>(args->geometryUserPtr)->tolerance;
        const unsigned n = args->N;
        for (unsigned i = 0; i < n; ++i) {
            const Vec3<float> normal(RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i),
                                     RTCHitN_Ng_z(args->hit, n, i));
            const Vec3<float> direction(RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i),
                                        RTCRayN_dir_z(args->ray, n, i));
            const float height = glm::dot(normal, direction) * RTCRayN_tfar(args->ray, n, i);
            if (std::abs(height) <= tolerance * std::sqrt(glm::dot(normal, normal))) args->valid[i] = 0;
        }
    }
};

/// Turns points into rays to the light, traces them, and counts what gets through.
template <class T>
class Tracer {
  public:
    Tracer(const Traceable& casters, const Emitter<T>& emitter, const SampleSet& samples, Rays rays)
        : casters_(casters), samples_(samples), mode_(rays), context_(rays == Rays::coherent16) {
        round_ = emitter.round;
        origin_ = casters.to_local(emitter.frame.origin);
        u_ = casters.direction_to_local(emitter.u);
        v_ = casters.direction_to_local(emitter.v);
        lanes_ = std::min(samples.size(), width);
        group_ = rays == Rays::single ? 1 : width / lanes_;
        std::fill(rays_.mask, rays_.mask + width, 0xffffffffU);
    }

    /// Sets *result to the visibility of the point, at the latest in flush().
    void add(const Vec3<T>& point, const Scramble& scramble, T* result) {
        waiting_[count_++] = {casters_.to_local(point), scramble, result, 0};
        if (count_ == group_) flush();
    }

    void flush() {
        for (std::size_t first = 0; first < samples_.size() && count_ > 0; first += lanes_) {
            const std::size_t n = std::min(lanes_, samples_.size() - first);
            for (std::size_t k = 0; k < count_; ++k) fill(waiting_[k], first, n, k * n);
            trace(count_ * n);
            for (std::size_t k = 0; k < count_; ++k)
                for (std::size_t i = k * n; i < (k + 1) * n; ++i) waiting_[k].hits += rays_.tfar[i] < 0.0F;
        }
        const T size = static_cast<T>(samples_.size());
        for (std::size_t k = 0; k < count_; ++k) *waiting_[k].result = (size - static_cast<T>(waiting_[k].hits)) / size;
        count_ = 0;
    }

  private:
    static constexpr std::size_t width = 16;

    struct Waiting {
        Vec3<float> point;
        Scramble scramble;
        T* result;
        int hits;
    };

    void fill(const Waiting& waiting, std::size_t first, std::size_t n, std::size_t at) {
        float a[width], b[width];
        samples_.write(first, n, waiting.scramble, a, b);
        for (std::size_t i = 0; i < n; ++i) a[i] = a[i] * 2.0F - 1.0F, b[i] = b[i] * 2.0F - 1.0F;
        if (round_)
            for (std::size_t i = 0; i < n; ++i) to_disk(a[i], b[i]);
        const Vec3<float> p = waiting.point, to_light = origin_ - p;
        for (std::size_t i = 0; i < n; ++i) {
            rays_.org_x[at + i] = p.x, rays_.org_y[at + i] = p.y, rays_.org_z[at + i] = p.z;
            rays_.dir_x[at + i] = to_light.x + a[i] * u_.x + b[i] * v_.x;
            rays_.dir_y[at + i] = to_light.y + a[i] * u_.y + b[i] * v_.y;
            rays_.dir_z[at + i] = to_light.z + a[i] * u_.z + b[i] * v_.z;
            rays_.tfar[at + i] = 1.0F - 1.0F / 65536.0F;
        }
    }

    /// Sets tfar of the first n rays below 0 where they hit a caster.
    void trace(std::size_t n) {
        if (mode_ != Rays::single) {
            alignas(64) int valid[width];
            for (std::size_t i = 0; i < width; ++i) valid[i] = i < n ? -1 : 0;
            context_.occluded(casters_.scene(mode_), valid, rays_);
            return;
        }
        RTCRay ray{};
        ray.mask = 0xffffffffU;
        for (std::size_t i = 0; i < n; ++i) {
            ray.org_x = rays_.org_x[i], ray.org_y = rays_.org_y[i], ray.org_z = rays_.org_z[i];
            ray.dir_x = rays_.dir_x[i], ray.dir_y = rays_.dir_y[i], ray.dir_z = rays_.dir_z[i];
            ray.tfar = rays_.tfar[i];
            context_.occluded(casters_.scene(mode_), ray);
            rays_.tfar[i] = ray.tfar;
        }
    }

    const Traceable& casters_;
    const SampleSet& samples_;
    Rays mode_;
    Context context_;
    bool round_;                  // a disk
    Vec3<float> origin_, u_, v_;  // of the light, local
    std::size_t lanes_, group_;   // rays a point and points at a time in one packet
    Waiting waiting_[width];
    std::size_t count_ = 0;  // of waiting points
    RTCRay16 rays_{};
};

}  // namespace detail

/// Casters, ready to be traced. Movable, not copyable. Queries are const and may run from any number of threads; each
/// runs on the thread that asks.
class Scene {
  public:
    /// Reports bad meshes by name. Empty meshes are allowed; without any triangle everything is visible.
    template <class T>
    explicit Scene(const std::vector<Mesh<T>>& casters) : casters_(std::make_unique<detail::Traceable>()) {
        if (validate(casters)) casters_->build(casters);
    }

    /// Fraction of the light's area (of a linear light's length) that each of `count` points sees, in [0, 1]: exactly
    /// 1 where no ray hits and exactly 0 where all do. Points and light in world space. 1 for points on or behind the
    /// plane of a rectangle or disk, and for points that are not finite. A light without size casts hard shadows; a
    /// rectangle without size emits towards the casters' middle. Reports bad lights and options by name. The result
    /// depends on the point, the light and the options, not on the other points. Standard error: see noise().
    template <class T, template <class> class Light>
    void visibility(const Vec3<T>* points, std::size_t count, const Light<T>& light, const SampleOptions& options,
                    T* result) const {
        std::fill(result, result + count, T(1));
        const bool good = penumbra::detail::require(options.samples >= 1, [&] {
            return "options.samples = " + std::to_string(options.samples) + " is not at least 1";
        });
        if (!good || !validate(light) || !casters_->device) return;
        const Emitter<T> emitter = reference::emitter(light, Vec3<T>(casters_->center));
        const SampleSet samples = sample_set(emitter, options.sampler, options.samples);
        detail::Tracer<T> tracer(*casters_, emitter, samples, options.rays);
        for (std::size_t i = 0; i < count; ++i) {
            if (!is_finite(points[i])) continue;
            if (emitter.one_sided && !(emitter.frame.to_light(points[i]).z > T(0))) continue;
            tracer.add(points[i], scramble(points[i], options.seed), result + i);
        }
        tracer.flush();
    }

    /// The same for one point. Batches are faster: they prepare the samples once.
    template <class T, template <class> class Light>
    T visibility(const Vec3<T>& point, const Light<T>& light, const SampleOptions& options = {}) const {
        T result;
        visibility(&point, 1, light, options, &result);
        return result;
    }

    /// Standard error of visibility() with these options, as the root of its mean square over the points; from
    /// `repeats` ≥ 2 independent scramblings, with the seeds that follow options.seed.
    template <class T, template <class> class Light>
    double noise(const Vec3<T>* points, std::size_t count, const Light<T>& light, SampleOptions options = {},
                 int repeats = 4) const {
        std::vector<T> visible(count);
        std::vector<double> mean(count, 0.0);
        double squares = 0.0;
        for (int k = 1; k <= repeats; ++k) {
            ++options.seed;
            visibility(points, count, light, options, visible.data());
            for (std::size_t i = 0; i < count; ++i) {
                const double from_mean = static_cast<double>(visible[i]) - mean[i];
                mean[i] += from_mean / k;
                squares += from_mean * (static_cast<double>(visible[i]) - mean[i]);
            }
        }
        return std::sqrt(squares / std::max(static_cast<double>(count) * (repeats - 1), 1.0));
    }

    /// What the ray from `origin` along `direction` (world space, any length) meets first, from either side.
    template <class T>
    std::optional<Hit<T>> closest_hit(const Vec3<T>& origin, const Vec3<T>& direction) const {
        if (!casters_->device || !is_finite(origin) || !is_finite(direction)) return std::nullopt;
        const Vec3<float> from = casters_->to_local(origin), along = casters_->direction_to_local(direction);
        RTCRayHit ray{};
        ray.ray.org_x = from.x, ray.ray.org_y = from.y, ray.ray.org_z = from.z;
        ray.ray.dir_x = along.x, ray.ray.dir_y = along.y, ray.ray.dir_z = along.z;
        ray.ray.tfar = std::numeric_limits<float>::max();
        ray.ray.mask = 0xffffffffU;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        detail::Context(false).intersect(casters_->watertight, ray);
        const RTCHit& hit = ray.hit;
        if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        float p[3];
        rtcInterpolate0(rtcGetGeometry(casters_->watertight, hit.geomID), hit.primID, hit.u, hit.v,
                        RTC_BUFFER_TYPE_VERTEX, 0, p, 3);
        const Vec3<double> point = casters_->center + Vec3<double>(p[0], p[1], p[2]) / casters_->scale;
        const Vec3<T> normal(Vec3<float>(hit.Ng_x, hit.Ng_y, hit.Ng_z));
        return Hit<T>{static_cast<T>(ray.ray.tfar), hit.geomID, hit.primID, normalize_or(normal, -direction),
                      Vec3<T>(point)};
    }

  private:
    std::unique_ptr<detail::Traceable> casters_;
};

}  // namespace penumbra::reference
