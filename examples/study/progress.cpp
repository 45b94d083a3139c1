#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

namespace penumbra::study {

void say(const std::string& scene, const std::string& what) {
    static const bool on_terminal = isatty(STDERR_FILENO) == 1;
    static std::string last_scene;
    if (on_terminal)
        std::fprintf(stderr, "\r\x1b[K%s: %s", scene.c_str(), what.c_str());
    else if (scene != last_scene)
        std::fprintf(stderr, "%s ...\n", scene.c_str());
    last_scene = scene;
    std::fflush(stderr);
}

void in_parallel(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
    constexpr std::size_t piece = 1024;
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
        for (std::size_t first; (first = next.fetch_add(piece)) < count;) work(first, std::min(piece, count - first));
    };
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(run);
    run();
    for (std::thread& thread : threads) thread.join();
}

}  // namespace penumbra::study
