#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <penumbra/image.hpp>
#include <penumbra/raster.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

constexpr int grid = 256;                 // vertices are snapped to 1/256 texel
constexpr double half_step = 0.5 / grid;  // so they move by at most this much

template <class T>
using Triangle = std::array<RasterVertex<T>, 3>;

template <class T>
std::string describe(const Triangle<T>& t) {
    std::ostringstream text;
    text.precision(17);
    for (const auto& v : t) text << "(" << v.x << ", " << v.y << ", " << v.depth << ", " << v.w << ") ";
    return text.str();
}

/// How often each texel was hit, and the depth that it got last.
template <class T>
struct Canvas {
    Image<int> hits;
    Image<T> depth;
    bool outside = false;  // a fragment was not in the image

    Canvas(int width, int height) : hits(width, height), depth(width, height) {}

    void draw(const RasterVertex<T>& a, const RasterVertex<T>& b, const RasterVertex<T>& c, T near_depth = T(0)) {
        rasterize(a, b, c, hits.width(), hits.height(), near_depth, [&](int x, int y, T d) {
            if (x < 0 || y < 0 || x >= hits.width() || y >= hits.height()) {
                outside = true;
                return;
            }
            ++hits(x, y);
            depth(x, y) = d;
        });
    }
    void draw(const Triangle<T>& t, T near_depth = T(0)) { draw(t[0], t[1], t[2], near_depth); }
    int count(int hit) const { return static_cast<int>(std::count(hits.data(), hits.data() + hits.size(), hit)); }
};

struct GridPoint {
    std::int64_t x, y;  // in 1/256 texel
};

/// Truth for coverage. The top-left rule is what remains of "strictly inside" when every texel centre is moved right by
/// an infinitesimal, and down by a far smaller one; here 2^-15 and 2^-30 grid steps, which is exact for sides < 2^14.
bool covers(const std::array<GridPoint, 3>& t, int x, int y) {
    constexpr std::int64_t right = 1 << 15, one = right * right;
    const GridPoint s{(x * grid + grid / 2) * one + right, (y * grid + grid / 2) * one + 1};
    int left = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const GridPoint a = t[i], b = t[(i + 1) % 3];
        const std::int64_t side = (b.x - a.x) * (s.y - a.y * one) - (b.y - a.y) * (s.x - a.x * one);
        left += side > 0 ? 1 : side < 0 ? -1 : 0;
    }
    return left == 3 || left == -3;
}

struct Point2 {
    double x, y;
};

/// Distance from p to the segment a b, texels.
double distance(Point2 a, Point2 b, Point2 p) {
    const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
    double t = length2 > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0;
    t = std::min(std::max(t, 0.0), 1.0);
    return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

/// A triangle in (x, y, w) seen along the ray through texel position (u, v): the w where the ray meets its plane.
template <class T>
double w_on_ray(const Triangle<T>& t, double u, double v) {
    const auto at = [&](std::size_t i) {
        return glm::dvec3(static_cast<double>(t[i].x), static_cast<double>(t[i].y), static_cast<double>(t[i].w));
    };
    const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
    return glm::dot(normal, at(0)) / glm::dot(normal, glm::dvec3(u, v, 1));
}

/// A camera for tests: depth Z lands at (X, Y) / w with w = offset + convergence · Z, scaled to texels. (1, 0) is
/// orthographic, (0, 1) a pinhole, (1, c) the slice camera.
struct Camera {
    double offset, convergence;
    int size;

    template <class T>
    RasterVertex<T> project(const glm::dvec3& p) const {
        const double half = 0.5 * size, w = offset + convergence * p.z;
        return {static_cast<T>(p.x * half + half * w), static_cast<T>(p.y * half + half * w), static_cast<T>(p.z),
                static_cast<T>(w)};
    }
};

template <class T>
T from_bits(std::uint64_t bits) {
    T x;
    if constexpr (sizeof(T) == 4) {
        const auto small = static_cast<std::uint32_t>(bits);
        std::memcpy(&x, &small, sizeof x);
    } else {
        std::memcpy(&x, &bits, sizeof x);
    }
    return x;
}

}  // namespace

TEST_CASE_TEMPLATE("coverage is the top-left rule, texel for texel", T, float, double) {
    test::Random random(1);
    constexpr int width = 23, height = 19;
    int covered = 0, different = 0;
    std::string first;
    for (int i = 0; i < 12000; ++i) {
        // Steps of half a texel make most edges run through centres; the others test the grid itself.
        const int step = std::array<int, 4>{128, 64, 16, 1}[static_cast<std::size_t>(i % 4)];
        std::array<GridPoint, 3> p;
        Triangle<T> t;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = {random.whole(-12 * grid / step, 40 * grid / step) * step,
                    random.whole(-12 * grid / step, 40 * grid / step) * step};
            t[k] = {static_cast<T>(p[k].x) / T(grid), static_cast<T>(p[k].y) / T(grid), T(1), T(1)};
        }
        Canvas<T> canvas(width, height);
        canvas.draw(t);
        bool same = !canvas.outside;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const int expected = covers(p, x, y) ? 1 : 0;
                covered += expected;
                same = same && canvas.hits(x, y) == expected;
            }
        if (!same && different++ == 0) first = describe(t);
    }
    INFO(first);
    CHECK(different == 0);
    CHECK(covered > 500000);
}

TEST_CASE_TEMPLATE("both orientations and every order of the vertices cover the same texels", T, float, double) {
    test::Random random(2);
    for (int i = 0; i < 300; ++i) {
        Triangle<T> t;
        for (auto& v : t) {
            const T w = random.in(T(0.5), T(2));
            v = {random.in(T(-5), T(25)) * w, random.in(T(-5), T(25)) * w, random.in(T(1), T(2)), w};
        }
        Canvas<T> reference(20, 20);
        reference.draw(t);
        std::array<std::size_t, 3> order{0, 1, 2};
        while (std::next_permutation(order.begin(), order.end())) {
            Canvas<T> canvas(20, 20);
            canvas.draw(t[order[0]], t[order[1]], t[order[2]]);
            INFO(describe(t));
            CHECK(std::equal(canvas.hits.data(), canvas.hits.data() + canvas.hits.size(), reference.hits.data()));
        }
    }
}

TEST_CASE_TEMPLATE("off the grid, only texels within half a step of an edge may differ from exact coverage", T, float,
                   double) {
    test::Random random(3);
    int wrong = 0, sure = 0;
    for (int i = 0; i < 4000; ++i) {
        Triangle<T> t;
        std::array<Point2, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            const T w = random.in(T(0.01), T(100));
            t[k] = {random.in(T(-20), T(50)) * w, random.in(T(-20), T(50)) * w, T(1), w};
            p[k] = {static_cast<double>(t[k].x) / static_cast<double>(w),
                    static_cast<double>(t[k].y) / static_cast<double>(w)};
        }
        Canvas<T> canvas(30, 30);
        canvas.draw(t);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 30; ++x) {
                const Point2 c{x + 0.5, y + 0.5};
                // a vertex moves by half a step in x and in y
                const double tolerance = half_step * std::sqrt(2.0);
                bool doubtful = false;
                int left = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Point2 a = p[k], b = p[(k + 1) % 3];
                    doubtful = doubtful || distance(a, b, c) <= tolerance;
                    left += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0 ? 1 : 0;
                }
                if (doubtful) continue;
                ++sure;
                wrong += canvas.hits(x, y) != (left == 0 || left == 3 ? 1 : 0);
            }
    }
    CHECK(wrong == 0);
    CHECK(sure > 3000000);
}

TEST_CASE_TEMPLATE("a triangulated region is hit exactly once everywhere", T, float, double) {
    test::Random random(4);
    constexpr int size = 96;
    SUBCASE("a jittered grid under perspective, edges through texel centres among them") {
        for (int round = 0; round < 20; ++round) {
            const int cells = random.whole(1, 40);
            const bool on_centers = round % 2 == 0;
            std::vector<RasterVertex<T>> v;
            for (int j = 0; j <= cells; ++j)
                for (int i = 0; i <= cells; ++i) {
                    const bool inner_x = i > 0 && i<cells, inner_y = j> 0 && j < cells;
                    T x = static_cast<T>(size * (i + (inner_x ? random.in(-0.25, 0.25) : 0.0)) / cells);
                    T y = static_cast<T>(size * (j + (inner_y ? random.in(-0.25, 0.25) : 0.0)) / cells);
                    if (on_centers && cells < 20) {  // cells wider than two texels stay upright
                        x = inner_x ? std::floor(x) + T(0.5) : x;
                        y = inner_y ? std::floor(y) + T(0.5) : y;
                    }
                    const T w = on_centers ? T(1) : random.in(T(0.1), T(10));
                    v.push_back({x * w, y * w, random.in(T(1), T(2)), w});
                }
            Canvas<T> canvas(size, size);
            const auto at = [&](int i, int j) { return v[static_cast<std::size_t>(j * (cells + 1) + i)]; };
            for (int j = 0; j < cells; ++j)
                for (int i = 0; i < cells; ++i) {
                    const bool other = random.whole(0, 1) == 1;
                    canvas.draw(at(i, j), at(i + 1, j), at(other ? i : i + 1, j + 1));
                    canvas.draw(at(i + 1, j + 1), at(i, j + 1), at(other ? i + 1 : i, j));
                }
            CAPTURE(cells);
            CAPTURE(round);
            CHECK(canvas.count(1) == size * size);
        }
    }
    SUBCASE("slivers around a point, also around a texel centre") {
        for (const T middle : {T(48), T(48.5), T(47.3)}) {
            constexpr int parts = 900;
            const auto border = [&](int i) {
                const int k = (i % parts) * 4, side = k / parts;
                const T s = static_cast<T>(k % parts) * T(size) / T(parts);
                const T x = side == 0 ? s : side == 1 ? T(size) : side == 2 ? T(size) - s : T(0);
                const T y = side == 0 ? T(0) : side == 1 ? s : side == 2 ? T(size) : T(size) - s;
                return RasterVertex<T>{x, y, T(1), T(1)};
            };
            Canvas<T> canvas(size, size);
            for (int i = 0; i < parts; ++i) canvas.draw({middle, middle, T(1), T(1)}, border(i), border(i + 1));
            CAPTURE(middle);
            CHECK(canvas.count(1) == size * size);
        }
    }
}

TEST_CASE_TEMPLATE("triangles cut by the near plane and far outside the image agree with ray casting", T, float,
                   double) {
    // A fan of triangles on a plane through the pinhole camera's view, up to 10^5 across, much of it behind the camera.
    test::Random random(5);
    constexpr int size = 64;
    const Camera camera{0, 1, size};
    const T near_depth = T(0.1);
    long sure = 0, wrong = 0, twice = 0, hit = 0, wrong_depth = 0;
    for (int scene = 0; scene < 150; ++scene) {
        const glm::dvec3 origin = random.point(-1.0, 1.0) + glm::dvec3(0, 0, 2), u = random.point(-1.0, 1.0),
                         v = random.point(-1.0, 1.0);
        const double radius = std::pow(10.0, random.in(0.0, 5.0));
        const int parts = random.whole(5, 14);
        std::vector<RasterVertex<T>> rim;
        std::vector<Point2> rim_st;
        for (int i = 0; i < parts; ++i) {
            const double angle = 2 * std::acos(-1.0) * (i + random.in(0.0, 0.4)) / parts;
            rim_st.push_back({radius * std::cos(angle), radius * std::sin(angle)});
            rim.push_back(camera.project<T>(origin + u * rim_st.back().x + v * rim_st.back().y));
        }
        Canvas<T> canvas(size, size);
        const RasterVertex<T> hub = camera.project<T>(origin);
        for (std::size_t i = 0; i < rim.size(); ++i) canvas.draw(hub, rim[i], rim[(i + 1) % rim.size()], near_depth);

        const glm::dvec3 normal = glm::cross(u, v);
        const auto depth_at = [&](double x, double y) {  // of the plane; 0 for a miss
            const glm::dvec3 ray(x * 2 / size - 1, y * 2 / size - 1, 1);
            const double depth = glm::dot(normal, origin) / glm::dot(normal, ray);
            if (!(depth >= static_cast<double>(near_depth))) return 0.0;
            const glm::dvec3 p = ray * depth - origin;
            const double s = glm::dot(glm::cross(p, v), normal) / glm::dot(normal, normal);
            const double t = glm::dot(glm::cross(u, p), normal) / glm::dot(normal, normal);
            for (std::size_t i = 0; i < rim_st.size(); ++i) {
                const Point2 a = rim_st[i], b = rim_st[(i + 1) % rim_st.size()];
                if ((b.x - a.x) * (t - a.y) - (b.y - a.y) * (s - a.x) < 0) return 0.0;
            }
            return depth;
        };
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                // Snapping, and rounding of float vertices and cuts far outside, move edges by less than this, texels.
                constexpr double slack = 0.05;
                double low = 1e300, high = 0;
                for (const double dy : {-slack, 0.0, slack})
                    for (const double dx : {-slack, 0.0, slack}) {
                        const double depth = depth_at(x + 0.5 + dx, y + 0.5 + dy);
                        low = std::min(low, depth), high = std::max(high, depth);
                    }
                twice += canvas.hits(x, y) > 1;
                hit += canvas.hits(x, y);
                if ((low > 0) != (high > 0)) continue;
                ++sure;
                wrong += (canvas.hits(x, y) > 0) != (low > 0);
                if (canvas.hits(x, y) == 0) continue;
                const auto depth = static_cast<double>(canvas.depth(x, y));
                wrong_depth += depth < low * 0.99999 || depth > high * 1.00001;
            }
    }
    CHECK(twice == 0);
    CHECK(wrong == 0);
    CHECK(wrong_depth == 0);
    CHECK(hit > 100000);
    CHECK(sure > 550000);
}

TEST_CASE_TEMPLATE("a triangle cut at the near plane hits no texel twice, nor does its neighbour", T, float, double) {
    // A vertex just behind the cut makes a thin corner that snapping can turn over.
    test::Random random(6);
    constexpr int size = 64;
    int twice = 0, below = 0;
    std::string first;
    for (int i = 0; i < 60000; ++i) {
        const auto vertex = [&](double depth) {
            const T w = static_cast<T>(depth);
            return RasterVertex<T>{random.in(T(0), T(size)) * w, random.in(T(0), T(size)) * w, w, w};
        };
        const Triangle<T> t{vertex(random.in(1.0, 3.0)), vertex(1 + std::pow(10.0, random.in(-6.0, -1.0))),
                            vertex(random.in(0.2, 0.9))};
        // The neighbour across the first edge lies on the other side of it in the image.
        const double ax = static_cast<double>(t[0].x / t[0].w), ay = static_cast<double>(t[0].y / t[0].w);
        const double bx = static_cast<double>(t[1].x / t[1].w), by = static_cast<double>(t[1].y / t[1].w);
        const double cx = static_cast<double>(t[2].x / t[2].w), cy = static_cast<double>(t[2].y / t[2].w);
        const double area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        if (std::abs(area) < 0.05 * std::hypot(bx - ax, by - ay)) continue;  // the grid may turn all of it over
        const double side = area > 0 ? 30 : -30;
        const RasterVertex<T> across{static_cast<T>(2 * ((ax + bx) / 2 + side * (by - ay) / size)),
                                     static_cast<T>(2 * ((ay + by) / 2 - side * (bx - ax) / size)), T(2), T(2)};
        Canvas<T> canvas(size, size);
        canvas.draw(t, T(1));
        for (std::size_t k = 0; k < canvas.hits.size(); ++k)
            below += canvas.hits.data()[k] > 0 && !(canvas.depth.data()[k] >= T(1));
        canvas.draw(t[1], t[0], across, T(1));
        const int before = twice;
        for (std::size_t k = 0; k < canvas.hits.size(); ++k) twice += canvas.hits.data()[k] > 1;
        if (before == 0 && twice > 0) first = describe(t);
    }
    INFO(first);
    CHECK(twice == 0);
    CHECK(below == 0);
}

TEST_CASE_TEMPLATE("edges of vertices up to 10^9 texels away stay where they are", T, float, double) {
    test::Random random(7);
    constexpr int size = 40;
    int sure = 0, wrong = 0, hit = 0;
    std::string first;
    for (int i = 0; i < 6000; ++i) {
        Triangle<T> t;
        std::array<Point2, 3> p;
        // The first edge runs through the image; its ends, and the third vertex, are anywhere.
        const T angle = random.in(T(0), T(7)), mid_x = random.in(T(0), T(size)), mid_y = random.in(T(0), T(size));
        for (std::size_t k = 0; k < 3; ++k) {
            const T reach = std::pow(T(10), random.in(T(1), T(9))) * (k == 1 ? T(-1) : T(1));
            const T turn = k == 2 ? random.in(T(0), T(7)) : angle;
            t[k] = {mid_x + reach * std::cos(turn), mid_y + reach * std::sin(turn), T(1), T(1)};
            p[k] = {static_cast<double>(t[k].x), static_cast<double>(t[k].y)};
        }
        Canvas<T> canvas(size, size);
        canvas.draw(t);
        const int before = wrong;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const Point2 c{x + 0.5, y + 0.5};
                bool doubtful = false;
                int left = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Point2 a = p[k], b = p[(k + 1) % 3];
                    const double side = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
                    // a grid step for snapping; the truth's own rounding is below 1e-6
                    doubtful = doubtful || std::abs(side) <= std::hypot(b.x - a.x, b.y - a.y) / grid;
                    left += side > 0 ? 1 : 0;
                }
                hit += canvas.hits(x, y);
                if (doubtful) continue;
                ++sure;
                wrong += canvas.hits(x, y) != (left == 0 || left == 3 ? 1 : 0);
            }
        if (before == 0 && wrong > 0) first = describe(t);
    }
    INFO(first);
    CHECK(wrong == 0);
    CHECK(hit > 100000);
    CHECK(sure > 9000000);
}

TEST_CASE_TEMPLATE("a triangle that holds the whole image fills it, however huge", T, float, double) {
    for (const T reach : {T(1e3), T(1e6), T(1e12), T(1e20), T(1e30)})
        for (const T w : {T(1), T(1e-3), T(1e3)}) {
            Canvas<T> canvas(31, 17);
            const T far = reach * w;
            canvas.draw({-far, -far, T(1), w}, {T(3) * far, -far, T(1), w}, {-far, T(3) * far, T(1), w});
            CAPTURE(reach);
            CAPTURE(w);
            CHECK(canvas.count(1) == 31 * 17);
            Canvas<T> empty(31, 17);
            empty.draw({far, far, T(1), w}, {T(3) * far, far, T(1), w}, {far, T(3) * far, T(1), w});
            CHECK(empty.count(0) == 31 * 17);
        }
}

TEST_CASE_TEMPLATE("depth is where the ray through the texel's centre meets the triangle", T, float, double) {
    test::Random random(8);
    constexpr int size = 48;
    for (const Camera camera : {Camera{0, 1, size}, Camera{1, 0.5, size}, Camera{1, 16, size}}) {
        int fragments = 0, wrong = 0;
        std::string first;
        for (int i = 0; i < 1500; ++i) {
            Triangle<T> t;
            T shallow = T(1e9), deep = T(0);
            for (auto& v : t) {
                glm::dvec3 p = random.point(-1.2, 1.2);
                p.z = random.in(0.5, 8.0);
                if (i % 3 == 0) p.x = p.y * 0.3 + 1e-2 * p.z * random.in(-1.0, 1.0);  // nearly edge-on
                const double w = camera.offset + camera.convergence * p.z;
                v = camera.project<T>({p.x * w, p.y * w, p.z});
                shallow = std::min(shallow, v.depth), deep = std::max(deep, v.depth);
            }
            Canvas<T> canvas(size, size);
            canvas.draw(t);
            const auto truth = [&](double x, double y) {
                const double depth = (w_on_ray(t, x, y) - camera.offset) / camera.convergence;
                return std::min(std::max(depth, static_cast<double>(shallow)), static_cast<double>(deep));
            };
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    if (canvas.hits(x, y) == 0) continue;
                    ++fragments;
                    const T depth = canvas.depth(x, y);
                    // The corners move by half a step at most, and the plane's depth with them. Steep planes reach
                    // their pole within that: then any depth of the triangle is right.
                    double low = 1e300, high = -1e300;
                    bool pole = false;
                    const double middle = w_on_ray(t, x + 0.5, y + 0.5);
                    for (const double dy : {-half_step, half_step})
                        for (const double dx : {-half_step, half_step}) {
                            const double d = truth(x + 0.5 + dx, y + 0.5 + dy);
                            low = std::min(low, d), high = std::max(high, d);
                            pole = pole || (w_on_ray(t, x + 0.5 + dx, y + 0.5 + dy) > 0) != (middle > 0);
                        }
                    // Rounding: 4 ULP of the result, and 1e-9 for the truth's own conditioning at edge-on planes.
                    const double slack =
                        static_cast<double>(deep) * (4 * static_cast<double>(std::numeric_limits<T>::epsilon()) + 1e-9);
                    const auto d = static_cast<double>(depth);
                    const bool good =
                        depth >= shallow && depth <= deep && (pole || (d >= low - slack && d <= high + slack));
                    if (!good && wrong++ == 0) first = describe(t);
                }
        }
        INFO(first);
        CAPTURE(camera.convergence);
        CHECK(wrong == 0);
        CHECK(fragments > 50000);
    }
}

TEST_CASE_TEMPLATE("without perspective, depth is linear in the image", T, float, double) {
    // depth = 1 + x/8 + y/4 at position (x, y): exact at centres, because the vertices lie on the grid
    const auto vertex = [](T x, T y) { return RasterVertex<T>{x, y, T(1) + x / T(8) + y / T(4), T(1)}; };
    Canvas<T> canvas(32, 32);
    canvas.draw(vertex(T(0), T(0)), vertex(T(32), T(0)), vertex(T(0), T(32)));
    CHECK(canvas.count(1) == 32 * 31 / 2);  // centres on the diagonal lie right of it
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x + y < 31; ++x)
            CHECK(static_cast<double>(canvas.depth(x, y)) ==
                  doctest::Approx(1 + (x + 0.5) / 8 + (y + 0.5) / 4).epsilon(1e-6));
}

TEST_CASE_TEMPLATE("constant depth stays constant to the last bit", T, float, double) {
    test::Random random(9);
    for (int i = 0; i < 200; ++i) {
        const T depth = random.in(T(0.1), T(9));
        Triangle<T> t;
        for (auto& v : t) {
            const T w = random.in(T(0.5), T(2));
            v = {random.in(T(0), T(20)) * w, random.in(T(0), T(20)) * w, depth, w};
        }
        Canvas<T> canvas(20, 20);
        canvas.draw(t);
        for (std::size_t k = 0; k < canvas.hits.size(); ++k)
            if (canvas.hits.data()[k] > 0) CHECK(canvas.depth.data()[k] == depth);
    }
}

TEST_CASE_TEMPLATE("what lies before the near depth is not drawn, whatever its w", T, float, double) {
    test::Random random(10);
    const RasterVertex<T> a{T(4), T(4), T(0.5), T(-1)}, b{T(20), T(4), T(0.9), T(0)}, c{T(4), T(20), T(-3), T(1)};
    Canvas<T> canvas(24, 24);
    canvas.draw(a, b, c, T(1));
    CHECK(canvas.count(0) == 24 * 24);
    // exactly on the near plane counts as behind it
    canvas.draw({T(4), T(4), T(1), T(1)}, {T(20), T(4), T(1), T(1)}, {T(4), T(20), T(1), T(1)}, T(1));
    CHECK(canvas.count(1) == 16 * 15 / 2);
    // depth 0 → 16 along x, cut at 8: columns 8 to 15 are left
    Canvas<T> half(24, 24);
    const auto vertex = [](T x, T y) { return RasterVertex<T>{x, y, x, T(1)}; };
    half.draw(vertex(T(0), T(0)), vertex(T(16), T(0)), vertex(T(16), T(16)), T(8));
    half.draw(vertex(T(0), T(0)), vertex(T(16), T(16)), vertex(T(0), T(16)), T(8));
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) CHECK(half.hits(x, y) == (x >= 8 && x < 16 && y < 16 ? 1 : 0));
}

TEST_CASE_TEMPLATE("triangles without area draw nothing", T, float, double) {
    test::Random random(11);
    Canvas<T> canvas(32, 32);
    for (int i = 0; i < 2000; ++i) {
        const auto whole = [&] { return static_cast<T>(random.whole(-20, 50)) * T(0.5); };
        const RasterVertex<T> a{whole(), whole(), T(1), T(1)}, step{whole(), whole(), T(0), T(0)};
        canvas.draw(a, a + step, a + step * static_cast<T>(random.whole(-3, 3)));  // collinear, on the grid
        canvas.draw(a, a, a + step);
        canvas.draw(a, a, a);
    }
    CHECK(canvas.count(0) == 32 * 32);
}

TEST_CASE_TEMPLATE("a vertex that is not finite, or has no place in the image, draws nothing", T, float, double) {
    const bool single = sizeof(T) == 4;
    const T infinity = from_bits<T>(single ? 0x7f800000U : 0x7ff0000000000000U);
    const T minus_infinity = from_bits<T>(single ? 0xff800000U : 0xfff0000000000000U);
    const T nan = from_bits<T>(single ? 0x7fc00000U : 0x7ff8000000000000U);
    for (const T bad : {nan, infinity, minus_infinity})
        for (std::size_t vertex = 0; vertex < 3; ++vertex)
            for (T RasterVertex<T>::*member :
                 {&RasterVertex<T>::x, &RasterVertex<T>::y, &RasterVertex<T>::depth, &RasterVertex<T>::w}) {
                Triangle<T> t{{{T(0), T(0), T(1), T(1)}, {T(20), T(0), T(1), T(1)}, {T(0), T(20), T(1), T(1)}}};
                t[vertex].*member = bad;
                Canvas<T> canvas(16, 16);
                canvas.draw(t);
                CAPTURE(bad);
                CAPTURE(vertex);
                CHECK(canvas.count(0) == 16 * 16);
            }
    for (const T w : {T(0), T(-1)}) {
        Canvas<T> canvas(16, 16);
        canvas.draw({T(0), T(0), T(1), w}, {T(20), T(0), T(1), w}, {T(0), T(20), T(1), w});
        CHECK(canvas.count(0) == 16 * 16);
    }
}

TEST_CASE_TEMPLATE("any finite vertices give texels of the image and depths of the triangle", T, float, double) {
    // values of every magnitude and sign, zero and denormals among them, w included
    test::Random random(12);
    const double largest = sizeof(T) == 4 ? 38 : 295;
    int fragments = 0, bad = 0;
    std::string first;
    for (int i = 0; i < 100000; ++i) {
        const auto any = [&] {
            const double range = i % 3 == 0 ? largest : 6;
            const double x = std::pow(10.0, random.in(-range, range)) * (random.whole(0, 1) == 0 ? -1 : 1);
            return random.whole(0, 9) == 0 ? T(0) : static_cast<T>(x);
        };
        Triangle<T> t;
        for (auto& v : t) v = {any(), any(), any(), any()};
        if (i % 2 == 0)
            for (auto& v : t) v.w = std::abs(v.w);
        const T near_depth = random.whole(0, 1) == 0 ? T(0) : any();
        rasterize(t[0], t[1], t[2], 7, 5, near_depth, [&](int x, int y, T depth) {
            ++fragments;
            const bool good = x >= 0 && x < 7 && y >= 0 && y < 5 && depth >= near_depth &&
                              depth >= std::min({t[0].depth, t[1].depth, t[2].depth}) &&
                              depth <= std::max({t[0].depth, t[1].depth, t[2].depth});
            if (!good && bad++ == 0) first = describe(t);
        });
    }
    INFO(first);
    CHECK(bad == 0);
    CHECK(fragments > 10000);
}

TEST_CASE_TEMPLATE("images of one texel, one row, one column and the largest side", T, float, double) {
    const auto square = [](Canvas<T>& canvas, T x0, T y0, T x1, T y1) {
        const RasterVertex<T> a{x0, y0, T(1), T(1)}, b{x1, y0, T(1), T(1)}, c{x1, y1, T(1), T(1)},
            d{x0, y1, T(1), T(1)};
        canvas.draw(a, b, c);
        canvas.draw(c, d, a);
    };
    for (const auto& size : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1), glm::ivec2(16384, 1),
                             glm::ivec2(1, 16384), glm::ivec2(16384, 3)}) {
        Canvas<T> all(size.x, size.y);
        square(all, T(0), T(0), static_cast<T>(size.x), static_cast<T>(size.y));
        CAPTURE(size.x);
        CAPTURE(size.y);
        CHECK(all.count(1) == size.x * size.y);
        Canvas<T> last(size.x, size.y);
        square(last, static_cast<T>(size.x) - T(0.75), static_cast<T>(size.y) - T(0.75), T(20000), T(20000));
        CHECK(last.count(1) == 1);
        CHECK(last.hits(size.x - 1, size.y - 1) == 1);
        Canvas<T> none(size.x, size.y);
        square(none, static_cast<T>(size.x), T(0), T(30000), T(20000));
        square(none, T(-9000), T(-9000), T(0), T(20000));
        CHECK(none.count(0) == size.x * size.y);
    }
}
