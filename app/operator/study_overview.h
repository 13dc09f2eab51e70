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
  std::string words;     ///< "low, then high"
  int num_done = 0;      ///< Completed; pilots do not count.
  int num_open = 0;      ///< Begun and not ended.
  bool is_next = false;  ///< The next participant gets it, whatever they bring.
};
/// Those of all cells, or of one thing that differs between people where cells are many.
struct BalanceGroup {
  std::string title;  ///< "" for all cells together.
  std::vector<BalanceLine> lines;
};

/// What the next participant gets.
struct NextCell {
  std::string brings;  ///< "sex: female"; "" where nobody brings anything.
  std::string cell;    ///< "low, then high"; "" where everybody gets the same.
};

/// How old the newest copy of a study is.
struct BackupAge {
  bool is_known = false;       ///< There is one that was finished.
  std::string when;            ///< "3 days ago"; "" for none.
  std::string folder;          ///< Where it is.
  int num_newer_sessions = 0;  ///< That went on since.
  bool is_away = false;        ///< Its folder is not there now.
  bool is_elsewhere = false;   ///< On another disk than the study.
  /// What to do, a sentence; "" where nothing needs to be done.
  std::string hint;
};

/// Where a study stands. Plain data. Of a double-blind study that nobody has unblinded nothing
/// in it tells a level, an order or an arm.
struct StudyOverview {
  bool hides_levels = false;
  bool is_backup = false;
  int num_done = 0;  ///< Participants.
  std::optional<std::int64_t> num_planned;
  /// Who says so: "preregistered"; "" where nobody does, or somebody has written it down here.
  std::string planned_by;
  std::vector<BalanceGroup> balance;  ///< Empty where it is hidden, or nothing differs.
  std::string next_participant;
  std::vector<NextCell> next_cells;     ///< Empty where it is hidden.
  std::string cell_problem;             ///< Why it cannot be said; "" otherwise.
  std::vector<SessionQuality> quality;  ///< By number.
  BackupAge backup;
  std::vector<ScheduleLine> schedule;
  std::string free_pseudonym;  ///< For the next appointment.
};

/// Reads the folder and every log in it: a second for a large study, so for a `BackgroundTask`.
/// `seed`: of the study, as its sessions are prepared with. Throws `core::Error`,
/// `WorkCancelled` between its sessions. Not real time.
[[nodiscard]] StudyOverview study_overview(const std::filesystem::path& folder,
                                           std::uint64_t seed, WorkControl& control,
                                           std::int64_t now_ns = core::SystemClock().now_ns());

/// How many people the study is to have, as its file or its preregistration says; none where
/// neither does.
struct PlannedNumber {
  std::int64_t num_participants = 0;
  std::string by;  ///< As `StudyOverview::planned_by`.
};
[[nodiscard]] std::optional<PlannedNumber> planned_elsewhere(const core::StudyStore& store,
                                                             const experiments::Study& study);

// What the overview writes down, each at once on disk. Throw `core::Error` for what is none,
// for a backup, and while another program writes to the study. Not real time.

/// `date` "2026-12-01", `hour` "14:30".
void write_appointment(const std::filesystem::path& folder, const std::string& participant,
                       const std::string& date, const std::string& hour);
void cancel_appointment_of(const std::filesystem::path& folder, std::int64_t appointment);
/// `typed`: a whole number above 0. Refused where the plan stands elsewhere.
void write_planned_number(const std::filesystem::path& folder, const std::string& typed);

}  // namespace jnd::app
