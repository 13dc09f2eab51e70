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
  std::filesystem::path study_folder;  ///< "" for the start view.
  bool shows_results = false;          ///< Shows the results of that folder.
  /// The study file of a session to be prepared. Its folder is `study_folder`, which is made if
  /// it does not exist.
  std::filesystem::path study_file;
  std::string participant;
  std::string device;                    ///< "" leaves the choice to the window.
  std::filesystem::path device_profile;  ///< If "", a real device's own profile is looked for.
  std::optional<std::uint64_t> seed;
  bool pilot = false;
  bool allow_no_realtime = false;
  /// The study's language; "" for its first one.
  std::string language;
  /// What the study asks about the participant; may be incomplete.
  std::map<std::string, std::string> fields;
  /// How the device was fitted; may be empty.
  std::map<std::string, std::string> fitting;
  /// "F10", "F11" or "F12": a key, pedal or button of the participant; "" for none. See
  /// `gui::ParticipantStop`.
  std::string participant_stop;
  bool participant_holds = false;  ///< Force is there only while it is held.
  /// Streams to and from other recorders, for every session.
  core::WantedStreams streams;
  /// Pulses to another recorder, for every session.
  core::WantedMarkers markers;
  /// The port of a box that answers by bytes; "" for none.
  std::filesystem::path answer_port;
  int answer_baud = 9600;
  /// The sound output of every session; "" for the machine's own, or "off".
  std::string sound_output;
  /// Returns seconds since some moment; any thread may call it. If it is set, sessions take
  /// their time from it, with simulated devices only; tests use it to go through a whole day.
  /// Otherwise sessions run in real time.
  std::function<double()> simulated_clock_s;
  /// A session to be resumed.
  std::optional<std::int64_t> resume_session;
};

/// Whether there is a display on which a window can open.
[[nodiscard]] bool has_display();

/// Opens the window and returns when it is closed, with an exit code. Throws `EnvironmentError`
/// if there is no display.
[[nodiscard]] int open_window(const WindowRequest& request);

}  // namespace jnd::app
