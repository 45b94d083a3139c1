#include <doctest/doctest.h>

#include <penumbra/detail/error.hpp>
#include <stdexcept>
#include <string>

using namespace penumbra;

// Without exceptions: see compile/on_error.cpp.

TEST_CASE("a bad argument throws std::invalid_argument with the library's name") {
    CHECK_THROWS_WITH_AS(detail::fail("size = -1 is not positive"), "penumbra: size = -1 is not positive",
                         std::invalid_argument);
}

TEST_CASE("require makes its message only when it fails") {
    int made = 0;
    const auto message = [&] {
        ++made;
        return std::string("three is not two");
    };
    CHECK(detail::require(true, message));
    CHECK(made == 0);
    CHECK_THROWS_WITH_AS(detail::require(false, message), "penumbra: three is not two", std::invalid_argument);
    CHECK(made == 1);
}
