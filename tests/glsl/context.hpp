// An OpenGL context without a window, through EGL.
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <stdexcept>
#include <string>

namespace penumbra::test {

enum class Api { desktop, es };  ///< OpenGL 4.5 core, OpenGL ES 3.1

/// Makes a context current for as long as it lives. Throws where there is none: tests fail rather than skip.
class Context {
  public:
    explicit Context(Api api = Api::desktop) : api_(api) {
        display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        require(display_ != EGL_NO_DISPLAY && eglInitialize(display_, nullptr, nullptr), "no surfaceless EGL display");
        require(eglBindAPI(api == Api::es ? EGL_OPENGL_ES_API : EGL_OPENGL_API), "EGL does not know the API");
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, api == Api::es ? 3 : 4, EGL_CONTEXT_MINOR_VERSION,
                                     api == Api::es ? 1 : 5, EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        require(context_ != EGL_NO_CONTEXT, "no context");
        require(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_), "the context cannot be used");
    }
    ~Context() {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    Api api() const { return api_; }
    /// What a shader of this context begins with.
    std::string version(bool compute) const {
        if (api_ == Api::desktop) return compute ? "#version 430 core\n" : "#version 330 core\n";
        return std::string(compute ? "#version 310 es\n" : "#version 300 es\n") +
               "precision highp float; precision highp int; precision highp sampler2DArray;\n"
               "precision highp usampler2DArray;\n";
    }

  private:
    static void require(bool condition, const char* what) {
        if (!condition) throw std::runtime_error(std::string(what) + ", EGL error " + std::to_string(eglGetError()));
    }
    Api api_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace penumbra::test
