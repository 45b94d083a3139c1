// An OpenGL context without a window, and what any context can do.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "methods/method.hpp"

namespace penumbra::opengl {

/// Current for as long as it lives. Through EGL, no window system; a debug context.
class HeadlessContext {
  public:
    /// Core profile, of the version asked for, "4.3" or "3.3", or a newer one. Throws std::runtime_error where there is
    /// none.
    explicit HeadlessContext(const std::string& version);
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

  private:
    struct Egl;
    std::unique_ptr<Egl> egl_;
};

/// Of the current context, no more than `version` allows.
Capabilities capabilities(const std::string& version);

/// Collects what the driver complains about from now on (KHR_debug), where it can; empty: no complaint.
const std::vector<std::string>& collect_complaints();

/// "Mesa llvmpipe (LLVM 15.0.6), OpenGL 4.5".
std::string driver_name();

}  // namespace penumbra::opengl
