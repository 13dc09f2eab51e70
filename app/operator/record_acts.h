#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/operator/background_task.h"
#include "app/operator/export_actions.h"
#include "core/storage/acknowledgement.h"

namespace jnd::app {

// What is done to a stored session when nobody is in it. Each is on disk when it returns, and
// none deletes anything but a withdrawal. All throw `core::Error` where it cannot be done:
// while another program writes to the study, in a backup, for a trial that is not there. Not
// real time.

/// Sets an answer right; what was felt stays. `value` as in `operate::Correct`. Of a session
/// that is over: one that can be resumed is corrected there, for else the time until now would
/// count as spent in it.
void correct_answer(const std::filesystem::path& folder, std::int64_t session,
                    std::int64_t trial, const std::optional<double>& value,
                    const std::string& reason);

/// Leaves trials out of results; with `include` takes them into results again. Those that are
/// so already stay as they are. Returns how many became another.
int exclude_trials(const std::filesystem::path& folder, std::int64_t session,
                   const std::vector<std::int64_t>& trials, const std::string& reason,
                   bool include);

/// A note with the time, now. Of a session that is over, as `correct_answer`.
void add_note(const std::filesystem::path& folder, std::int64_t session,
              const std::string& text);
/// Kept for good, also if the person withdraws. Of any session.
void add_adverse_event(const std::filesystem::path& folder, std::int64_t session,
                       const std::string& text);
/// Somebody has read it.
void acknowledge_note(const std::filesystem::path& folder, const core::ReadNote& note);

/// Deletes everything of a person, here and in every known backup. What could not be reached,
/// and exports that still hold the person, are problems of the outcome.
[[nodiscard]] ActionOutcome withdraw_participant(const std::filesystem::path& folder,
                                                 const std::string& participant,
                                                 WorkControl& control);

}  // namespace jnd::app
