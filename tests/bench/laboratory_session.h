#pragma once

#include <filesystem>
#include <string>

namespace jnd::bench {

/// When the participant presses something, in seconds after the beginning of each cycle. Both
/// stimuli are felt, and then the answer is given. A press for which the session does not wait
/// has no effect, so a cycle that is out of step comes back into step.
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
  std::filesystem::path folder;  ///< The folder in which the session's study is made.
  double duration_s = 60.0;
  /// Whether there are streams, pulses, a pedal and sound. Otherwise there is none of them.
  bool has_everything = false;
  std::string marker_port, answer_port, stream_name;
};

/// Runs the session as the window does, without pictures. Prints `SESSION ID` when it has
/// begun, and `STORED NUMBER NANOSECONDS` when a picture first showed that an answer is on
/// disk, by CLOCK_MONOTONIC. Returns an exit code.
[[nodiscard]] int run_laboratory_session(const LaboratorySession& session);

}  // namespace jnd::bench
