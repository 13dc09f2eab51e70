#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "app/gui/window_state.h"
#include "core/error.h"

namespace jnd::app::gui {
namespace {

// A share of the work area, so that the window's frame and title fit, too.
constexpr float kMostOfMonitor = 0.96f;

std::atomic<bool> is_open = false;

/// Xlib ends the program when the display is lost. Other threads may then be in the middle of a
/// session, so nothing that they use may be destroyed. What matters is on disk already.
void end_at_once_while_open() {
  if (!is_open) return;
  std::fputs(
      "jnd: the display was lost; every answer is on disk, and a session under way can be "
      "resumed\n",
      stderr);
  constexpr int kEnvironmentLacks = 3;
  std::_Exit(kEnvironmentLacks);
}

/// An invisible window, which has a context.
class HiddenWindow final : public SharedContext {
 public:
  explicit HiddenWindow(GLFWwindow* window) : window_(window) {}
  ~HiddenWindow() override { glfwDestroyWindow(window_); }
  HiddenWindow(const HiddenWindow&) = delete;
  HiddenWindow& operator=(const HiddenWindow&) = delete;
  void make_current() override { glfwMakeContextCurrent(window_); }
  void let_go() override { glfwMakeContextCurrent(nullptr); }

 private:
  GLFWwindow* window_;
};

int pixels(float logical, float scale) {
  return static_cast<int>(std::lround(logical * scale));
}

}  // namespace

Glfw::Glfw() {
  // Otherwise a software renderer would take every core, including the one that the haptic loop
  // needs.
  ::setenv("LP_NUM_THREADS", "1", 0);
  if (glfwInit() == GLFW_TRUE) return;
  const std::string display = environment("DISPLAY");
  throw core::Error("no display was found: expected DISPLAY to name an X server, found " +
                    (display.empty() ? "it unset" : "\"" + display + "\"") +
                    "; start jnd on a desktop, or use its commands (jnd --help)");
}

Glfw::~Glfw() { glfwTerminate(); }

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string last_glfw_error() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description == nullptr ? "no reason given" : description;
}

ScreenArea area_of(GLFWmonitor* monitor) {
  ScreenArea area;
  glfwGetMonitorWorkarea(monitor, &area.x, &area.y, &area.width, &area.height);
  return area;
}

void Window::Implementation::open(const WindowSettings& settings) {
  widget_log = WidgetLog(environment("JND_WIDGETS"));
  frame_times = FrameTimes(environment("JND_FRAME_TIMES"));
  told_monitors_file = environment("JND_MONITORS");
  zoom = settings.zoom;
  theme.set_dark(settings.dark);
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) {
    throw core::Error(
        "no display was found: expected a monitor, found an X server without any; "
        "connect one, or use the commands of jnd (jnd --help)");
  }
  float scale = 1.0f;
  glfwGetMonitorContentScale(monitor, &scale, nullptr);
  const ScreenArea area = area_of(monitor);
  const auto fitting = [&](float wanted, int most) {
    const bool is_larger = pixels(wanted, scale) > most;
    return is_larger ? pixels(kMostOfMonitor, static_cast<float>(most)) : pixels(wanted, scale);
  };
  // No profile and no version are asked for, because others who draw into our context may need
  // the old functions.
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "jnd");
  main = glfwCreateWindow(fitting(settings.width, area.width),
                          fitting(settings.height, area.height), settings.title.c_str(),
                          nullptr, nullptr);
  if (main == nullptr) {
    throw core::Error("the window cannot be opened: expected OpenGL 3 or newer, found none (" +
                      last_glfw_error() + "); install libgl1-mesa-dri or a graphics driver");
  }
  glfwMakeContextCurrent(main);
  // Functions run at exit in reverse order, so this one runs before those that the libraries
  // have registered.
  if (!is_open.exchange(true)) std::atexit(end_at_once_while_open);
  // While the window is hidden, waiting for the monitor could stop the heartbeat.
  glfwSwapInterval(0);
  glfwSetWindowSizeLimits(main, std::min(pixels(kLeastWidth, scale), area.width),
                          std::min(pixels(kLeastHeight, scale), area.height), GLFW_DONT_CARE,
                          GLFW_DONT_CARE);

  context = ImGui::CreateContext();
  prepare_fonts();
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = main;
  io.SetClipboardTextFn = [](void* to, const char* text) {
    glfwSetClipboardString(static_cast<GLFWwindow*>(to), text);
  };
  io.GetClipboardTextFn = [](void* from) {
    return glfwGetClipboardString(static_cast<GLFWwindow*>(from));
  };
  has_renderer = ImGui_ImplOpenGL3_Init("#version 130");
  if (!has_renderer) {
    throw core::Error(
        "the window cannot be opened: expected OpenGL 3 or newer, found an older "
        "one; install libgl1-mesa-dri or a graphics driver");
  }
  ImGui_ImplOpenGL3_CreateDeviceObjects();
  sharpen_letters();
  ui = std::make_unique<Ui>(theme);
  text_cursor = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
  hand_cursor = glfwCreateStandardCursor(GLFW_HAND_CURSOR);
  install_callbacks(main, true);
  glfwShowWindow(main);
}

std::unique_ptr<SharedContext> Window::make_shared_context() {
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_FOCUSED, GLFW_FALSE);
  GLFWwindow* hidden = glfwCreateWindow(16, 16, "jnd: pictures", nullptr, my_->main);
  glfwDefaultWindowHints();
  if (hidden == nullptr) {
    throw core::Error("3D view: expected a second OpenGL context, found " + last_glfw_error());
  }
  return std::make_unique<HiddenWindow>(hidden);
}

Window::Implementation::~Implementation() {
  is_open = false;
  if (main == nullptr) return;
  if (context != nullptr) {
    close_second();
    ui.reset();
    if (has_renderer) ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(context);
  }
  if (text_cursor != nullptr) glfwDestroyCursor(text_cursor);
  if (hand_cursor != nullptr) glfwDestroyCursor(hand_cursor);
  glfwDestroyWindow(main);
}

}  // namespace jnd::app::gui
