// How much of a disk light a straight edge leaves visible, or two edges do.
//
// Seen from a point, an edge's line cuts the disk. t is the share of the diameter across the line that lies on the
// visible side: 0 none, 1 all. All that follows depends on t alone, of two cuts on the angle between them too. Square
// roots and polynomials only: acos u − u √(1−u²) loses every digit as t goes to 0, and drivers compute acos badly.
#pragma once

#include <cmath>
#include <cstddef>
#include <penumbra/numeric.hpp>
#include <type_traits>

namespace penumbra {

namespace detail {

/// A polynomial by its coefficients, the highest power first.
template <class T, std::size_t Count>
inline T polynomial(const T (&coefficients)[Count], T x) {
    T sum = coefficients[0];
    for (std::size_t k = 1; k < Count; ++k) sum = sum * x + coefficients[k];
    return sum;
}

// Minimax polynomials. The functions branch at x = 1, outside of [0, ½], so that each degree gains a factor of 5.8.

/// (acos u − u √(1−u²)) / (π x√x), u = 1 − 2x, on [0, ¼], good to ½: 4.5e-9, 3e-19.
template <class T>
inline T segment_polynomial(T x) {
    if constexpr (std::is_same_v<T, float>) {
        constexpr float c[] = {-0.0289189792474F, 0.0193219960625F,  -0.0235414629178F, -0.0148188030782F,
                               -0.0358054016615F, -0.0909174699082F, -0.509296500409F,  1.69765272899F};
        return polynomial(c, x);
    } else {
        constexpr T c[] = {
            -0.10790386143014521728,   0.42053977924041116119,    -0.78448810977098869463,   0.90677167163201523023,
            -0.72658257742144498358,   0.42250492771367186859,    -0.18679041136781249302,   0.060959416650672694709,
            -0.017735463338845251504,  0.0011612380008119346946,  -0.0031391128726314644661, -0.0034517835997937019763,
            -0.0048323286429441372112, -0.0069627098678682956577, -0.010712366157167338524,  -0.018085788566835888227,
            -0.035367765139125383149,  -0.090945681766725054102,  -0.50929581789406534697,   1.6976527263135502484};
        return polynomial(c, x);
    }
}

/// (asin u + u √(1−u²)) 2 / (π u) of u² on [0, ¼]: 2e-9, 1e-18.
template <class T>
inline T middle_polynomial(T x) {
    if constexpr (std::is_same_v<T, float>) {
        constexpr float c[] = {-0.00532615960304F, -0.00484978258107F, -0.0114604118034F,
                               -0.0318254405713F,  -0.21220671124F,    1.27323954515F};
        return polynomial(c, x);
    } else {
        constexpr T c[] = {-0.0014538532607533018907, 0.00081054392518982811169,  -0.0010512311710884613851,
                           -0.0003652346858263239563, -0.00077388293189452313213, -0.00097412661940386063232,
                           -0.0013684102619807592669, -0.0020085172357200342061,  -0.0031650154599871728945,
                           -0.005526213226372939105,  -0.011368210222272864994,   -0.031830988618365092374,
                           -0.21220659078919383494,   1.2732395447351626862};
        return polynomial(c, x);
    }
}

/// acos(1 − 2x) / √x on [0, ½]: 6e-9, 7e-18.
template <class T>
inline T angle_polynomial(T x) {
    if constexpr (std::is_same_v<T, float>) {
        constexpr float c[] = {0.24782698981F,   -0.27183254248F, 0.214800042603F, -0.0140411583046F, 0.071628478568F,
                               0.0881832334674F, 0.150055146327F, 0.333332284756F, 2.00000000325F};
        return polynomial(c, x);
    } else {
        constexpr T c[] = {
            2.2528385757615015286,   -8.8776333841338787316,  16.649967058893822673,   -19.339318797101245845,
            15.53633074911001615,    -9.0715836056459107592,  4.0032082218583090158,   -1.3282472605098823712,
            0.36191492418221301213,  -0.05263264910467765452, 0.030183590057166728838, 0.021858698129824740284,
            0.028038344080139317512, 0.034698620654316392557, 0.044744626344971606887, 0.060763879763346790511,
            0.089285714450395661055, 0.14999999999843204607,  0.33333333333333924546,  1.9999999999999999963};
        return polynomial(c, x);
    }
}

/// sin y / y and cos y of y² for |y| ≤ π/4: 3e-9 and 5e-11; 2e-21 and 2e-23.
template <class T>
inline T sine_polynomial(T square) {
    if constexpr (std::is_same_v<T, float>) {
        constexpr float c[] = {-0.000195035694849F, 0.00833203320232F, -0.166666506261F, 0.999999996905F};
        return polynomial(c, square);
    } else {
        constexpr T c[] = {
            -7.5780213832020094931e-13, 1.6058351049303359095e-10, -2.5052104768288217678e-8, 2.7557319213520537562e-6,
            -0.00019841269841253396365, 0.0083333333333333206424,  -0.16666666666666666629,   1.0};
        return polynomial(c, square);
    }
}
template <class T>
inline T cosine_polynomial(T square) {
    if constexpr (std::is_same_v<T, float>) {
        constexpr float c[] = {2.43794126961e-5F, -0.00138866134784F, 0.041666616543F, -0.499999996133F,
                               0.999999999952F};
        return polynomial(c, square);
    } else {
        constexpr T c[] = {4.7362623922239793372e-14,
                           -1.1470245978895138823e-11,
                           2.0876753870748414966e-9,
                           -2.755731921264828275e-7,
                           0.000024801587301563074721,
                           -0.0013888888888888859806,
                           0.041666666666666666492,
                           -0.5,
                           1.0};
        return polynomial(c, square);
    }
}

/// Half the arc on the visible side of a cut, in radians: acos(1 − 2t), in [0, π].
template <class T>
inline T half_arc(T t) {
    const bool above = t > T(0.5);
    const T x = above ? T(1) - t : t;
    const T near = std::sqrt(x) * angle_polynomial(x);
    return above ? pi<T> - near : near;
}

}  // namespace detail

/// Visibility behind one straight edge: the fraction of a disk on the visible side of a line, (acos u − u √(1−u²)) / π
/// with u = 1 − 2t. Domain: any t, limited to [0, 1]. Range [0, 1]; exactly 0, ½ and 1 at 0, ½ and 1;
/// V(1 − t) = 1 − V(t) where 1 − t is exact. Never falls by more than one ULP from a number to the next, two with
/// -ffast-math. Error in float: 7.3e-8, and relative 2.2e-7 down to the smallest normal result; in double 3e-16 and
/// 1e-15.
template <class T>
T disk_visibility(T t) {
    const T share = saturate(t), from_middle = share - T(0.5);
    const T u = T(2) * from_middle;
    const T middle = T(0.5) + from_middle * detail::middle_polynomial(u * u);
    const T x = from_middle > T(0) ? T(1) - share : share;
    // multiplied in this order: the other way round falls by two ULP here and there
    const T segment = x * (std::sqrt(x) * detail::segment_polynomial(x));
    return x > T(0.25) ? middle : from_middle > T(0) ? T(1) - segment : segment;
}

/// The cubic 3t² − 2t³ in place of V(t). Domain, range and exact values as disk_visibility(t). Off from V by up to
/// 0.039 (at t = 0.096 and 0.904).
template <class T>
T disk_visibility_cubic(T t) {
    const T share = saturate(t);
    return share * share * (T(3) - T(2) * share);
}

/// √t in place of V(t), meant for small casters. Domain and range as disk_visibility(t). Off from V by up to 0.306 (at
/// t = 0.14).
template <class T>
T disk_visibility_sqrt(T t) {
    return std::sqrt(saturate(t));
}

/// Visibility behind two straight edges: the fraction of a disk on the visible sides of both. `angle` is that between
/// the directions that point straight into the two visible sides: 0 for edges that hide from the same side, π for
/// opposite ones. Domain: t1 and t2 limited to [0, 1], angle in radians to [0, π]. Range: [max(0, V1 + V2 − 1),
/// min(V1, V2)], so that an edge that hides nothing, or all, leaves exactly V of the other, or 0. Continuous through
/// parallel, coincident and opposite cuts; swapping the cuts may change the last bits. Error: 2.3e-7, 1e-15.
template <class T>
T disk_visibility(T t1, T t2, T angle) {
    const T share1 = saturate(t1), share2 = saturate(t2), turn = clamp(angle, T(0), pi<T>);
    // sine and cosine of half the angle, or of what it lacks to a right angle, which is smaller
    const bool obtuse = turn > T(0.5) * pi<T>;
    const T half = T(0.5) * (obtuse ? pi<T> - turn : turn);
    const T sine = half * detail::sine_polynomial(half * half), cosine = detail::cosine_polynomial(half * half);
    // Where the cuts cross, along each from its middle: (u_j − u_i cos α) / sin α, without its cancellation for cuts
    // that are almost parallel. Errors of the two then cancel in the area.
    const T u1 = T(1) - T(2) * share1, u2 = T(1) - T(2) * share2;
    const T apart = obtuse ? (T(1) - share1) - share2 : share1 - share2;
    const T crossing = apart / (sine * cosine + T(1e-30)), lean = sine / cosine;
    const T cross1 = obtuse ? crossing - u1 * lean : crossing + u1 * lean;
    const T cross2 = obtuse ? crossing - u2 * lean : u2 * lean - crossing;
    const T reach1 = T(2) * std::sqrt(share1 * (T(1) - share1)), reach2 = T(2) * std::sqrt(share2 * (T(1) - share2));
    const T length1 = reach1 - clamp(cross1, -reach1, reach1), length2 = reach2 - clamp(cross2, -reach2, reach2);
    // what the two arcs have in common, in one piece or two
    const T arc1 = detail::half_arc(share1), arc2 = detail::half_arc(share2), back = T(2) * pi<T> - turn;
    const T front = clamp(turn + arc2, -arc1, arc1) - clamp(turn - arc2, -arc1, arc1);
    const T rest = clamp(arc2 - back, -arc1, arc1) - clamp(-arc2 - back, -arc1, arc1);
    const T area = ((front + rest) - u1 * length1 - u2 * length2) * (T(0.5) / pi<T>);
    const T v1 = disk_visibility(share1), v2 = disk_visibility(share2);
    const T low = v1 < v2 ? v1 : v2, high = v1 < v2 ? v2 : v1;
    const T least = high < T(1) ? low - (T(1) - high) : low;
    const T raised = area > least ? area : least;
    return clamp(raised, T(0), low);
}

/// Visibility past one convex caster between two lines, a strip or a corner: what is on the visible side of either,
/// V1 + V2 − V12. Arguments, domain and error as disk_visibility(t1, t2, angle). Range: [max(V1, V2), min(1, V1 + V2)].
template <class T>
T disk_visibility_between(T t1, T t2, T angle) {
    // as the hidden sides' common part, which is V12 of the complements: exact where nothing is hidden
    return T(1) - disk_visibility(T(1) - saturate(t1), T(1) - saturate(t2), angle);
}

}  // namespace penumbra
