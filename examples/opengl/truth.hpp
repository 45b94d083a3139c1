// The ray-traced truth beside a frame, refined in the background.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <penumbra/geometry.hpp>
#include <penumbra/reference/embree.hpp>
#include <thread>
#include <vector>

#include "../scenes/scene.hpp"

namespace penumbra::opengl {

/// Visibility at points, by more and more rays.
class Truth {
  public:
    static constexpr int most_rays = 4096;  ///< a point

    Truth() = default;
    ~Truth() { stop(); }
    Truth(const Truth&) = delete;
    Truth& operator=(const Truth&) = delete;

    /// What was being traced is given up. Other casters only: the light and the points come with start().
    void set_casters(const scenes::Scene& scene);
    /// Begins anew, at points in world space.
    void start(const scenes::Light& light, std::vector<Vec3<float>> points);
    void stop();

    /// Rays a point so far; 0 at first.
    int rays() const { return rays_; }
    /// True, and the means so far, if there are more rays in them than `seen`, which is set to how many.
    bool fetch(int& seen, std::vector<float>& visible) const;
    /// Traces until there are `rays` a point, at most `most_rays`.
    std::vector<float> wait_for(int rays) const;

  private:
    void trace(const scenes::Light& light, const std::vector<Vec3<float>>& points);

    std::unique_ptr<reference::Scene> casters_;
    std::thread worker_;
    std::atomic<bool> stopping_{false};
    std::atomic<int> rays_{0};
    mutable std::mutex mutex_;
    std::vector<double> sums_;  // of visibility times rays
};

}  // namespace penumbra::opengl
