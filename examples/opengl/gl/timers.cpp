#include "timers.hpp"

#include <algorithm>
#include <utility>

namespace penumbra::opengl {

Timers::~Timers() {
    clear();
    glDeleteQueries(static_cast<GLsizei>(unused_.size()), unused_.data());
}

void Timers::begin(const char* pass) {
    const auto at = std::find_if(passes_.begin(), passes_.end(), [&](const Pass& p) { return p.name == pass; });
    const auto number = static_cast<std::size_t>(at - passes_.begin());
    if (at == passes_.end()) passes_.push_back({pass, {}});
    if (unused_.empty()) {
        unused_.emplace_back();
        glGenQueries(1, &unused_.back());
    }
    current_.push_back({unused_.back(), number});
    unused_.pop_back();
    glBeginQuery(GL_TIME_ELAPSED, current_.back().name);
}

void Timers::end() { glEndQuery(GL_TIME_ELAPSED); }

void Timers::next_frame(bool wait) {
    if (!current_.empty()) frames_.push_back(std::exchange(current_, {}));
    while (!frames_.empty()) {
        GLuint ready = GL_FALSE;
        glGetQueryObjectuiv(frames_.front().back().name, GL_QUERY_RESULT_AVAILABLE, &ready);
        if (ready == GL_FALSE && !wait) return;
        std::vector<float> sums(passes_.size(), -1.0F);
        for (const Query& query : frames_.front()) {
            GLuint64 nanoseconds = 0;
            glGetQueryObjectui64v(query.name, GL_QUERY_RESULT, &nanoseconds);
            sums[query.pass] = std::max(sums[query.pass], 0.0F) + static_cast<float>(nanoseconds) * 1e-6F;
            unused_.push_back(query.name);
        }
        for (std::size_t i = 0; i < passes_.size(); ++i) {
            if (sums[i] < 0.0F) continue;  // did not run
            passes_[i].milliseconds.push_back(sums[i]);
            if (passes_[i].milliseconds.size() > history) passes_[i].milliseconds.pop_front();
        }
        frames_.pop_front();
    }
}

void Timers::clear() {
    for (const std::vector<Query>& frame : frames_)
        for (const Query& query : frame) unused_.push_back(query.name);
    for (const Query& query : current_) unused_.push_back(query.name);
    frames_.clear();
    current_.clear();
    passes_.clear();
}

}  // namespace penumbra::opengl
