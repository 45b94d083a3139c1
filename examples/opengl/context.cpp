#include "context.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <stdexcept>

namespace penumbra::opengl {

struct HeadlessContext::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
};

namespace {

/// Displays that need no window system, best first: a GPU's own device, then Mesa's software driver.
std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> all;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
        EGLDeviceEXT devices[16];
        EGLint count = 0;
        if (eglQueryDevicesEXT(16, devices, &count) == EGL_TRUE)
            for (EGLint i = 0; i < count; ++i)
                all.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        all.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    return all;
}

}  // namespace

HeadlessContext::HeadlessContext(const std::string& version) : egl_(std::make_unique<Egl>()) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 version[0] - '0',
                                 EGL_CONTEXT_MINOR_VERSION,
                                 version[2] - '0',
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 EGL_TRUE,
                                 EGL_NONE};
    for (const EGLDisplay display : displays()) {
        if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) continue;
        if (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE) {
            const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
            if (context != EGL_NO_CONTEXT &&
                eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) {
                *egl_ = {display, context};
                return;
            }
            if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        }
        eglTerminate(display);
    }
    throw std::runtime_error("no OpenGL " + version + " core context without a window: EGL finds no driver");
}

HeadlessContext::~HeadlessContext() {
    eglMakeCurrent(egl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(egl_->display, egl_->context);
}

Capabilities capabilities(const std::string& version) {
    Capabilities result;
    result.compute = version >= "4.3" && epoxy_gl_version() >= 43;
    result.reverse_depth = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control");
    return result;
}

const std::vector<std::string>& collect_complaints() {
    static std::vector<std::string> complaints;
    complaints.clear();
    if (epoxy_gl_version() < 43 && !epoxy_has_gl_extension("GL_KHR_debug")) return complaints;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(
        [](GLenum, GLenum, GLuint, GLenum severity, GLsizei length, const GLchar* message, const void*) {
            if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
            complaints.emplace_back(message, static_cast<std::size_t>(length));
        },
        nullptr);
    return complaints;
}

std::string driver_name() {
    const auto text = [](GLenum what) { return std::string(reinterpret_cast<const char*>(glGetString(what))); };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace penumbra::opengl
