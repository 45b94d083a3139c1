// The time that each of many things takes, measured in turn, so that all meet the machine's good and bad moments.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace penumbra::study {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A batch over the first so many of many points, at most `points` of them; fewer where each takes long.
class Timing {
  public:
    Timing(std::size_t points, std::function<void(std::size_t count)> run) : points_(points), run_(std::move(run)) {}

    /// Runs it once: the first time, which only counts if it is long.
    void first();
    /// Runs it with the clock; unless it is long, once unseen before, so that it finds its data in the caches that a
    /// picture in progress would leave it; what is very short, several times.
    void again();
    /// How often `again` is worth its time: seldom for what is long, as that averages over itself.
    int rounds(int most) const;
    /// The median.
    double ns_per_point() const;

  private:
    bool is_long() const { return first_seconds_ > 0.02; }

    std::size_t points_;
    std::function<void(std::size_t)> run_;
    double first_seconds_ = 0.0;
    std::vector<double> seconds_;
};

/// Times all, whose first run is done, in at most `rounds` rounds; `progress` is told the round.
void take_turns(std::vector<Timing>& timings, int rounds, const std::function<void(int round)>& progress);

}  // namespace penumbra::study
