// How far measured visibility is from the truth.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace penumbra::study {

struct Error {
    double rmse = 0.0, max = 0.0, bias = 0.0;  ///< of measured − truth
};

/// Over all points, or those of `only`; 0 over no points.
inline Error compare(const std::vector<float>& measured, const std::vector<float>& truth,
                     const std::vector<bool>* only = nullptr) {
    Error error;
    double count = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (only && !(*only)[i]) continue;
        const double difference = static_cast<double>(measured[i]) - static_cast<double>(truth[i]);
        error.rmse += difference * difference;
        error.bias += difference;
        error.max = std::max(error.max, std::abs(difference));
        count += 1.0;
    }
    count = std::max(count, 1.0);
    error.rmse = std::sqrt(error.rmse / count);
    error.bias /= count;
    return error;
}

}  // namespace penumbra::study
