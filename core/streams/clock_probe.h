#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock_offsets.h"

namespace jnd::core {

/// Compares the clock of an outlet with ours: every other second a wave of questions, and of
/// the answers to a wave the one with the shortest round trip counts, for its way there and
/// back can differ least (NTP's clock filter, RFC 5905 section 10). Knows no socket and no
/// clock: it is told what time it is. Not real time.
class ClockProbe {
 public:
  struct Parameters {
    int num_questions = 8;      ///< A wave.
    int min_answers = 3;        ///< Of a wave that counts.
    double between_s = 0.064;   ///< Two questions of a wave.
    double patience_s = 0.128;  ///< After the last question of a wave.
    double every_s = 2.0;       ///< From the beginning of a wave to that of the next.
  };

  explicit ClockProbe(int first_wave) : ClockProbe(first_wave, Parameters{}) {}
  ClockProbe(int first_wave, const Parameters& parameters)
      : parameters_(parameters), wave_(first_wave) {}

  /// The question that is due, to be sent at once; "" where none is.
  [[nodiscard]] std::string due_question(double now_s);
  /// Takes an answer; what answers no open question of this wave is left unheard.
  void take_answer(std::string_view datagram, double now_s);
  /// What a wave that is over has come to; each is told once.
  [[nodiscard]] std::optional<ClockOffset> finished(double now_s);
  /// When one of these has something to do again.
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
  std::vector<Question> questions_;  ///< Of this wave.
  int num_answers_ = 0;
  ClockOffset best_;
};

}  // namespace jnd::core
