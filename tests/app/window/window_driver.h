#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/window/screen.h"
#include "app/window/virtual_display.h"
#include "support/program.h"

namespace jnd::app {

/// A person before the window: sees what it shows, uses keyboard and mouse as they are, by
/// xdotool. Whatever is waited for and does not come is a `std::runtime_error` that says what
/// stands there instead, with a picture of it.
class WindowDriver {
 public:
  enum class Hand { kKeyboard, kMouse };

  /// `folder`: of the person, empty at first: the program's home and what it tells the test.
  WindowDriver(VirtualDisplay& display, std::filesystem::path folder);
  ~WindowDriver();
  WindowDriver(const WindowDriver&) = delete;
  WindowDriver& operator=(const WindowDriver&) = delete;

  /// Starts the program and waits for its window.
  void start(const std::vector<std::string>& arguments = {});
  /// SIGKILL.
  void kill();
  /// Waits until it ends by itself.
  [[nodiscard]] test_support::ProgramOutcome wait_for_exit();
  /// The running program's number, as the system counts.
  [[nodiscard]] pid_t process() const noexcept { return program_->process(); }
  /// Where the program finds its studies; its own else.
  std::filesystem::path share;
  /// The program's environment but for the display.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> environment() const;

  // Seeing.
  [[nodiscard]] Screen screen() const;
  using Condition = std::function<bool(const Screen&)>;
  Screen wait_until(const std::string& what, const Condition& condition) const;
  /// Until the widget can be used.
  Screen wait_for(const std::string& widget) const;
  Screen wait_for_text(const std::string& part) const;
  Screen wait_for_view(const std::string& view) const;
  /// Every text that any frame of any window of any run showed, one a line.
  [[nodiscard]] std::string every_text() const;
  /// Saves what a window looks like.
  void picture(const std::filesystem::path& file, const std::string& title = "jnd") const;
  [[nodiscard]] bool has_window(const std::string& title) const;
  /// By its pixels: dark letters on light, or the other way round.
  [[nodiscard]] bool is_dark() const;

  // Doing. Words are those of xdotool: "y", "ctrl+z", "Return".
  void press(const std::string& key) const { press_at_once({key}); }
  /// One right after the other, several in a frame.
  void press_at_once(std::initializer_list<std::string> keys) const;
  void hold(const std::string& key, std::chrono::milliseconds duration) const;
  /// ASCII.
  void type(const std::string& text) const;
  void click(const std::string& widget) const;
  void hold_button(const std::string& widget, std::chrono::milliseconds duration) const;
  /// Uses a widget once it can be: by the key that is printed on it or by the mouse.
  void use(const std::string& widget) const;
  Hand hand = Hand::kKeyboard;
  /// Strokes on the pad, to and fro, where the mouse moves the hand.
  void move_hand(int num_strokes) const;
  /// The close button of the window's frame.
  void press_close_button() const;
  void resize(int width_px, int height_px) const;
  /// Large windows drawn by a busy processor may stop for longer than the heartbeat allows;
  /// then the session is armed again and the trial felt once more.
  bool forgives_stalls = false;
  /// A test answers sooner than anybody would, and is asked whether it means it: it does.
  bool confirms_answers = true;

 private:
  void xdotool(std::vector<std::string> words) const;
  /// Its number on the display; "" if there is none.
  [[nodiscard]] std::string find_window(const std::string& title) const;
  [[nodiscard]] std::string window() const;  ///< The main one's.
  [[nodiscard]] std::string stands_there(const Screen& screen) const;

  VirtualDisplay& display_;
  std::filesystem::path folder_;
  std::unique_ptr<test_support::RunningProgram> program_;
  mutable std::string window_;
};

}  // namespace jnd::app
