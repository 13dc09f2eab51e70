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
/// this machine, and where their presses go. All but the callbacks of a session is the window's
/// thread. Not real time.
class AnswerControls {
 public:
  struct Parameters {
    std::filesystem::path file;  ///< Where the map is kept; "": nowhere.
    /// Where presses come from; its callbacks are filled in.
    core::ControlReader::Parameters reader{};
    /// The emergency stop of a session under way: called from any thread, at once.
    std::function<void()> press_stop;
    std::function<void()> wake;  ///< Another frame; from any thread, may be empty.
  };

  explicit AnswerControls(Parameters parameters);

  [[nodiscard]] const core::ControlMap& map() const noexcept { return map_; }
  /// Throws `core::Error` where the map cannot be kept; it holds all the same.
  void set(const std::string& action, const core::Control& control);
  void forget(const std::string& action);

  /// A session is under way: mapped devices are its own, and `use` gets what is pressed, from
  /// another thread. A mapped stop presses the emergency stop past everything; so does one that
  /// is unplugged, for nobody can press it then.
  void begin_session(std::function<void(const operate::UseControl&)> use);
  /// `use` is called no more.
  void end_session();
  /// A session is prepared: mapped devices are ours already, so that it is seen which are
  /// there.
  void prepare(bool wanted);
  /// Somebody maps: every device is listened to.
  void listen_to_all(bool wanted);

  /// What was pressed since, by any device that is listened to; the newest last.
  [[nodiscard]] std::vector<core::ControlEvent> take_events();
  [[nodiscard]] std::vector<core::ControlReader::DeviceState> devices() const {
    return reader_.devices();
  }
  /// The stop was pressed while no session was under way: once for each time.
  [[nodiscard]] bool take_stop() noexcept { return stop_is_asked_.exchange(false); }
  /// Nobody holds what has to be held: there may be no force.
  [[nodiscard]] bool is_let_go() const noexcept { return has_hold_ && !is_held_; }
  /// What the mapped controls are called, by their actions.
  [[nodiscard]] std::map<std::string, std::string> words() const;

 private:
  void take(const core::ControlEvent& event);
  void lost(const std::string& device);
  void stop() noexcept;
  void listen();
  void keep();

  Parameters parameters_;
  core::ControlMap map_;  ///< The window's; its copy below is read by the other thread.
  bool is_mapping_ = false, is_preparing_ = false;
  std::atomic<bool> has_session_{false}, stop_is_asked_{false};
  std::atomic<bool> has_hold_{false}, is_held_{false};
  std::mutex mutex_;
  core::ControlMap shared_map_;
  std::function<void(const operate::UseControl&)> use_;
  std::vector<core::ControlEvent> events_;
  core::ControlReader reader_;
};

/// Whether what a study and this machine's map need is plugged in, as a line of the look before
/// a session; none where neither asks for anything. `participant_answers`: some block of the
/// study is answered by the participant.
[[nodiscard]] std::optional<PreflightLine> controls_line(
    const core::ControlMap& map, const std::vector<core::ControlReader::DeviceState>& devices,
    bool participant_answers);

/// What an action is called where it is mapped: "The first interval".
[[nodiscard]] std::string action_words(std::string_view action);

}  // namespace jnd::app
