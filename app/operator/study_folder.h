#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// A session that neither came to its end nor was ended: what can be resumed, and what is safe.
struct InterruptedSession {
  std::int64_t session = 0;
  std::string participant;
  std::string stage;   ///< Title; "Block 1" where it could tell the level.
  int trial = 0;       ///< The one to be repeated, within its block; 0 outside of one.
  int num_trials = 0;  ///< Of the block; 0 outside of one.
  bool num_is_expected = false;  ///< The answers decide how many they are.
  std::int64_t num_answers = 0;  ///< On disk.
  double recorded_min = 0.0;     ///< On disk.
  std::string when;              ///< "today"; "" for a simulated session, which has no date.
  bool pilot = false, simulated = false;
  std::string problem;  ///< Why it cannot be looked into; "" otherwise.

  /// "P07 was interrupted in Group D, trial 23 of 40".
  [[nodiscard]] std::string sentence() const;
  /// "62 answers and 38 minutes of recording are safe on disk".
  [[nodiscard]] std::string safe() const;
};

/// One session as a row of a table.
struct SessionLine {
  enum class Status { kOpen, kCompleted, kEndedEarly };
  std::int64_t session = 0;
  std::string participant;
  Status status = Status::kOpen;
  bool pilot = false, simulated = false;
  std::string device;
  std::string cells;  ///< The order assigned, in words; "" for one cell, or where it is hidden.
  std::int64_t num_answers = 0;
  std::int64_t num_trials = 0;   ///< Of the whole session, whether drawn yet or not.
  bool num_is_expected = false;  ///< The answers decide how many they are.
  std::string when;              ///< As in `InterruptedSession`.
};

/// A study folder for a card, and its sessions for a table. Plain data.
struct StudyFolder {
  std::filesystem::path folder;
  std::string name, title;  ///< The title in the study's first language.
  experiments::Blinding blinding = experiments::Blinding::kNone;
  /// Double-blind and nobody has unblinded it: nothing here tells a level or an order.
  bool hides_levels = false;
  std::filesystem::path study_file;  ///< Where it was read from; "" if nobody knows.
  int num_participants_done = 0;     ///< Completed, pilots left out.
  int num_sessions = 0;              ///< All of them.
  int num_open = 0;
  int num_pilots = 0;
  bool simulated = false;    ///< At least one session is.
  std::string last_session;  ///< "today", "yesterday", "12 November"; "" if nobody knows.
  bool is_backup = false;    ///< A copy: it can be read, and nothing is added to it.
  std::vector<std::filesystem::path> backups;  ///< Known ones.
  /// One of them at least is there, and lies on another disk than the study.
  bool is_safe_elsewhere = false;
  std::vector<SessionLine> sessions;            ///< By number.
  std::vector<InterruptedSession> interrupted;  ///< The latest first.

  /// "6 participants done, 1 open, last session today"; of a copy it says so first.
  [[nodiscard]] std::string summary() const;
};

/// Reads no more than is shown: a study of a hundred sessions opens in well under a second.
/// Throws `core::Error`: no study folder, damaged, of a newer program. Not real time.
[[nodiscard]] StudyFolder open_study_folder(const std::filesystem::path& folder,
                                            std::int64_t now_ns = core::SystemClock().now_ns());

/// The study file that a folder is of: of its last session, or as it was created. Throws
/// `core::Error` if it holds none.
[[nodiscard]] core::ProtocolRow protocol_in(const core::StudyStore& store);
/// The same, read; `experiments::ProtocolError` if this program does not understand it.
[[nodiscard]] experiments::Study study_in(const core::StudyStore& store);
/// Where it was read from, if the folder says so; "" otherwise.
[[nodiscard]] std::filesystem::path study_file_of(const core::StudyStore& store,
                                                  const core::ProtocolRow& protocol);

/// Makes a folder that holds the study and no session yet. Throws `core::Error` if there is
/// anything in that place, `experiments::ProtocolError` for a study with problems.
void create_study_folder(const std::filesystem::path& study_file,
                         const std::filesystem::path& folder);

/// NAME.study, or NAME-2.study and so on, whichever does not exist yet, in $XDG_DATA_HOME/jnd
/// where that is set, in ~/jnd else.
[[nodiscard]] std::filesystem::path default_study_folder(const std::string& name);

/// "today", "yesterday", "tomorrow", "12 November", "12 November 2023": a day seen from
/// another, where the machine is. "" for a time before 2000: simulated sessions count from
/// 1970.
[[nodiscard]] std::string day_in_words(std::int64_t time_ns, std::int64_t now_ns);
/// " at 16:05", where the machine is.
[[nodiscard]] std::string hour_in_words(std::int64_t time_ns);

}  // namespace jnd::app
