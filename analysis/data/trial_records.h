#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What happened to a drawn trial, besides its answer.
struct TrialRecord {
  std::int64_t session = 0, trial = 0;
  std::string block;
  /// What distinguishes the answers of its block: the intensity of the test, the target of a
  /// production in percent, or the standard of a matching.
  std::optional<double> level;
  bool is_catch = false;
  bool is_answered = false;   ///< Whether it has a valid answer that counts.
  bool is_set_aside = false;  ///< Whether it was answered, and set aside by hand.
  /// The number of answers that were taken back. The trial was run again after each.
  int num_undone = 0;
  /// The number of attempts that were given up without an answer.
  int num_discarded = 0;
  int num_missed_deadline = 0;  ///< The number of these whose answer missed its deadline.
  bool is_faulted = false;      ///< Whether the loop latched a fault during the trial.
  // These belong to the attempt with the valid answer:
  bool is_limited = false;  ///< Whether the limiter changed the force of a stimulus.
  /// Whether test or reference was not felt over a whole stroke. It is false for a solid, which
  /// is pressed.
  bool is_strokeless = false;

  [[nodiscard]] bool is_repeated() const noexcept { return num_undone + num_discarded > 0; }
  /// Whether it has an answer that counts although it did not proceed as intended.
  [[nodiscard]] bool is_affected() const noexcept {
    return is_answered && (is_repeated() || is_faulted || is_limited || is_strokeless);
  }
};

/// The records of all trials of a session, in the order of their numbers. Not real time.
[[nodiscard]] std::vector<TrialRecord> trial_records(const core::StudyStore& store,
                                                     std::int64_t session);

}  // namespace jnd::analysis
