#pragma once

#include <filesystem>
#include <string>

namespace jnd::bench {

/// When the participant presses something, seconds after the beginning of each cycle: both
/// stimuli are felt, then the answer is given. A press that the session waits for nothing by
/// does nothing, so cycles that got out of step come back into it.
struct LaboratoryPress {
  double at_s = 0.0;
  unsigned char byte = 0;  ///< That the box sends.
  const char* action = "";
};
inline constexpr double kLaboratoryCycle_s = 3.2;
inline constexpr LaboratoryPress kLaboratoryPresses[] = {
    {0.0, '1', "present"}, {1.2, '1', "present"}, {2.4, '2', "yes"}};
inline constexpr const char* kAnswerAction = "yes";

/// What a session is run with.
struct LaboratorySession {
  std::filesystem::path folder;  ///< Of the session; its study is made in it.
  double duration_s = 60.0;
  bool has_everything = false;  ///< Streams, pulses, a pedal and sound; else none of them.
  std::string marker_port, answer_port, stream_name;
};

/// Runs it as the window does, without pictures, and prints `SESSION ID` once it has begun and
/// `STORED NUMBER NANOSECONDS` when a picture first told that an answer is on disk, of
/// CLOCK_MONOTONIC. Returns an exit code.
[[nodiscard]] int run_laboratory_session(const LaboratorySession& session);

}  // namespace jnd::bench
