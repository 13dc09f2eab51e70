#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What happened to a trial that was drawn, besides its answer.
struct TrialRecord {
  std::int64_t session = 0, trial = 0;
  std::string block;
  /// What the answers of its block are told apart by: the test's intensity, the target of a
  /// production in percent, the standard of a matching.
  std::optional<double> level;
  bool is_catch = false;
  bool is_answered = false;     ///< The answer stands and counts.
  bool is_set_aside = false;    ///< Answered, and set aside by hand.
  int num_undone = 0;           ///< Answers taken back, after each of which it was run again.
  int num_discarded = 0;        ///< Attempts without an answer that were given up.
  int num_missed_deadline = 0;  ///< Those among them whose answer missed its deadline.
  bool is_faulted = false;      ///< The loop latched a fault while it was under way.
  // Of the attempt whose answer stands:
  bool is_limited = false;     ///< The limiter changed the force of a stimulus.
  bool is_strokeless = false;  ///< Test or reference was never felt over a whole stroke; not of
                               ///< a solid, which is pressed.

  [[nodiscard]] bool is_repeated() const noexcept { return num_undone + num_discarded > 0; }
  /// It has an answer that counts, but did not go as it was meant to.
  [[nodiscard]] bool is_affected() const noexcept {
    return is_answered && (is_repeated() || is_faulted || is_limited || is_strokeless);
  }
};

/// Of all trials of a session, in the order of their numbers. Not real time.
[[nodiscard]] std::vector<TrialRecord> trial_records(const core::StudyStore& store,
                                                     std::int64_t session);

}  // namespace jnd::analysis
