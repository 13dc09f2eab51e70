#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/gui/application/application.h"
#include "app/gui/headless_ui.h"
#include "soak/frame_times.h"

namespace jnd::soak {

/// Somebody at a window without pixels, who goes through all of it again and again. It notes
/// what they look for and do not find: a soak that passes a view by proves nothing about it.
///
/// Each frame is a thirtieth of a second of the simulated day, as in a window that shows a
/// session; sessions take their time from the same clock. A frame is drawn as soon as the last
/// one is done, except while work beside the window is awaited.
class Person {
 public:
  struct Parameters {
    /// A folder with sessions, which is copied for each round.
    std::filesystem::path template_study;
    std::filesystem::path table;   ///< A table of answers, for the view of data.
    std::filesystem::path folder;  ///< The folder of the rounds' studies.
    /// Length of the simulated day; it decides which frames are the first and the last.
    double duration_s = 0.0;
    /// Simulated time at each view and page; a quarter of it for each act.
    double look_s = 0.0;
    /// Whether to print to stderr how long each part of a round took.
    bool tells = false;
  };
  explicit Person(Parameters parameters);

  /// Goes from the start through every view and a session, and back to the start.
  void go_round();

  /// The time of the simulated day.
  [[nodiscard]] double now_s() const noexcept { return clock_s_.load(); }
  /// The times that drawing a frame took, by view.
  [[nodiscard]] const std::map<std::string, FrameTimes>& frames() const noexcept {
    return frames_;
  }
  [[nodiscard]] std::size_t num_frames() const noexcept { return num_frames_; }
  [[nodiscard]] int num_sessions() const noexcept { return num_sessions_; }
  /// The time of the simulated day that was spent in sessions.
  [[nodiscard]] double in_sessions_s() const noexcept { return in_sessions_s_; }
  /// Returns what was looked for and not found, each once with its view.
  [[nodiscard]] const std::vector<std::string>& missed() const noexcept { return missed_; }

 private:
  void frame();
  void draw_frames(int count);
  /// Looks at the view that is shown, with a mouse that moves over it.
  void look();
  void think();
  void settle();
  bool until(const std::function<bool()>& it, double patience_s);
  [[nodiscard]] bool offers(const std::string& name) const;
  /// Clicks the widget of this name once it is offered. Returns false if it was not.
  bool use(const std::string& name, double patience_s = 5.0);
  void press(const app::gui::Chord& chord);
  void type(const std::string& text);
  void come_to(const std::string& view);
  void miss(const std::string& what);
  /// Opens what this name opens, looks at it, and leaves it.
  void look_into(const std::string& name);
  void look_at_keys();
  void look_at_participant_screens();
  void finish_work();

  void look_at_start();
  void look_at_study();
  void look_at_results();
  void look_at_device();
  void look_at_overview();
  void look_at_record();
  void prepare();
  void run_session();
  bool answer();
  bool answer_percent();
  void interrupt_session();
  void look_at_data();
  void open_another_window();

  Parameters parameters_;
  app::gui::HeadlessUi ui_{1600, 1000}, participant_{1280, 720};
  /// Declared before the window, whose session asks for it.
  std::atomic<double> clock_s_{0.0};
  std::unique_ptr<app::gui::Application> application_;
  std::map<std::string, FrameTimes> frames_;
  std::vector<std::string> missed_;
  std::size_t num_frames_ = 0;
  int num_rounds_ = 0, num_sessions_ = 0;
  double in_sessions_s_ = 0.0;
};

}  // namespace jnd::soak
