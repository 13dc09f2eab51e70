#pragma once

#include <string>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// A key of blocks of some procedure. A key of several procedures is declared here once and
/// means the same for all of them.
struct BlockKey {
  /// For a key `of_quantity`, name, unit and upper end follow from the block's quantity.
  Parameter parameter{};
  /// For example, "reference" is spelt "reference_viscosity_pa_s" in the file, and "" is spelt
  /// "viscosity_pa_s".
  bool of_quantity = false;
  bool of_standard = false;  ///< The same, with the quantity of `standard_medium`.
  bool is_positive = false;  ///< > 0, although the quantity itself may be 0.

  [[nodiscard]] bool names_quantity() const noexcept { return of_quantity || of_standard; }
  /// Returns the spelling with this quantity: "reference_viscosity_pa_s".
  [[nodiscard]] std::string name_for(const std::string& quantity) const;
};

/// Returns a key for a number > 0 of the block's quantity.
[[nodiscard]] BlockKey amount_key(const char* name, const char* meaning, bool required = true);
/// Returns a key for an optional whole number.
[[nodiscard]] BlockKey whole_number_key(const char* name, const char* meaning, Range range,
                                        const std::string& default_json);

/// The stimuli: tests of a comparison, or starting values of an adjustment.
[[nodiscard]] BlockKey stimuli_key();
/// The task, that is, how a test stimulus is asked about: "reminder", "yes_no", "two_interval",
/// "same_different".
[[nodiscard]] BlockKey task_key();
/// The reference with which every test stimulus is compared, in any task but yes-no.
[[nodiscard]] BlockKey reference_key();
/// How the interval of the test is drawn, if it is.
[[nodiscard]] BlockKey interval_order_key();
/// Trials without a difference or without a stimulus: their number in a repetition, or their
/// probability.
[[nodiscard]] BlockKey catch_trials_key();
[[nodiscard]] BlockKey catch_probability_key();
/// Keys of blocks whose trials have right answers: feedback and practice.
[[nodiscard]] std::vector<BlockKey> right_answer_keys();
/// Whether "cannot tell" is an answer.
[[nodiscard]] BlockKey cannot_tell_key();
/// The standard: a medium and its amount.
[[nodiscard]] std::vector<BlockKey> standard_keys();
/// How often stimuli may be felt again.
[[nodiscard]] BlockKey max_returns_key();
/// How often every test stimulus is shown.
[[nodiscard]] BlockKey repetitions_key();
/// The order of the test stimuli.
[[nodiscard]] BlockKey order_key();
/// The names of the two answers.
[[nodiscard]] std::vector<BlockKey> answer_label_keys();
/// Steps of an adjustment and its end.
[[nodiscard]] std::vector<BlockKey> step_keys();

}  // namespace jnd::experiments
