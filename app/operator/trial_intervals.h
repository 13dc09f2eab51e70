#pragma once

#include <string>

#include "experiments/procedures/procedure.h"
#include "experiments/session/session_state.h"

namespace jnd::app {

// What the stimuli of a trial are called for those who run it. Where the order is drawn they
// are "first", "second" and, of three, "third", and nobody is told which of them is the test.

/// Of a presentation of this trial.
[[nodiscard]] std::string shown_name(const experiments::PresentationState& presented,
                                     const experiments::PlannedTrial& trial);
/// Of an interval, from 1.
[[nodiscard]] const char* interval_name(int place) noexcept;
/// Of those whose order is drawn, the first that was not felt in this attempt; "" for none.
[[nodiscard]] std::string next_interval(const experiments::TrialForm& form,
                                        const experiments::TrialState& trial);

/// What has to be felt first: "reference", "first", or "test" where it stands alone.
[[nodiscard]] std::string first_interval(const experiments::TrialForm& form);
/// What the question is about: "test", or the last one.
[[nodiscard]] std::string last_interval(const experiments::TrialForm& form);
/// The one being felt or felt last, by that name, or "free_space"; "" for none.
[[nodiscard]] std::string shown_interval(const experiments::TrialForm& form,
                                         const experiments::TrialState& trial);
/// Whether this interval, by that name, was felt in this attempt.
[[nodiscard]] bool felt(const experiments::TrialState& trial, const std::string& interval);
/// Everything that the question is about was felt in this attempt.
[[nodiscard]] bool can_answer(const experiments::TrialForm& form,
                              const experiments::TrialState& trial);

}  // namespace jnd::app
