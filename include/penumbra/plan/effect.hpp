// What can be simulated, and what is lost if it is not.
#pragma once

#include <penumbra/detail/error.hpp>
#include <string>

namespace penumbra {

/// Everything that a method may leave out, of all methods. What a method does not have is in none of its plans.
enum class Effect {
    casters,                ///< shadows of casters that hide next to nothing
    penumbra,               ///< a light with an extent; without: a hard test
    overlap,                ///< casters seen before each other; without: what each hides adds up
    silhouettes_per_point,  ///< without: silhouettes as the light's centre sees them
    slices,                 ///< as many slices of the casters as asked for
    n_buffer_levels,        ///< levels for the largest kernel there can be
    leak_closing,           ///< surfaces in the slice behind theirs as well
    self_shadow,            ///< a second texture for points within the casters' depths
    second_layer,           ///< two edges a texel of a D-buffer
    volume_silhouette,      ///< volumes between faces that see all of a disk and none; without: from its centre
    extra_samples,          ///< shadow maps inserted where two do not do
    exact_transition,       ///< skins by the edge itself; without: linear in the image
    every_point             ///< a query for each point; without: few, and the slope of visibility from there
};
inline constexpr int effect_count = 13;

/// As in the enumeration.
inline const char* name_of(Effect effect) {
    constexpr const char* names[effect_count] = {
        "casters",         "penumbra",         "overlap",     "silhouettes_per_point", "slices",
        "n_buffer_levels", "leak_closing",     "self_shadow", "second_layer",          "volume_silhouette",
        "extra_samples",   "exact_transition", "every_point"};
    return names[static_cast<int>(effect)];
}

/// An effect in a plan.
template <class T>
struct EffectDecision {
    Effect effect;
    bool simulated;      ///< where it may matter: see `share`
    T loss;              ///< visibility changes by at most this if it is left out everywhere, in [0, 1]
    T share;             ///< of visibility, what may be lost where points or tiles decide for themselves
    const char* reason;  ///< a sentence with one %s for `number`
    T number;            ///< what decided

    /// "overlap: left out, loses at most 0: boxes of 2 casters hide the light from the same point"
    std::string text() const {
        std::string because = reason;
        const std::size_t at = because.find("%s");
        if (at != std::string::npos) because.replace(at, 2, detail::text(static_cast<double>(number)));
        std::string result = name_of(effect);
        if (!simulated)
            result += ": left out, loses at most " + detail::text(static_cast<double>(loss));
        else if (share > T(0))
            result += ": where it changes visibility by more than " + detail::text(static_cast<double>(share));
        else
            result += ": simulated, would lose up to " + detail::text(static_cast<double>(loss));
        return result + ": " + because;
    }
};

}  // namespace penumbra
