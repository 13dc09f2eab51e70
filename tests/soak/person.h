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

/// Plays somebody at the window without its pixels, who goes through all of it again and again.
/// The person reports what they look for and do not find, because a soak that passes by a view
/// proves nothing about it.
///
/// Each frame is a thirtieth of a second of the simulated day, as in a window that shows a
/// session, and sessions take their time from the same clock. A frame is drawn as soon as the
/// last one is done, except while work beside the window is waited for.
class Person {
 public:
  struct Parameters {
    /// A folder with sessions, which is copied for each round.
    std::filesystem::path template_study;
    std::filesystem::path table;   ///< A table of answers for the view of data.
    std::filesystem::path folder;  ///< The folder that holds the studies of the rounds.
    /// The length of the simulated day, which decides which frames are the first and the last.
    double duration_s = 0.0;
    /// The simulated time at each view and page. Each act takes a quarter of it.
    double look_s = 0.0;
    bool tells = false;  ///< Whether to print to stderr how long each part of a round took.
  };
  explicit Person(Parameters parameters);

  /// Goes from the start through every view and a session, and back to the start.
  void go_round();

  /// Returns the simulated time so far.
  [[nodiscard]] double now_s() const noexcept { return clock_s_.load(); }
  /// Returns how long frames took to draw, for each view.
  [[nodiscard]] const std::map<std::string, FrameTimes>& frames() const noexcept {
    return frames_;
  }
  [[nodiscard]] std::size_t num_frames() const noexcept { return num_frames_; }
  [[nodiscard]] int num_sessions() const noexcept { return num_sessions_; }
  /// Returns the simulated time within sessions.
  [[nodiscard]] double in_sessions_s() const noexcept { return in_sessions_s_; }
  /// Returns what was looked for and not found, each once with its view.
  [[nodiscard]] const std::vector<std::string>& missed() const noexcept { return missed_; }

 private:
  void frame();
  void draw_frames(int count);
  /// Looks at the present view while the mouse moves over it.
  void look();
  void think();
  void settle();
  bool until(const std::function<bool()>& it, double patience_s);
  [[nodiscard]] bool offers(const std::string& name) const;
  /// Clicks the widget of this name as soon as it is offered.
  bool use(const std::string& name, double patience_s = 5.0);
  void press(const app::gui::Chord& chord);
  void type(const std::string& text);
  void come_to(const std::string& view);
  void miss(const std::string& what);
  /// Opens what this widget opens, looks at it and leaves it.
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
  std::atomic<double> clock_s_{0.0};  ///< Declared before the window, whose session reads it.
  std::unique_ptr<app::gui::Application> application_;
  std::map<std::string, FrameTimes> frames_;
  std::vector<std::string> missed_;
  std::size_t num_frames_ = 0;
  int num_rounds_ = 0, num_sessions_ = 0;
  double in_sessions_s_ = 0.0;
};

}  // namespace jnd::soak
