#pragma once

#include <filesystem>
#include <string>

namespace jnd::bench {

/// When the participant presses something, in seconds after the beginning of each cycle: both
/// stimuli are felt, then the answer is given. A press for which the session does not wait does
/// nothing, so cycles that got out of step recover.
struct LaboratoryPress {
  double at_s = 0.0;
  unsigned char byte = 0;  ///< The byte that the box sends.
  const char* action = "";
};
inline constexpr double kLaboratoryCycle_s = 3.2;
inline constexpr LaboratoryPress kLaboratoryPresses[] = {
    {0.0, '1', "present"}, {1.2, '1', "present"}, {2.4, '2', "yes"}};
inline constexpr const char* kAnswerAction = "yes";

/// The parameters of a session.
struct LaboratorySession {
  std::filesystem::path folder;  ///< Folder of the session, in which its study is made.
  double duration_s = 60.0;
  bool has_everything = false;  ///< Streams, pulses, a pedal and sound; otherwise none of them.
  std::string marker_port, answer_port, stream_name;
};

/// Runs the session as the window does, without pictures. Prints `SESSION ID` once it has
/// begun, and `STORED NUMBER NANOSECONDS` when a view first says that an answer is on disk, by
/// CLOCK_MONOTONIC. Returns an exit code.
[[nodiscard]] int run_laboratory_session(const LaboratorySession& session);

}  // namespace jnd::bench
