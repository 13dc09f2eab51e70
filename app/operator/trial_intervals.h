#pragma once

#include <string>

#include "experiments/procedures/procedure.h"
#include "experiments/session/session_state.h"

namespace jnd::app {

// The names of a trial's stimuli for people who run it. Where the order is drawn, they are
// "first", "second" and, if there are three, "third", and nobody is told which one is the test.

/// The name of a presentation of this trial.
[[nodiscard]] std::string shown_name(const experiments::PresentationState& presented,
                                     const experiments::PlannedTrial& trial);
/// The name of an interval, counted from 1.
[[nodiscard]] const char* interval_name(int place) noexcept;
/// Where the order is drawn, the first interval that was not felt in this attempt; "" for none.
[[nodiscard]] std::string next_interval(const experiments::TrialForm& form,
                                        const experiments::TrialState& trial);

/// The interval that has to be felt first: "reference", "first", or "test" if there is nothing
/// else.
[[nodiscard]] std::string first_interval(const experiments::TrialForm& form);
/// The interval that the question is about: "test", or the last one.
[[nodiscard]] std::string last_interval(const experiments::TrialForm& form);
/// The name of the interval that is or was last felt, or "free_space"; "" for none.
[[nodiscard]] std::string shown_interval(const experiments::TrialForm& form,
                                         const experiments::TrialState& trial);
/// Whether the interval of this name was felt in this attempt.
[[nodiscard]] bool felt(const experiments::TrialState& trial, const std::string& interval);
/// True if everything that the question is about was felt in this attempt.
[[nodiscard]] bool can_answer(const experiments::TrialForm& form,
                              const experiments::TrialState& trial);

}  // namespace jnd::app
