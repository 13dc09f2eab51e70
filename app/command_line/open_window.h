#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/markers/marker_port.h"
#include "core/streams/wanted_streams.h"

namespace jnd::app {

/// What the window shows first.
struct WindowRequest {
  std::filesystem::path study_folder;  ///< "": the start view.
  bool shows_results = false;          ///< Of that folder.
  /// A session to be prepared: of this study file, in that folder, made if absent.
  std::filesystem::path study_file;
  std::string participant;
  std::string device;  ///< "": chosen in the window.
  std::filesystem::path
      device_profile;  ///< Its profile; "": a real device's own is looked for.
  std::optional<std::uint64_t> seed;
  bool pilot = false;
  bool allow_no_realtime = false;
  std::string language;                        ///< Of the study; "": its first.
  std::map<std::string, std::string> fields;   ///< What the participant brings; may lack.
  std::map<std::string, std::string> fitting;  ///< How the device was fitted; may be empty.
  /// "F10", "F11" or "F12": a key, pedal or button of the participant's; "": none. See
  /// `gui::ParticipantStop`.
  std::string participant_stop;
  bool participant_holds = false;     ///< Force only while it is held.
  core::WantedStreams streams;        ///< To and of other recorders, of every session.
  core::WantedMarkers markers;        ///< To another recorder by pulses, of every session.
  std::filesystem::path answer_port;  ///< Of a box that answers by bytes; "": none.
  int answer_baud = 9600;
  std::string sound_output;  ///< Of every session; "": this machine's own; or "off".
  /// Seconds from any moment on, asked from any thread. Where it is there, sessions take their
  /// time from it, at simulated devices alone: for tests that go through a day of them. Else
  /// they run in real time.
  std::function<double()> simulated_clock_s;
  /// A session to go on with.
  std::optional<std::int64_t> resume_session;
};

/// Whether there is a display to open a window on.
[[nodiscard]] bool has_display();

/// Opens the window and returns when it is closed, with an exit code. Throws
/// `EnvironmentError` without a display.
[[nodiscard]] int open_window(const WindowRequest& request);

}  // namespace jnd::app
