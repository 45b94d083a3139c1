#include "timing.hpp"

#include <algorithm>

namespace penumbra::study {

void Timing::first() {
    constexpr std::size_t few = 256;
    constexpr double longest = 0.25;  // seconds
    if (points_ > few) {
        const auto start = Clock::now();
        run_(few);
        const double seconds = seconds_since(start) * static_cast<double>(points_) / few;
        if (seconds > longest)
            points_ = std::max(few, static_cast<std::size_t>(static_cast<double>(points_) * longest / seconds));
    }
    const auto start = Clock::now();
    run_(points_);
    first_seconds_ = seconds_since(start);
}

void Timing::again() {
    if (!is_long()) run_(points_);
    const int repeats = first_seconds_ < 2e-3 ? 2 : 1;
    const auto start = Clock::now();
    for (int i = 0; i < repeats; ++i) run_(points_);
    seconds_.push_back(seconds_since(start) / repeats);
}

int Timing::rounds(int most) const {
    if (first_seconds_ > 0.1) return 0;
    return is_long() ? std::min(most, 2) : most;
}

double Timing::ns_per_point() const {
    std::vector<double> seconds = seconds_;
    if (seconds.empty()) seconds.push_back(first_seconds_);
    const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
    std::nth_element(seconds.begin(), middle, seconds.end());
    return *middle * 1e9 / static_cast<double>(points_);
}

void take_turns(std::vector<Timing>& timings, int rounds, const std::function<void(int)>& progress) {
    for (int round = 0; round < rounds; ++round) {
        progress(round);
        for (Timing& timing : timings)
            if (round < timing.rounds(rounds)) timing.again();
    }
}

}  // namespace penumbra::study
