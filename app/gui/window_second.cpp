// The participant's window: its monitor, its letters, and how it never comes between the
// experimenter and their own window.

#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/gui/window_state.h"
#include "app/language/words.h"
#include "core/error.h"

namespace jnd::app::gui {
namespace {

// The size of a window beside ours, and the least room for it.
constexpr int kBesideWidth = 960;
constexpr int kBesideHeight = 640;
constexpr int kLeastBesideWidth = 400;
constexpr int kLeastBesideHeight = 240;
// The size of a window's frame and title, if the system does not tell it.
constexpr int kAroundWindow = 40;

constexpr double kBetweenLooksS = 0.5;

/// The fonts that the participant's screen uses.
constexpr Font kLettersOfSecond[] = {Font::kHuge, Font::kTitle, Font::kAnswer, Font::kLarge,
                                     Font::kBody};

std::vector<Monitor> plugged_in() {
  int count = 0;
  GLFWmonitor** all = glfwGetMonitors(&count);
  std::vector<Monitor> monitors;
  for (int i = 0; i < count; ++i) {
    Monitor monitor;
    const char* name = glfwGetMonitorName(all[i]);
    const GLFWvidmode* mode = glfwGetVideoMode(all[i]);
    if (mode == nullptr) continue;
    monitor.name = name == nullptr ? "" : name;
    monitor.width_px = mode->width;
    monitor.height_px = mode->height;
    glfwGetMonitorPos(all[i], &monitor.x_px, &monitor.y_px);
    monitors.push_back(monitor);
  }
  return monitors;
}

ScreenArea place_of(GLFWwindow* window) {
  ScreenArea place;
  glfwGetWindowPos(window, &place.x, &place.y);
  glfwGetWindowSize(window, &place.width, &place.height);
  return place;
}

}  // namespace

void Window::Implementation::look_at_monitors() {
  const double now_s = glfwGetTime();
  if (looked_at_monitors_s >= 0.0 && now_s - looked_at_monitors_s < kBetweenLooksS) return;
  looked_at_monitors_s = now_s;
  monitors = told_monitors_file.empty() ? plugged_in() : told_monitors(told_monitors_file);
  const ScreenArea ours = place_of(main);
  for (Monitor& monitor : monitors) {
    const ScreenArea area{monitor.x_px, monitor.y_px, monitor.width_px, monitor.height_px};
    monitor.has_window = area.contains(ours.x + ours.width / 2, ours.y + ours.height / 2);
  }
}

ScreenArea Window::Implementation::area_beside() const {
  const ScreenArea ours = place_of(main);
  GLFWmonitor* primary = glfwGetPrimaryMonitor();
  if (primary == nullptr) return {};
  ScreenArea whole = area_of(primary);
  for (const Monitor& monitor : monitors) {
    if (!monitor.has_window || told_monitors_file.empty()) continue;
    whole = {monitor.x_px, monitor.y_px, monitor.width_px, monitor.height_px};
  }
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
  glfwGetWindowFrameSize(main, &left, &top, &right, &bottom);
  const int around = top > 0 ? top : kAroundWindow;
  const int end = ours.x + ours.width + right;
  const int foot = ours.y + ours.height + bottom;
  const ScreenArea free[] = {
      {end, whole.y + around, whole.x + whole.width - end, whole.height - around},
      {whole.x, whole.y + around, ours.x - left - whole.x, whole.height - around},
      {whole.x, foot + around, whole.width, whole.y + whole.height - foot - around},
      {whole.x, whole.y + around, whole.width, ours.y - top - whole.y - around}};
  ScreenArea best;
  for (ScreenArea area : free) {
    area.width = std::min(area.width, kBesideWidth);
    area.height = std::min(area.height, kBesideHeight);
    if (area.width < kLeastBesideWidth || area.height < kLeastBesideHeight) continue;
    if (area.width * area.height > best.width * best.height) best = area;
  }
  return best;
}

void Window::Implementation::make_second(const std::string& title,
                                         const std::string& monitor_name) {
  const auto monitor = std::ranges::find(monitors, monitor_name, &Monitor::name);
  const bool fills = !monitor_name.empty();
  // The monitor was unplugged at this moment.
  if (fills && monitor == monitors.end()) return;
  ScreenArea area =
      fills ? ScreenArea{monitor->x_px, monitor->y_px, monitor->width_px, monitor->height_px}
            : area_beside();
  const bool has_place = area.width > 0;
  if (!has_place) area = {0, 0, kBesideWidth, kBesideHeight};
  // The keyboard stays with the experimenter. The window has the monitor's size but does not
  // take the monitor over, so the monitor keeps its mode, and the window is not iconified when
  // it loses the focus.
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_FOCUSED, GLFW_FALSE);
  glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
  glfwWindowHint(GLFW_FLOATING, GLFW_FALSE);
  glfwWindowHint(GLFW_DECORATED, fills ? GLFW_FALSE : GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "jnd");
  second = glfwCreateWindow(area.width, area.height, title.c_str(), nullptr, main);
  glfwDefaultWindowHints();
  if (second == nullptr) {
    throw core::Error(tr("the participant's window cannot be opened: {}", last_glfw_error()));
  }
  second_monitor = fills ? monitor_name : "";
  if (has_place) glfwSetWindowPos(second, area.x, area.y);
  glfwMakeContextCurrent(second);
  glfwSwapInterval(0);
  glfwMakeContextCurrent(main);
  second_context = ImGui::CreateContext();
  ImGui::SetCurrentContext(second_context);
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  load_second_fonts(scale_from_afar(area.width, area.height));
  // A `Ui` draws into the context in which it was made.
  ImGui::SetCurrentContext(second_context);
  second_ui = std::make_unique<Ui>(second_theme);
  ImGui::SetCurrentContext(context);
  install_callbacks(second, false);
  glfwShowWindow(second);
  // Without room beside our window, the new one would cover it.
  if (!has_place) glfwFocusWindow(main);
}

void Window::Implementation::load_second_fonts(float scale) {
  // The heartbeat goes on, because the window does not hang while letters are made.
  if (window.on_iteration) window.on_iteration();
  ImGui::SetCurrentContext(second_context);
  second_theme.set_scale(scale);
  second_theme.load_fonts(kLettersOfSecond);
  if (window.on_iteration) window.on_iteration();
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  unsigned char* pixels = nullptr;
  int width = 0;
  int height = 0;
  atlas.GetTexDataAsRGBA32(&pixels, &width, &height);
  if (second_letters == 0) glGenTextures(1, &second_letters);
  glBindTexture(GL_TEXTURE_2D, second_letters);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  atlas.SetTexID(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(second_letters)));
  atlas.ClearTexData();
  ImGui::SetCurrentContext(context);
  if (window.on_iteration) window.on_iteration();
}

void Window::Implementation::keep_second_on_monitor() {
  if (second_monitor.empty()) return;
  const auto monitor = std::ranges::find(monitors, second_monitor, &Monitor::name);
  // The caller that asked for the monitor watches it, too, and closes this window.
  if (monitor == monitors.end()) return;
  const ScreenArea now = place_of(second);
  if (now.width != monitor->width_px || now.height != monitor->height_px) {
    glfwSetWindowSize(second, monitor->width_px, monitor->height_px);
  }
  if (now.x != monitor->x_px || now.y != monitor->y_px) {
    glfwSetWindowPos(second, monitor->x_px, monitor->y_px);
  }
}

bool Window::Implementation::prepare_second() {
  if (second == nullptr || second_is_unwanted) return false;
  look_at_monitors();
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(second, &width, &height);
  // The window is iconified.
  if (width <= 0 || height <= 0) return false;
  if (width != second_width_px || height != second_height_px) {
    second_resized_s = glfwGetTime();
    second_width_px = width;
    second_height_px = height;
  }
  // Letters of a new size take a while to make. They are not made for each of many quick steps.
  constexpr double kStepsInARowS = 0.12;
  const float scale = scale_from_afar(width, height);
  if (scale != second_theme.scale() && glfwGetTime() - second_resized_s < kStepsInARowS) {
    frames_left = std::max(frames_left, 2);
  } else if (scale != second_theme.scale()) {
    load_second_fonts(scale);
  }
  second_theme.set_dark(theme.dark());
  return true;
}

void Window::Implementation::draw_second() {
  second_ui->begin_frame(no_input);
  second_frame(*second_ui);
  widget_log.keep_texts(second_ui->end_frame());
  ImDrawData* data = ImGui::GetDrawData();
  glfwMakeContextCurrent(second);
  // The first context's renderer draws both windows, which share what it made.
  ImGui::SetCurrentContext(context);
  clear();
  ImGui_ImplOpenGL3_RenderDrawData(data);
  glfwSwapBuffers(second);
  glfwMakeContextCurrent(main);
}

void Window::Implementation::close_second() {
  if (second == nullptr) return;
  second_ui.reset();
  ImGui::DestroyContext(std::exchange(second_context, nullptr));
  glfwDestroyWindow(std::exchange(second, nullptr));
  ImGui::SetCurrentContext(context);
  glfwMakeContextCurrent(main);
  if (second_letters != 0) glDeleteTextures(1, &second_letters);
  second_letters = 0;
  second_width_px = second_height_px = 0;
  second_close_is_wanted = false;
}

const std::vector<Monitor>& Window::monitors() {
  my_->look_at_monitors();
  return my_->monitors;
}

void Window::open_second(const std::string& title, Frame frame, const std::string& monitor) {
  Implementation& my = *my_;
  my.second_frame = std::move(frame);
  my.second_is_unwanted = false;
  if (my.second != nullptr && my.second_monitor == monitor) {
    return my.keep_second_on_monitor();
  }
  my.close_second();
  my.look_at_monitors();
  my.make_second(title, monitor);
  my.something_happened(false);
}

void Window::close_second() { my_->second_is_unwanted = my_->second != nullptr; }

bool Window::second_close_requested() noexcept {
  return std::exchange(my_->second_close_is_wanted, false);
}

bool Window::second_is_open() const noexcept { return my_->second != nullptr; }

}  // namespace jnd::app::gui
