#include "window.hpp"

// keeps GLFW from including a loader of its own
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>

#include "../../pictures/picture.hpp"
#include "../viewer.hpp"
#include "light_edit.hpp"
#include "orbit.hpp"
#include "panel.hpp"

namespace penumbra::opengl {
namespace {

/// GLFW, its window with a current context, and Dear ImGui on it.
class Window {
  public:
    Window(glm::ivec2 size, const std::string& version) {
        if (glfwInit() != GLFW_TRUE) throw std::runtime_error("there is no display to open a window on");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, version[0] - '0');
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, version[2] - '0');
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
        window_ = glfwCreateWindow(size.x, size.y, "penumbra", nullptr, nullptr);
        if (window_ == nullptr) {
            glfwTerminate();
            throw std::runtime_error("no window with OpenGL " + version + " (try --gl 3.3)");
        }
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui_ImplGlfw_InitForOpenGL(window_, true);
        ImGui_ImplOpenGL3_Init("#version 330 core");
    }
    ~Window() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
        glfwDestroyWindow(window_);
        glfwTerminate();
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* get() const { return window_; }
    /// 0 × 0 while it is minimised.
    glm::ivec2 size() const {
        glm::ivec2 size;
        glfwGetFramebufferSize(window_, &size.x, &size.y);
        return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE ? glm::ivec2(0, 0) : size;
    }

  private:
    GLFWwindow* window_;
};

/// A key of the keyboard, which does something once when it goes down.
class Key {
  public:
    explicit Key(int key) : key_(key) {}
    bool goes_down(GLFWwindow* window) {
        const bool was_down = std::exchange(is_down_, glfwGetKey(window, key_) == GLFW_PRESS);
        return is_down_ && !was_down && !ImGui::GetIO().WantCaptureKeyboard;
    }

  private:
    int key_;
    bool is_down_ = false;
};

/// The mouse on the picture: camera and light.
void move_by_mouse(Viewer& viewer, Orbit& orbit, glm::ivec2 size) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse) return;
    const glm::vec2 drag = glm::vec2(io.MouseDelta.x, -io.MouseDelta.y) / static_cast<float>(size.x);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
        const float unit = 1.5F * orbit.distance();
        const Vec3<float> level = orbit.right() * drag.x + orbit.ahead() * drag.y;
        const Vec3<float> by = io.KeyShift ? Vec3<float>(0.0F, drag.y, 0.0F) : level;
        if (by != Vec3<float>(0.0F, 0.0F, 0.0F)) viewer.set_light(moved(viewer.scene().light, by * unit));
        if (io.MouseWheel != 0.0F)
            viewer.set_light(scenes::scaled(viewer.scene().light, std::exp(0.1F * io.MouseWheel)));
        return;
    }
    const bool is_dragged = ImGui::IsMouseDown(ImGuiMouseButton_Left) && drag != glm::vec2(0.0F);
    if (is_dragged && io.KeyShift) orbit.pan(-drag);
    if (is_dragged && !io.KeyShift) orbit.turn(drag * -4.0F);
    if (io.MouseWheel != 0.0F) orbit.zoom(std::exp(-0.1F * io.MouseWheel));
    if (is_dragged || io.MouseWheel != 0.0F) viewer.set_camera(orbit.camera());
}

/// What tests do with the window: everything that a hand does, at random but the same each time.
class Exercise {
  public:
    void step(Viewer& viewer, Orbit& orbit, GLFWwindow* window, int frame) {
        const int sizes[][2] = {{1, 1}, {640, 480}, {333, 7}, {5, 300}, {320, 240}};
        if (frame % 8 == 4) glfwSetWindowSize(window, sizes[frame / 8 % 5][0], sizes[frame / 8 % 5][1]);
        if (frame % 16 == 9) glfwIconifyWindow(window);
        if (frame % 16 == 11) glfwRestoreWindow(window);
        if (frame % 8 == 1) {
            const std::vector<Knob> knobs = viewer.knobs();
            const Knob& knob = knobs[random_() % knobs.size()];
            if (!knob.names.empty()) knob.set(static_cast<double>(random_() % knob.names.size()));
            viewer.knob_changed();
        }
        if (frame % 8 == 2) viewer.set_method(method_names()[random_() % method_names().size()]);
        if (frame % 8 == 3) viewer.set_light(moved(viewer.scene().light, Vec3<float>(0.05F, -0.02F, 0.03F)));
        if (frame % 8 == 5) viewer.show.picture = static_cast<Picture>(random_() % 3);
        if (frame % 8 == 6) viewer.show.split = 0.25F * static_cast<float>(random_() % 5);
        orbit.turn({0.02F, 0.0F});
        viewer.set_camera(orbit.camera());
    }

  private:
    std::minstd_rand random_{1};
};

void save(const Image<pictures::Rgb>& picture, const std::string& file) {
    pictures::write_png(file, picture);
    std::printf("%s\n", file.c_str());
}

/// What is about to be seen, with the panel.
Image<pictures::Rgb> picture_of_window(glm::ivec2 size) {
    Image<pictures::Rgb> rows(size.x, size.y), picture(size.x, size.y);
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    for (int y = 0; y < size.y; ++y) std::copy_n(rows.row(size.y - 1 - y), size.x, picture.row(y));
    return picture;
}

}  // namespace

void run_window(const Arguments& arguments) {
    const scenes::Scene scene = wanted_scene(arguments);
    Window window(arguments.size, arguments.gl);
    const std::vector<std::string>& complaints = collect_complaints();
    const Capabilities can = capabilities(arguments.gl);
    Viewer viewer(scene, arguments.method.empty() ? methods_for(scene.light, can).front() : arguments.method, can,
                  !arguments.ordinary_depth);
    for (const std::string& knob : arguments.knobs) viewer.set_knob(knob);
    if (arguments.plan >= 0.0F) viewer.plan(arguments.plan);
    viewer.show.picture = arguments.picture;
    viewer.show.split = arguments.split;
    Orbit orbit(scene.camera);
    Exercise exercise;
    Key space(GLFW_KEY_SPACE), s(GLFW_KEY_S);
    bool is_paused = false;
    int screenshots = 0;

    glfwSetWindowUserPointer(window.get(), &viewer);
    glfwSetDropCallback(window.get(), [](GLFWwindow* at, int count, const char** files) {
        if (count < 1) return;
        try {
            static_cast<Viewer*>(glfwGetWindowUserPointer(at))->set_scene(scenes::load_scene(files[0]));
        } catch (const std::exception& error) {  // C code calls this
            std::fprintf(stderr, "opengl_example: %s\n", error.what());
        }
    });
    for (int frame = 0; !glfwWindowShouldClose(window.get()); ++frame) {
        if (arguments.frames > 0 && frame >= arguments.frames) break;
        glfwPollEvents();
        if (arguments.exercise) exercise.step(viewer, orbit, window.get(), frame);
        const glm::ivec2 size = window.size();
        if (size.x < 1 || size.y < 1) {  // minimised: nothing to draw
            glfwWaitEventsTimeout(0.02);
            continue;
        }
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        move_by_mouse(viewer, orbit, size);
        const Pressed pressed = draw_panel(viewer, is_paused);
        if (pressed.camera) orbit = Orbit(viewer.scene().camera);
        is_paused ^= space.goes_down(window.get()) || pressed.pause;
        viewer.resize(size);
        if (!is_paused || viewer.picture().empty()) viewer.draw_frame();
        if (s.goes_down(window.get()) || pressed.screenshot)
            save(viewer.screenshot(), fmt::format("penumbra-{}.png", ++screenshots));
        viewer.show_in_window(size);
        ImGui::Render();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        if (frame + 1 == arguments.frames && !arguments.out.empty()) save(picture_of_window(size), arguments.out);
        glfwSwapBuffers(window.get());
    }
    if (!complaints.empty()) throw std::runtime_error("the driver complains: " + complaints.front());
}

}  // namespace penumbra::opengl
