#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/operator/operator_request.h"
#include "app/operator/preflight.h"
#include "core/controls/control_reader.h"

namespace jnd::app {

/// Pedals, button boxes, gamepads and numeric pads beside a window: which of them does what on
/// this machine, and where their presses go. Only the window's thread uses it, except for a
/// session's callbacks. Not real time.
class AnswerControls {
 public:
  struct Parameters {
    std::filesystem::path file;  ///< The file that stores the map; "" if nothing stores it.
    /// Where presses come from; this class sets its callbacks.
    core::ControlReader::Parameters reader{};
    /// Presses the emergency stop of the session under way; called at once, from any thread.
    std::function<void()> press_stop;
    /// Requests another frame; any thread may call it. It may be empty.
    std::function<void()> wake;
  };

  explicit AnswerControls(Parameters parameters);

  [[nodiscard]] const core::ControlMap& map() const noexcept { return map_; }
  /// Maps a control to an action. Throws `core::Error` if the map cannot be stored; the mapping
  /// then holds until the program ends.
  void set(const std::string& action, const core::Control& control);
  void forget(const std::string& action);

  /// A session is under way: it has the mapped devices to itself, and another thread calls
  /// `use` for what is pressed. A mapped stop presses the emergency stop before anything else.
  /// So does unplugging it, because then nobody can press it.
  void begin_session(std::function<void(const operate::UseControl&)> use);
  /// When this returns, `use` is no longer called.
  void end_session();
  /// While a session is prepared, the mapped devices are already taken, so that the window
  /// shows which are there.
  void prepare(bool wanted);
  /// While somebody maps controls, every device is listened to.
  void listen_to_all(bool wanted);

  /// What was pressed since the last call, on any device that is listened to; the newest is
  /// last.
  [[nodiscard]] std::vector<core::ControlEvent> take_events();
  [[nodiscard]] std::vector<core::ControlReader::DeviceState> devices() const {
    return reader_.devices();
  }
  /// Returns true once for each time that the stop was pressed while no session was under way.
  [[nodiscard]] bool take_stop() noexcept { return stop_is_asked_.exchange(false); }
  /// True while nobody holds what has to be held; then there may be no force.
  [[nodiscard]] bool is_let_go() const noexcept { return has_hold_ && !is_held_; }
  /// The names of the mapped controls, by action.
  [[nodiscard]] std::map<std::string, std::string> words() const;

 private:
  void take(const core::ControlEvent& event);
  void lost(const std::string& device);
  void stop() noexcept;
  void listen();
  void keep();

  Parameters parameters_;
  /// The window's map; the other thread reads the copy below.
  core::ControlMap map_;
  bool is_mapping_ = false, is_preparing_ = false;
  std::atomic<bool> has_session_{false}, stop_is_asked_{false};
  std::atomic<bool> has_hold_{false}, is_held_{false};
  std::mutex mutex_;
  core::ControlMap shared_map_;
  std::function<void(const operate::UseControl&)> use_;
  std::vector<core::ControlEvent> events_;
  core::ControlReader reader_;
};

/// Tells, as a line of the check before a session, whether everything is plugged in that the
/// study and this machine's map need; none if they need nothing. `participant_answers` tells
/// that the participant answers some block of the study.
[[nodiscard]] std::optional<PreflightLine> controls_line(
    const core::ControlMap& map, const std::vector<core::ControlReader::DeviceState>& devices,
    bool participant_answers);

/// What an action is called where it is mapped, such as "The first interval".
[[nodiscard]] std::string action_words(std::string_view action);

}  // namespace jnd::app
