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

/// Plays a person before the window, who reads what it shows and uses the keyboard and the
/// mouse through xdotool. If something does not appear in time, it throws a
/// `std::runtime_error` that says what is shown instead, and saves a picture.
class WindowDriver {
 public:
  enum class Hand { kKeyboard, kMouse };

  /// `folder` is empty at first. It becomes the program's home, and holds what the program
  /// reports to the test.
  WindowDriver(VirtualDisplay& display, std::filesystem::path folder);
  ~WindowDriver();
  WindowDriver(const WindowDriver&) = delete;
  WindowDriver& operator=(const WindowDriver&) = delete;

  /// Starts the program and waits for its window.
  void start(const std::vector<std::string>& arguments = {});
  /// Ends the program by SIGKILL.
  void kill();
  /// Waits until the program ends by itself.
  [[nodiscard]] test_support::ProgramOutcome wait_for_exit();
  /// Returns the running program's process number.
  [[nodiscard]] pid_t process() const noexcept { return program_->process(); }
  /// The folder in which the program finds its studies. If it is empty, the program uses its
  /// own.
  std::filesystem::path share;
  /// Returns the program's environment without the display.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> environment() const;

  // These functions see.
  [[nodiscard]] Screen screen() const;
  using Condition = std::function<bool(const Screen&)>;
  Screen wait_until(const std::string& what, const Condition& condition) const;
  /// Waits until the widget can be used.
  Screen wait_for(const std::string& widget) const;
  Screen wait_for_text(const std::string& part) const;
  Screen wait_for_view(const std::string& view) const;
  /// Returns every text that any frame of any window in any run showed, one in each line.
  [[nodiscard]] std::string every_text() const;
  /// Saves a picture of the window.
  void picture(const std::filesystem::path& file, const std::string& title = "jnd") const;
  [[nodiscard]] bool has_window(const std::string& title) const;
  /// Tells from a pixel whether the theme is dark.
  [[nodiscard]] bool is_dark() const;

  // These functions act. Keys are named as in xdotool: "y", "ctrl+z", "Return".
  void press(const std::string& key) const { press_at_once({key}); }
  /// Presses the keys one right after the other, so that several fall into one frame.
  void press_at_once(std::initializer_list<std::string> keys) const;
  void hold(const std::string& key, std::chrono::milliseconds duration) const;
  /// Types a text, which must be ASCII.
  void type(const std::string& text) const;
  void click(const std::string& widget) const;
  void hold_button(const std::string& widget, std::chrono::milliseconds duration) const;
  /// Uses a widget as soon as it can be used, by the key that is printed on it or by the mouse.
  void use(const std::string& widget) const;
  Hand hand = Hand::kKeyboard;
  /// Strokes to and fro on the pad, where the mouse moves the hand.
  void move_hand(int num_strokes) const;
  /// Presses the close button of the window's frame.
  void press_close_button() const;
  void resize(int width_px, int height_px) const;
  /// Large windows on a busy processor may stop for longer than the heartbeat allows. If this
  /// is set, the driver then arms again and repeats the trial.
  bool forgives_stalls = false;
  /// A test answers sooner than a person would, so the program asks whether the answer is
  /// meant. If this is set, the driver confirms it.
  bool confirms_answers = true;

 private:
  void xdotool(std::vector<std::string> words) const;
  /// Returns the window's number on the display, or "" if there is none.
  [[nodiscard]] std::string find_window(const std::string& title) const;
  [[nodiscard]] std::string window() const;  ///< The main window's number.
  [[nodiscard]] std::string stands_there(const Screen& screen) const;

  VirtualDisplay& display_;
  std::filesystem::path folder_;
  std::unique_ptr<test_support::RunningProgram> program_;
  mutable std::string window_;
};

}  // namespace jnd::app
