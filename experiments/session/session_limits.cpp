#include "experiments/session/session_limits.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <variant>

namespace jnd::experiments {

int num_answers_since_break(const std::vector<const Stage*>& stages,
                            const SessionState& state) {
  std::int64_t begin = 0;  // Index of the stage after the last break.
  for (std::int64_t i = 0; i < state.stage; ++i) {
    if (std::holds_alternative<Break>(stages.at(static_cast<std::size_t>(i))->content)) {
      begin = i + 1;
    }
  }
  int num_answers = 0;
  for (const TrialState& trial : state.trials) {
    if (trial.stage >= begin && trial.is_answered) ++num_answers;
  }
  return num_answers;
}

std::string limit_advice(const SessionLimits& limits, int num_answers_since_break,
                         double elapsed_s) {
  if (limits.max_duration_s && elapsed_s > *limits.max_duration_s) {
    const auto minutes = [](double s) { return std::to_string(std::lround(s / 60.0)); };
    return minutes(elapsed_s) + " min so far, of at most " + minutes(*limits.max_duration_s);
  }
  if (limits.max_trials_without_break &&
      num_answers_since_break >= *limits.max_trials_without_break) {
    return std::to_string(num_answers_since_break) + " trials without a break, of at most " +
           std::to_string(*limits.max_trials_without_break);
  }
  return "";
}

std::string exposure_words(const SessionLimits& limits, const core::Exposure& exposure) {
  const auto words = [](double number, const char* format) {
    std::array<char, 32> text{};
    (void)std::snprintf(text.data(), text.size(), format, number);
    return std::string(text.data());
  };
  if (limits.max_under_force_s && exposure.under_force_s >= *limits.max_under_force_s) {
    return words(exposure.under_force_s / 60.0, "%.1f min under force") +
           words(*limits.max_under_force_s / 60.0, ", of at most %.1f");
  }
  if (limits.max_force_time_n_s && exposure.force_time_n_s >= *limits.max_force_time_n_s) {
    return words(exposure.force_time_n_s, "%.0f N s of force") +
           words(*limits.max_force_time_n_s, ", of at most %.0f");
  }
  return "";
}

}  // namespace jnd::experiments
