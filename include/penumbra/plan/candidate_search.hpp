// What is known when a method says what it may leave out.
#pragma once

#include <penumbra/mesh.hpp>
#include <penumbra/plan/scene_extents.hpp>
#include <penumbra/plan/selection.hpp>
#include <vector>

namespace penumbra::detail {

/// Casters and what is known of them, and the candidates that are found.
template <class T>
struct CandidateSearch {
    const std::vector<Mesh<T>>& casters;
    const SceneExtents<T>& extents;
    T budget;  ///< of what has a budget of its own
    std::vector<Candidate<T>> found;

    void add(Effect effect, T loss, const char* reason, T number) { found.push_back({effect, loss, reason, number}); }
    /// An effect of a method by images, without which they are as wrong as can be where there is a shadow.
    void add_of_images(Effect effect) {
        const T total = extents.total_hidden();
        add(effect, total > T(0) ? T(1) : T(0), "casters together hide up to %s of the light from a receiver", total);
    }
};

}  // namespace penumbra::detail
