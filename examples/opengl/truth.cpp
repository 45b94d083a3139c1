#include "truth.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

namespace penumbra::opengl {

void Truth::set_casters(const scenes::Scene& scene) {
    stop();
    casters_ = std::make_unique<reference::Scene>(scene.casters);
}

void Truth::start(const scenes::Light& light, std::vector<Vec3<float>> points) {
    stop();
    sums_.assign(points.size(), 0.0);
    rays_ = 0;
    worker_ = std::thread([this, light, points = std::move(points)] { trace(light, points); });
}

void Truth::stop() {
    stopping_ = true;
    if (worker_.joinable()) worker_.join();
    stopping_ = false;
}

bool Truth::fetch(int& seen, std::vector<float>& visible) const {
    if (rays_ == seen || rays_ == 0) return false;
    const std::lock_guard lock(mutex_);
    seen = rays_;
    visible.resize(sums_.size());
    std::transform(sums_.begin(), sums_.end(), visible.begin(),
                   [&](double sum) { return static_cast<float>(sum / seen); });
    return true;
}

std::vector<float> Truth::wait_for(int rays) const {
    while (rays_ < std::min(rays, most_rays)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    int seen = 0;
    std::vector<float> visible;
    fetch(seen, visible);
    return visible;
}

void Truth::trace(const scenes::Light& light, const std::vector<Vec3<float>>& points) {
    constexpr std::size_t chunk = 4096;
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    std::vector<float> visible(points.size());
    reference::SampleOptions options;
    for (int rays = 4; rays_ < most_rays && !stopping_; ++options.seed) {
        options.samples = rays;
        std::atomic<std::size_t> next{0};
        const auto work = [&] {
            for (std::size_t at = next++ * chunk; at < points.size() && !stopping_; at = next++ * chunk)
                std::visit(
                    [&](const auto& shape) {
                        casters_->visibility(points.data() + at, std::min(chunk, points.size() - at), shape, options,
                                             visible.data() + at);
                    },
                    light);
        };
        std::vector<std::thread> others;
        for (std::size_t i = 1; i < cores; ++i) others.emplace_back(work);
        work();
        for (std::thread& thread : others) thread.join();
        if (stopping_) return;
        const std::lock_guard lock(mutex_);
        for (std::size_t i = 0; i < points.size(); ++i) sums_[i] += static_cast<double>(visible[i]) * rays;
        rays_ += rays;
        rays = rays_;  // as many again: each round halves the variance
    }
}

}  // namespace penumbra::opengl
