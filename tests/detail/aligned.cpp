#include <doctest/doctest.h>

#include <cstdint>
#include <penumbra/detail/aligned.hpp>
#include <vector>

using namespace penumbra;

TEST_CASE_TEMPLATE("arrays start at a cache line, large ones at a page", T, char, float, double) {
    std::vector<std::vector<T, detail::AlignedAllocator<T>>> all;
    for (std::size_t bytes = 8; bytes <= (1U << 20); bytes *= 2) {
        all.emplace_back(bytes / sizeof(T), T(1));
        const auto address = reinterpret_cast<std::uintptr_t>(all.back().data());
        CAPTURE(bytes);
        CHECK(address % (bytes < 65536 ? 64 : 4096) == 0);
    }
    const auto copy = all.back();
    CHECK(copy == all.back());
    CHECK(copy.data() != all.back().data());
    all.clear();
    CHECK(copy.front() == T(1));
}
