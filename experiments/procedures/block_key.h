#pragma once

#include <string>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// A key that blocks of some procedure have. Several procedures may have the same one; then it
/// is declared here, once, and means the same to all of them.
struct BlockKey {
  /// Of a key `of_quantity`, name, unit and upper end follow from the block's quantity.
  Parameter parameter{};
  /// "reference" stands in the file as "reference_viscosity_pa_s", and "" as "viscosity_pa_s".
  bool of_quantity = false;
  bool of_standard = false;  ///< The same with the quantity of `standard_medium`.
  bool is_positive = false;  ///< > 0, though the quantity itself may be 0.

  [[nodiscard]] bool names_quantity() const noexcept { return of_quantity || of_standard; }
  /// As it stands with this quantity: "reference_viscosity_pa_s".
  [[nodiscard]] std::string name_for(const std::string& quantity) const;
};

/// A number > 0 of the block's quantity.
[[nodiscard]] BlockKey amount_key(const char* name, const char* meaning, bool required = true);
/// A whole number that may be left out.
[[nodiscard]] BlockKey whole_number_key(const char* name, const char* meaning, Range range,
                                        const std::string& default_json);

/// The stimuli: tests of a comparison, or what an adjustment starts from.
[[nodiscard]] BlockKey stimuli_key();
/// How a test stimulus is asked about: "reminder", "yes_no", "two_interval", "same_different".
[[nodiscard]] BlockKey task_key();
/// What every test stimulus is compared with, in any task but yes-no.
[[nodiscard]] BlockKey reference_key();
/// How the interval of the test is drawn, where it is.
[[nodiscard]] BlockKey interval_order_key();
/// Trials without a difference, or without anything: of a repetition, or one by one.
[[nodiscard]] BlockKey catch_trials_key();
[[nodiscard]] BlockKey catch_probability_key();
/// What a block can have whose trials have right answers: feedback and practice.
[[nodiscard]] std::vector<BlockKey> right_answer_keys();
/// Whether a choice may be left open.
[[nodiscard]] BlockKey cannot_tell_key();
/// What is felt as the standard: a medium, and how much of it.
[[nodiscard]] std::vector<BlockKey> standard_keys();
/// How often stimuli may be felt again.
[[nodiscard]] BlockKey max_returns_key();
/// How often every test stimulus is shown.
[[nodiscard]] BlockKey repetitions_key();
/// In which order the test stimuli are shown.
[[nodiscard]] BlockKey order_key();
/// What the two answers are called.
[[nodiscard]] std::vector<BlockKey> answer_label_keys();
/// Steps of an adjustment and its end.
[[nodiscard]] std::vector<BlockKey> step_keys();

}  // namespace jnd::experiments
