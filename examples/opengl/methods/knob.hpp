// What can be turned about a method, under one name for the window, the command line and the tests.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace penumbra::opengl {

/// A number in [least, most], whole or not; a choice among names is the index of one.
struct Knob {
    std::string name;
    double least, most;
    bool whole;
    std::vector<std::string> names;
    std::function<double()> get;
    std::function<void(double)> set;
};

/// Of a variable that outlives the knob.
template <class Number>
Knob number_knob(std::string name, Number& value, Number least, Number most) {
    return {std::move(name),
            static_cast<double>(least),
            static_cast<double>(most),
            std::is_integral_v<Number>,
            {},
            [&value] { return static_cast<double>(value); },
            [&value](double x) { value = static_cast<Number>(x); }};
}

/// Of an enumeration that counts from 0, or a bool.
template <class Choice>
Knob choice_knob(std::string name, Choice& value, std::vector<std::string> names) {
    const auto most = static_cast<double>(names.size() - 1);
    return {std::move(name),
            0.0,
            most,
            true,
            std::move(names),
            [&value] { return static_cast<double>(static_cast<int>(value)); },
            [&value](double x) { value = static_cast<Choice>(static_cast<int>(x)); }};
}

inline Knob switch_knob(std::string name, bool& value) { return choice_knob(std::move(name), value, {"off", "on"}); }

}  // namespace penumbra::opengl
