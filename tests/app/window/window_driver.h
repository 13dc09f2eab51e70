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

/// A person in front of the window, who sees what it shows and uses the real keyboard and
/// mouse, by xdotool. If something does not appear in time, it throws `std::runtime_error` that
/// says what is shown instead, and takes a picture.
class WindowDriver {
 public:
  enum class Hand { kKeyboard, kMouse };

  /// `folder` is the person's folder, which is empty at first: the program's home, and what the
  /// program tells the test.
  WindowDriver(VirtualDisplay& display, std::filesystem::path folder);
  ~WindowDriver();
  WindowDriver(const WindowDriver&) = delete;
  WindowDriver& operator=(const WindowDriver&) = delete;

  /// Starts the program and waits for its window.
  void start(const std::vector<std::string>& arguments = {});
  /// Sends SIGKILL.
  void kill();
  /// Waits until the program ends by itself.
  [[nodiscard]] test_support::ProgramOutcome wait_for_exit();
  /// Returns the process id of the running program.
  [[nodiscard]] pid_t process() const noexcept { return program_->process(); }
  /// Where the program finds its studies; if empty, its own folder.
  std::filesystem::path share;
  /// Returns the program's environment except for the display.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> environment() const;

  // Reading the screen.
  [[nodiscard]] Screen screen() const;
  using Condition = std::function<bool(const Screen&)>;
  Screen wait_until(const std::string& what, const Condition& condition) const;
  /// Waits until the widget can be used.
  Screen wait_for(const std::string& widget) const;
  Screen wait_for_text(const std::string& part) const;
  Screen wait_for_view(const std::string& view) const;
  /// Returns every text that any frame of any window of any run showed, one on each line.
  [[nodiscard]] std::string every_text() const;
  /// Saves a picture of a window.
  void picture(const std::filesystem::path& file, const std::string& title = "jnd") const;
  [[nodiscard]] bool has_window(const std::string& title) const;
  /// Judges by its pixels: dark letters on light, or the reverse.
  [[nodiscard]] bool is_dark() const;

  // Using keyboard and mouse. Keys are in the words of xdotool: "y", "ctrl+z", "Return".
  void press(const std::string& key) const { press_at_once({key}); }
  /// Presses keys right after one another, several in a frame.
  void press_at_once(std::initializer_list<std::string> keys) const;
  void hold(const std::string& key, std::chrono::milliseconds duration) const;
  /// The text is ASCII.
  void type(const std::string& text) const;
  void click(const std::string& widget) const;
  void hold_button(const std::string& widget, std::chrono::milliseconds duration) const;
  /// Uses a widget once it is enabled, by the key that is printed on it or by the mouse.
  void use(const std::string& widget) const;
  Hand hand = Hand::kKeyboard;
  /// Strokes on the pad, to and fro, if the mouse moves the hand.
  void move_hand(int num_strokes) const;
  /// Presses the close button of the window's frame.
  void press_close_button() const;
  void resize(int width_px, int height_px) const;
  /// If a busy processor draws a large window, it may stop for longer than the heartbeat
  /// allows. Then the session is armed again and the trial is felt once more.
  bool forgives_stalls = false;
  /// A test answers sooner than anybody would, so the program asks whether it is sure. It is.
  bool confirms_answers = true;

 private:
  void xdotool(std::vector<std::string> words) const;
  /// Returns its number on the display, or "" if there is none.
  [[nodiscard]] std::string find_window(const std::string& title) const;
  [[nodiscard]] std::string window() const;  ///< Returns the number of the main window.
  [[nodiscard]] std::string stands_there(const Screen& screen) const;

  VirtualDisplay& display_;
  std::filesystem::path folder_;
  std::unique_ptr<test_support::RunningProgram> program_;
  mutable std::string window_;
};

}  // namespace jnd::app
