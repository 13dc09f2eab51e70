#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock_offsets.h"

namespace jnd::core {

/// Compares the clock of an outlet with ours. Every other second it sends a wave of questions.
/// Of the answers to a wave, the one with the shortest round trip counts, because its ways
/// there and back differ least (NTP's clock filter, RFC 5905 section 10). It uses no socket and
/// no clock: the caller passes the time. Not real time.
class ClockProbe {
 public:
  struct Parameters {
    int num_questions = 8;      ///< Questions in a wave.
    int min_answers = 3;        ///< Fewest answers with which a wave counts.
    double between_s = 0.064;   ///< Time between two questions of a wave.
    double patience_s = 0.128;  ///< Waiting time after the last question of a wave.
    double every_s = 2.0;       ///< Time from the beginning of a wave to that of the next.
  };

  explicit ClockProbe(int first_wave) : ClockProbe(first_wave, Parameters{}) {}
  ClockProbe(int first_wave, const Parameters& parameters)
      : parameters_(parameters), wave_(first_wave) {}

  /// Returns the question that is due, to be sent at once, or "" if none is.
  [[nodiscard]] std::string due_question(double now_s);
  /// Takes an answer. It ignores one that answers no open question of this wave.
  void take_answer(std::string_view datagram, double now_s);
  /// Returns the result of a wave that has ended, once for each wave.
  [[nodiscard]] std::optional<ClockOffset> finished(double now_s);
  /// Returns the time when one of these functions has something to do again.
  [[nodiscard]] double next_due_s() const noexcept;

 private:
  struct Question {
    double t0_s = 0.0;
    bool is_open = true;
  };

  Parameters parameters_;
  int wave_;
  bool is_under_way_ = false;
  double wave_begins_s_ = 0.0;
  double next_question_s_ = 0.0;
  bool has_begun_ = false;
  std::vector<Question> questions_;  ///< Questions of the current wave.
  int num_answers_ = 0;
  ClockOffset best_;
};

}  // namespace jnd::core
