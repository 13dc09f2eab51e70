#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/operator/appointments.h"
#include "app/operator/background_task.h"
#include "app/operator/session_quality.h"
#include "app/operator/study_folder.h"

namespace jnd::app {

/// How many sessions an order, an arm or a group of people has.
struct BalanceLine {
  std::string words;  ///< Such as "low, then high".
  int num_done = 0;   ///< Completed sessions, without pilots.
  int num_open = 0;   ///< Sessions that have begun but not ended.
  /// The next participant gets it, whatever their fields are.
  bool is_next = false;
};
/// The lines of all cells; if there are many cells, the lines of one factor that differs
/// between people.
struct BalanceGroup {
  std::string title;  ///< "" for all cells together.
  std::vector<BalanceLine> lines;
};

/// What the next participant gets.
struct NextCell {
  std::string brings;  ///< Such as "sex: female"; "" if the study asks nothing.
  /// Such as "low, then high"; "" if everybody gets the same.
  std::string cell;
};

/// How old the newest backup of a study is.
struct BackupAge {
  bool is_known = false;  ///< There is a finished backup.
  std::string when;       ///< Such as "3 days ago"; "" for none.
  std::string folder;     ///< The folder of the backup.
  /// The sessions that have gone on since.
  int num_newer_sessions = 0;
  bool is_away = false;       ///< The backup's folder is not there now.
  bool is_elsewhere = false;  ///< The backup is on another disk than the study.
  /// What to do, in a sentence; "" if nothing needs to be done.
  std::string hint;
};

/// Where a study stands. Plain data. If the study is double-blind and nobody has unblinded it,
/// nothing in here tells a level, an order or an arm.
struct StudyOverview {
  bool hides_levels = false;
  bool is_backup = false;
  int num_done = 0;  ///< Participants who are done.
  std::optional<std::int64_t> num_planned;
  /// Where the plan comes from, such as "preregistered"; "" if there is none, or if somebody
  /// entered it in the overview.
  std::string planned_by;
  /// Empty where it is hidden, or if nothing differs.
  std::vector<BalanceGroup> balance;
  std::string next_participant;
  std::vector<NextCell> next_cells;  ///< Empty where it is hidden.
  /// Why the next cell cannot be told; "" otherwise.
  std::string cell_problem;
  std::vector<SessionQuality> quality;  ///< In the order of their numbers.
  BackupAge backup;
  std::vector<ScheduleLine> schedule;
  std::string free_pseudonym;  ///< For the next appointment.
};

/// Reads the folder and every log in it. It takes a second for a large study, so call it in a
/// `BackgroundTask`. `seed` is the study's seed, with which its sessions are prepared. Throws
/// `core::Error`, and `WorkCancelled` between sessions. Not real time.
[[nodiscard]] StudyOverview study_overview(const std::filesystem::path& folder,
                                           std::uint64_t seed, WorkControl& control,
                                           std::int64_t now_ns = core::SystemClock().now_ns());

/// How many people the study shall have by its file or its preregistration; none if neither
/// says it.
struct PlannedNumber {
  std::int64_t num_participants = 0;
  std::string by;  ///< As in `StudyOverview::planned_by`.
};
[[nodiscard]] std::optional<PlannedNumber> planned_elsewhere(const core::StudyStore& store,
                                                             const experiments::Study& study);

// What the overview stores; each is on disk at once. They throw `core::Error` for invalid
// input, for a backup, and while another program writes to the study. Not real time.

/// `date` is such as "2026-12-01", `hour` such as "14:30".
void write_appointment(const std::filesystem::path& folder, const std::string& participant,
                       const std::string& date, const std::string& hour);
void cancel_appointment_of(const std::filesystem::path& folder, std::int64_t appointment);
/// `typed` is a whole number above 0. Refused if the file or the preregistration says the
/// number.
void write_planned_number(const std::filesystem::path& folder, const std::string& typed);

}  // namespace jnd::app
