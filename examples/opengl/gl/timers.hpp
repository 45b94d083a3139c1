// GPU time of named passes, by timer queries.
#pragma once

#include <epoxy/gl.h>

#include <deque>
#include <string>
#include <vector>

namespace penumbra::opengl {

/// Passes in the order of their first use. Passes do not nest; one that runs several times in a frame adds up.
class Timers {
  public:
    struct Pass {
        std::string name;
        std::deque<float> milliseconds;  ///< one a frame, the latest last, at most `history`
    };
    static constexpr std::size_t history = 120;

    Timers() = default;
    ~Timers();
    Timers(const Timers&) = delete;
    Timers& operator=(const Timers&) = delete;

    /// Times what is drawn in its life.
    class Scope {
      public:
        Scope(Timers& timers, const char* pass) : timers_(timers) { timers_.begin(pass); }
        ~Scope() { timers_.end(); }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        Timers& timers_;
    };

    /// Collects what frames before have taken, as far as the GPU has got; all of it, if it shall wait.
    void next_frame(bool wait = false);
    /// What is measured from now on is about something else.
    void clear();
    const std::vector<Pass>& passes() const { return passes_; }

  private:
    struct Query {
        GLuint name;
        std::size_t pass;
    };
    void begin(const char* pass);
    void end();

    std::vector<Pass> passes_;
    std::vector<Query> current_;
    std::deque<std::vector<Query>> frames_;
    std::vector<GLuint> unused_;
};

}  // namespace penumbra::opengl
