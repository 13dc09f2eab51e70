#include "app/gui/window.h"

#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "app/gui/window_state.h"
#include "core/error.h"

namespace jnd::app::gui {
namespace {

constexpr double kFrameIntervalS = 1.0 / 30;
constexpr double kIterationIntervalS = 0.05;
constexpr double kIdleIntervalS = 1.0;
// Some changes show one frame later: a highlight under the mouse, a closed dialog, a field that
// gets the keyboard.
constexpr int kFramesAfterEvent = 3;

}  // namespace

void Window::Implementation::prepare_fonts() {
  float monitor_scale = 1.0f;
  glfwGetWindowContentScale(main, &monitor_scale, nullptr);
  // Letters of a new size take a tenth of a second to make. They are not made for each of many
  // quick steps.
  constexpr double kStepsInARowS = 0.12;
  if (has_renderer && glfwGetTime() - zoomed_s < kStepsInARowS) {
    frames_left = std::max(frames_left, 2);
    return;
  }
  int width = 0, height = 0;
  glfwGetFramebufferSize(main, &width, &height);
  theme.set_scale(scale_with_room(monitor_scale * zoom, static_cast<float>(width),
                                  static_cast<float>(height)));
  if (!theme.fonts_are_stale()) return;
  // The heartbeat goes on, because the window does not hang while letters are made.
  if (window.on_iteration) window.on_iteration();
  ImGui::SetCurrentContext(context);
  if (has_renderer) ImGui_ImplOpenGL3_DestroyFontsTexture();
  theme.load_fonts();
  if (!has_renderer) return;
  ImGui_ImplOpenGL3_CreateFontsTexture();
  sharpen_letters();
  if (window.on_iteration) window.on_iteration();
}

void Window::Implementation::sharpen_letters() {
  // Letters are on whole pixels, so no blending is needed. Without blending, a processor that
  // draws takes a third less time.
  const auto texture = reinterpret_cast<std::uintptr_t>(ImGui::GetIO().Fonts->TexID);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(texture));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void Window::Implementation::draw(const Frame& frame) {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(main, &width, &height);
  if (width <= 0 || height <= 0) return;  // The window is iconified.
  prepare_fonts();
  const double now_s = glfwGetTime();
  const auto passed_s = static_cast<float>(std::max(now_s - last_frame_s, 1e-4));
  last_frame_s = now_s;

  const auto set_up = [&](ImGuiContext* its_context, int its_width, int its_height) {
    ImGui::SetCurrentContext(its_context);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(its_width), static_cast<float>(its_height));
    io.DeltaTime = passed_s;
  };
  frame_times.begin_frame();
  set_up(context, width, height);
  ImGui_ImplOpenGL3_NewFrame();
  ui->begin_frame(queue);
  frame(*ui);
  const Drawn& drawn = ui->end_frame();
  frame_times.end(FrameTimes::Part::kDraw);
  show_cursor();
  clear();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (frame_times.wanted()) glFinish();
  frame_times.end(FrameTimes::Part::kRender);
  glfwSwapBuffers(main);
  frame_times.end(FrameTimes::Part::kShow);
  frame_times.end_frame(drawn.view);
  widget_log.write(drawn, theme.scale());

  if (!prepare_second()) return;
  set_up(second_context, second_width_px, second_height_px);
  draw_second();
}

void Window::Implementation::clear() const {
  const std::uint32_t ground = theme.rgb(Colour::kGround);
  const auto channel = [&](int shift) {
    return static_cast<float>(ground >> shift & 0xff) / 255.0f;
  };
  glClearColor(channel(16), channel(8), channel(0), 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
}

void Window::Implementation::show_cursor() {
  const int wanted = ImGui::GetMouseCursor();
  if (wanted == shown_cursor) return;
  shown_cursor = wanted;
  glfwSetCursor(main, wanted == ImGuiMouseCursor_TextInput ? text_cursor
                      : wanted == ImGuiMouseCursor_Hand    ? hand_cursor
                                                           : nullptr);
}

void Window::Implementation::something_happened(bool urgent) {
  frames_left = kFramesAfterEvent;
  is_urgent |= urgent;
}

double Window::Implementation::next_frame_s(double now_s) const {
  if (frames_left <= 0 && !frames_are_wanted) return now_s + kIdleIntervalS;
  return is_urgent ? now_s : std::max(now_s, last_frame_s + kFrameIntervalS);
}

void Window::Implementation::wait(double now_s) const {
  double timeout_s = next_frame_s(now_s) - now_s;
  if (iterations_are_wanted) timeout_s = std::min(timeout_s, kIterationIntervalS);
  if (timeout_s > 0) {
    glfwWaitEventsTimeout(timeout_s);
  } else {
    glfwPollEvents();
  }
}

Window::Window(const WindowSettings& settings) : my_(std::make_unique<Implementation>(*this)) {
  my_->open(settings);
}

Window::~Window() = default;

void Window::run(const Frame& frame) {
  Implementation& my = *my_;
  my.is_closed = false;
  my.something_happened(true);
  while (!my.is_closed) {
    if (on_iteration) on_iteration();
    if (std::exchange(my.second_is_unwanted, false)) my.close_second();
    if (my.is_woken.exchange(false)) my.frames_left = std::max(my.frames_left, 2);
    if (my.frames_are_wanted) my.frames_left = std::max(my.frames_left, 1);
    const double now_s = glfwGetTime();
    if (my.frames_left > 0 && my.next_frame_s(now_s) <= now_s) {
      --my.frames_left;
      my.is_urgent = false;
      my.draw(frame);
      if (my.ui->wants_another_frame()) {
        my.frames_left = std::max(my.frames_left, 1);
        my.is_urgent = true;
      }
    }
    if (!my.is_closed) my.wait(glfwGetTime());
  }
}

void Window::close() noexcept { my_->is_closed = true; }

bool Window::close_requested() noexcept { return std::exchange(my_->close_is_wanted, false); }

/// On X11 a window that another desktop hides is not visible either.
bool Window::is_in_sight() const noexcept {
  return my_->main != nullptr && glfwGetWindowAttrib(my_->main, GLFW_ICONIFIED) == GLFW_FALSE &&
         glfwGetWindowAttrib(my_->main, GLFW_VISIBLE) == GLFW_TRUE;
}

void Window::wake() noexcept {
  my_->is_woken = true;
  glfwPostEmptyEvent();
}

void Window::wants_frames(bool wanted) noexcept { my_->frames_are_wanted = wanted; }

void Window::wants_iterations(bool wanted) noexcept { my_->iterations_are_wanted = wanted; }

Theme& Window::theme() noexcept { return my_->theme; }

float Window::zoom() const noexcept { return my_->zoom; }

void Window::set_zoom(float zoom) {
  const float wanted = std::isfinite(zoom) ? std::clamp(zoom, 0.5f, 2.0f) : 1.0f;
  if (std::exchange(my_->zoom, wanted) == wanted) return;
  my_->zoomed_s = glfwGetTime();
  my_->something_happened(false);
}

}  // namespace jnd::app::gui
