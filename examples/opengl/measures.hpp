// What is said of many numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <stdexcept>
#include <string>
#include <vector>

namespace penumbra::opengl {

/// 0 for none.
inline float median(std::deque<float> values) {
    if (values.empty()) return 0.0F;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Of equally many values; 0 for none.
inline double rmse(const std::vector<float>& visible, const std::vector<float>& truth) {
    double sum = 0.0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const double error = static_cast<double>(visible[i]) - static_cast<double>(truth[i]);
        sum += error * error;
    }
    return std::sqrt(sum / std::max(static_cast<double>(visible.size()), 1.0));
}

/// Throws the first of the driver's complaints.
inline void require_none(const std::vector<std::string>& complaints) {
    if (!complaints.empty()) throw std::runtime_error("the driver complains: " + complaints.front());
}

}  // namespace penumbra::opengl
