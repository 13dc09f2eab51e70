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

/// A session that was neither completed nor ended: what can be resumed, and what is safe.
struct InterruptedSession {
  std::int64_t session = 0;
  std::string participant;
  /// The stage's title; "Block 1" where it could tell the level.
  std::string stage;
  /// The trial to be repeated, counted in its block; 0 outside of a block.
  int trial = 0;
  /// The number of the block's trials; 0 outside of a block.
  int num_trials = 0;
  /// The answers decide how many trials there are.
  bool num_is_expected = false;
  std::int64_t num_answers = 0;  ///< The answers that are on disk.
  double recorded_min = 0.0;     ///< The length of the recording on disk.
  /// Such as "today"; "" for a simulated session, which has no date.
  std::string when;
  bool pilot = false, simulated = false;
  std::string problem;  ///< Why the session cannot be read; "" otherwise.

  /// A sentence such as "P07 was interrupted in Group D, trial 23 of 40".
  [[nodiscard]] std::string sentence() const;
  /// A sentence such as "62 answers and 38 minutes of recording are safe on disk".
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
  /// The assigned order in words; "" if the study has one cell only, or where it is hidden.
  std::string cells;
  std::int64_t num_answers = 0;
  /// The trials of the whole session, whether they are drawn yet or not.
  std::int64_t num_trials = 0;
  bool num_is_expected = false;  ///< The answers decide how many trials there are.
  std::string when;              ///< As in `InterruptedSession`.
};

/// A study folder for a card, and its sessions for a table. Plain data.
struct StudyFolder {
  std::filesystem::path folder;
  std::string name, title;  ///< The title is in the study's first language.
  experiments::Blinding blinding = experiments::Blinding::kNone;
  /// The study is double-blind and nobody has unblinded it, so nothing here tells a level or an
  /// order.
  bool hides_levels = false;
  /// Where the study file was read from; "" if nobody knows.
  std::filesystem::path study_file;
  /// Participants with a completed session, without pilots.
  int num_participants_done = 0;
  int num_sessions = 0;  ///< All sessions.
  int num_open = 0;
  int num_pilots = 0;
  bool simulated = false;  ///< At least one session is simulated.
  /// Such as "today", "yesterday" or "12 November"; "" if nobody knows.
  std::string last_session;
  /// This folder is a backup, which can be read but not changed.
  bool is_backup = false;
  std::vector<std::filesystem::path> backups;  ///< Known backups.
  /// At least one of them exists and is on another disk than the study.
  bool is_safe_elsewhere = false;
  std::vector<SessionLine> sessions;            ///< In the order of their numbers.
  std::vector<InterruptedSession> interrupted;  ///< The latest comes first.

  /// A summary such as "6 participants done, 1 open, last session today". For a backup, it says
  /// so first.
  [[nodiscard]] std::string summary() const;
};

/// Opens a folder. It reads no more than is shown, so a study of a hundred sessions opens in
/// well under a second. Throws `core::Error` if the folder is no study folder, is damaged, or
/// was written by a newer program. Not real time.
[[nodiscard]] StudyFolder open_study_folder(const std::filesystem::path& folder,
                                            std::int64_t now_ns = core::SystemClock().now_ns());

/// The study file of a folder: that of its last session, or the one with which it was created.
/// Throws `core::Error` if there is none.
[[nodiscard]] core::ProtocolRow protocol_in(const core::StudyStore& store);
/// The study that `protocol_in` finds. Throws `experiments::ProtocolError` if this program does
/// not understand it.
[[nodiscard]] experiments::Study study_in(const core::StudyStore& store);
/// Where the study file was read from, if the folder says it; "" otherwise.
[[nodiscard]] std::filesystem::path study_file_of(const core::StudyStore& store,
                                                  const core::ProtocolRow& protocol);

/// Makes a folder that contains the study and no session yet. Throws `core::Error` if anything
/// exists at that place, and `experiments::ProtocolError` for a study with problems.
void create_study_folder(const std::filesystem::path& study_file,
                         const std::filesystem::path& folder);

/// A folder that does not exist yet: NAME.study, or else NAME-2.study and so on. It is in
/// $XDG_DATA_HOME/jnd if that is set, otherwise in ~/jnd.
[[nodiscard]] std::filesystem::path default_study_folder(const std::string& name);

/// A day seen from another one, in the machine's time zone: "today", "yesterday", "tomorrow",
/// "12 November", "12 November 2023". "" for a time before 2000, because simulated sessions
/// count from 1970.
[[nodiscard]] std::string day_in_words(std::int64_t time_ns, std::int64_t now_ns);
/// The time of day in the machine's time zone, such as " at 16:05".
[[nodiscard]] std::string hour_in_words(std::int64_t time_ns);

}  // namespace jnd::app
