// What the study says while it works, and how it uses all cores for what is not timed.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace penumbra::study {

/// Progress on stderr: a line that is written over on a terminal, nothing but the start of each scene elsewhere.
void say(const std::string& scene, const std::string& what);

/// Calls work(first, count) for pieces of `count` things, on all cores; pieces begin at multiples of 64.
void in_parallel(std::size_t count, const std::function<void(std::size_t first, std::size_t count)>& work);

}  // namespace penumbra::study
