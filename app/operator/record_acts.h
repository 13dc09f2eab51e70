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

// What can be done to a stored session that nobody is running. Each act is on disk when its
// function returns, and only a withdrawal deletes anything. All throw `core::Error` if the act
// is impossible: while another program writes to the study, in a backup, or for a trial that
// does not exist. Not real time.

/// Corrects an answer and keeps what was felt. `value` is as in `operate::Correct`. The session
/// has to be over: one that can be resumed is corrected there, because otherwise the time until
/// now would count as spent in it.
void correct_answer(const std::filesystem::path& folder, std::int64_t session,
                    std::int64_t trial, const std::optional<double>& value,
                    const std::string& reason);

/// Leaves trials out of results, or with `include` takes them into results again. Trials that
/// are in that state already stay as they are. Returns how many have changed.
int exclude_trials(const std::filesystem::path& folder, std::int64_t session,
                   const std::vector<std::int64_t>& trials, const std::string& reason,
                   bool include);

/// Adds a note with the present time. The session has to be over, as for `correct_answer`.
void add_note(const std::filesystem::path& folder, std::int64_t session,
              const std::string& text);
/// Adds an adverse event to any session. It is kept forever, even if the person withdraws.
void add_adverse_event(const std::filesystem::path& folder, std::int64_t session,
                       const std::string& text);
/// Stores that somebody has read the note.
void acknowledge_note(const std::filesystem::path& folder, const core::ReadNote& note);

/// Deletes everything of a person, here and in every known backup. The outcome's problems name
/// what could not be reached, and exports that still contain the person.
[[nodiscard]] ActionOutcome withdraw_participant(const std::filesystem::path& folder,
                                                 const std::string& participant,
                                                 WorkControl& control);

}  // namespace jnd::app
