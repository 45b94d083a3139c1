#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/detail/boxes.hpp>
#include <vector>

#include "../support/random.hpp"

using namespace penumbra;

TEST_CASE_TEMPLATE("widen keeps what is wide enough, and gives the rest a size about its middle", T, float, double) {
    test::Random random(1);
    int wrong = 0;
    for (int i = 0; i < 50000; ++i) {
        const T a = random.in(T(-3000), T(3000)), size = random.in(T(-0.1), T(0.2));
        T low = a, high = a + size;
        const T given = high - low;
        detail::widen(low, high, T(0.0625));
        if (given >= T(0.0625)) {
            wrong += low != a || high != a + size;
        } else {
            wrong += std::abs((low + high) / 2 - (a + size / 2)) > T(3000) * std::numeric_limits<T>::epsilon();
            wrong += std::abs(high - low - T(0.0625)) > T(6000) * std::numeric_limits<T>::epsilon();
        }
    }
    CHECK(wrong == 0);
    const T huge = T(1e30);
    for (const T at : {huge, -huge, T(1e9), T(65536)}) {
        T low = at, high = at;
        detail::widen(low, high, T(0.0625));
        CHECK(high - low >= T(0.03));  // a size even there
        CHECK(std::abs(low) < T(1.1e9));
    }
    T low = -huge, high = huge;
    detail::widen(low, high, T(0.0625));
    CHECK(low == T(-1e9));
    CHECK(high == T(1e9));
}

TEST_CASE_TEMPLATE("widen of any bits gives ends in order that int holds", T, float, double) {
    using Limits = std::numeric_limits<T>;
    std::vector<T> values{T(0), T(1), Limits::min(), T(65536), T(1e9), T(2e9), T(1e30), Limits::max()};
#ifndef __FAST_MATH__
    values.insert(values.end(), {Limits::denorm_min(), Limits::infinity()});
#endif
    for (std::size_t i = 0, n = values.size(); i < n; ++i) values.push_back(-values[i]);
#ifndef __FAST_MATH__
    values.push_back(Limits::quiet_NaN());
#endif
    for (const T a : values)
        for (const T b : values) {
            CAPTURE(a);
            CAPTURE(b);
            const Rect2<T> box = detail::widen(Rect2<T>{Vec2<T>(a, b), Vec2<T>(b, a)});
            CHECK(extent(box).x >= T(0.03));  // at 65536 a float's step is 1/128
            CHECK(extent(box).y >= T(0.03));
            for (const T end : {box.min.x, box.min.y, box.max.x, box.max.y}) CHECK(std::abs(end) < T(1.1e9));
        }
}

TEST_CASE_TEMPLATE("a grid divides each box evenly, cells at least of the smallest size", T, float, double) {
    test::Random random(2);
    for (int cells = 1; cells <= 8; ++cells) {
        detail::Boxes<T> boxes;
        while (boxes.count < boxes.capacity) {
            const T x = random.in(T(-9), T(500)), y = random.in(T(-9), T(500));
            const T w = boxes.count % 2 == 0 ? random.in(T(0), T(0.5)) : random.in(T(1), T(50));
            boxes.push({Vec2<T>(x, y), Vec2<T>(x + w, y + T(3))});
        }
        detail::BoxGrid<T> grid;
        grid.set(boxes, cells);
        CHECK(grid.count == boxes.capacity);
        int wrong = 0;
        for (std::size_t i = 0; i < grid.count; ++i) {
            const Rect2<T> whole = boxes[i];
            const T slack = T(2000) * std::numeric_limits<T>::epsilon();
            for (int row = 0; row < cells; ++row)
                for (int column = 0; column < cells; ++column) {
                    const Rect2<T> cell = grid.box(column, row, i);
                    const T width = std::max(extent(whole).x / static_cast<T>(cells), T(0.0625));
                    wrong += std::abs(extent(cell).x - width) > slack;
                    wrong += std::abs(extent(cell).y - T(3) / static_cast<T>(cells)) > slack;
                    const T from_middle = (static_cast<T>(column) + T(0.5) - static_cast<T>(cells) / 2) * width;
                    const T middle = (whole.min.x + whole.max.x) / 2 + from_middle;
                    wrong += std::abs((cell.min.x + cell.max.x) / 2 - middle) > slack;
                }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE_TEMPLATE("tiles cover a box up to 8 to 1, and are nearly square", T, float, double) {
    test::Random random(3);
    int wrong = 0, several = 0;
    for (int i = 0; i < 50000; ++i) {
        const T w = random.in(T(0.1), T(20)), h = random.in(T(0.1), T(20)), x = random.in(T(-9), T(99));
        const Rect2<T> box{Vec2<T>(x, T(5)), Vec2<T>(x + w, T(5) + h)};
        const detail::Tiles<T> tiles = detail::square_tiles(box);
        const T slack = T(200) * std::numeric_limits<T>::epsilon();
        const Vec2<T> last = tiles.first + tiles.step * static_cast<T>(tiles.count - 1);
        wrong += tiles.count < 1 || tiles.count > 8;
        several += tiles.count > 1;
        // their centres lie evenly about the box's
        const Vec2<T> off = (tiles.first + last - box.min - box.max) * T(0.5);
        wrong += std::abs(off.x) > slack || std::abs(off.y) > slack;
        const T aspect = std::max(w, h) / std::min(w, h);
        if (aspect > T(8)) continue;
        const T side = std::max(w, h) / static_cast<T>(tiles.count), shorter = std::min(w, h);
        wrong += side > shorter * T(1.51) || side < shorter / T(1.51);
        wrong += std::abs(tiles.size - (side + shorter) / 2) > slack;
        if (tiles.count > 1) wrong += std::abs(glm::length(tiles.step) - side) > slack;
    }
    CHECK(wrong == 0);
    CHECK(several > 10000);
}
