// What a call reports.
#pragma once

#include <stdexcept>
#include <string>

namespace penumbra::test {

/// The message of the std::invalid_argument that a call throws; empty if it throws none.
template <class Call>
std::string error_of(Call&& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

}  // namespace penumbra::test
