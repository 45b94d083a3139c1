// Programs that outlive the settings that they were made for, so that to change back, or a size, compiles nothing.
#pragma once

#include <string>
#include <unordered_map>

#include "../gl/program.hpp"

namespace penumbra::opengl {

/// Programs by their text. References stay good for as long as the cache.
class ProgramCache {
  public:
    const Program& get(const Source& vertex, const Source& fragment) {
        return find(text(vertex) + text(fragment), [&] { return Program(vertex, fragment); });
    }
    const Program& full_screen(const Source& fragment) {
        return find(text(fragment), [&] { return Program::full_screen(fragment); });
    }
    const Program& compute(const Source& source) {
        return find(text(source), [&] { return Program(source); });
    }

  private:
    static std::string text(const Source& source) {
        std::string result;
        for (const std::string& option : source.options) result += option + "\n";
        for (const std::string_view part : source.texts) result += part;
        return result;
    }
    template <class Make>
    const Program& find(const std::string& key, Make&& make) {
        const auto [at, is_new] = programs_.try_emplace(key);
        if (is_new) at->second = make();
        return at->second;
    }

    std::unordered_map<std::string, Program> programs_;
};

}  // namespace penumbra::opengl
