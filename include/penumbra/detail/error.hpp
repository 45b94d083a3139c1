// How penumbra reports bad arguments: an exception where there are exceptions, a hook where there are none.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define PENUMBRA_HAS_EXCEPTIONS 1
#else
#define PENUMBRA_HAS_EXCEPTIONS 0
#endif

/// Called with a `const char*` when an argument is bad and exceptions are disabled. Define it before the
/// first include to log, assert or longjmp. The default prints the message and aborts. If it returns, the
/// object under construction is left empty and answers "fully visible".
#ifndef PENUMBRA_ON_ERROR
#define PENUMBRA_ON_ERROR(message) (std::fprintf(stderr, "penumbra: %s\n", (message)), std::abort())
#endif

namespace penumbra::detail {

/// Reports a bad argument by name and value: "mesh.triangles[4].y = 17 is not below 12 positions".
inline void fail(const std::string& message) {
#if PENUMBRA_HAS_EXCEPTIONS
    throw std::invalid_argument("penumbra: " + message);
#else
    PENUMBRA_ON_ERROR(message.c_str());
#endif
}

/// A number as messages show it: short.
inline std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.7g", value);
    return buffer;
}

/// Reports and returns false when `condition` does not hold; returns true otherwise.
template <class Message>
bool require(bool condition, Message&& message) {
    if (!condition) fail(message());
    return condition;
}

}  // namespace penumbra::detail
