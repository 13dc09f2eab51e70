#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/storage/study_rows.h"

namespace jnd::core {

/// A study file as it was when a session began.
struct ProtocolRow {
  std::string sha256;
  std::string file_name;
  std::string text;
  std::string relative_path;  ///< Path relative to the study folder; "" if unknown.
};

/// The measured profile of a device, as it was when a session began on it. Storage never reads
/// inside of the text.
struct DeviceProfileRow {
  std::string sha256;
  std::string text;
};

/// What is left of a session whose participant withdrew.
struct WithdrawalRow {
  std::int64_t session = 0;
  std::string participant;
  std::int64_t time_ns = 0;
};

/// A withdrawal that was interrupted or has not reached every backup.
struct UnfinishedWithdrawal {
  std::string participant;
  bool erased = false;  ///< Nothing of the person is left in this folder.
};

/// Something bad that happened to a participant, such as pain, a fright or an injury. It is
/// kept for ever, also after a withdrawal.
struct AdverseEventRow {
  std::int64_t session = 0;
  std::string participant;
  std::int64_t time_ns = 0;
  std::string text;
  std::int64_t adverse_event = 0;  ///< Number in the study, from 1.
};

/// A look at the data of a sequential study, and its decision.
struct SequentialLookRow {
  std::int64_t look = 0;  ///< Counted from 1.
  std::string decision;   ///< "go_on" or "stop".
  std::int64_t time_ns = 0;
  std::string program_version;
  /// Numbers of the sessions that were added since the look before.
  std::vector<std::int64_t> sessions;
};

/// Notes that somebody opened the results of a sequential study before its end.
struct UnsealingRow {
  std::int64_t time_ns = 0;
  std::int64_t num_complete = 0;  ///< Complete sessions at that time.
  std::string reason;
};

/// The state of a session, as a line of a list.
struct SessionOverview {
  std::int64_t session = 0;
  std::int64_t num_trials = 0;   ///< Trials drawn so far.
  std::int64_t num_answers = 0;  ///< Trials whose answer stands, including those set aside.
  /// Time of the last event of the session itself. Later acts on the session do not count.
  std::optional<std::int64_t> last_time_ns;
  bool completed = false;
  bool ended_early = false;
  bool is_set_aside = false;  ///< It has answers, and every one of them is set aside.

  /// It came to its end, and something of it counts.
  [[nodiscard]] bool counts() const { return completed && !is_set_aside; }
};

/// Everything that one act appends. Either all of it is written, in one transaction, or
/// nothing.
struct Commit {
  EventRow event;
  std::vector<DesignRow> design;
  std::optional<PresentationRow> presentation;
  std::optional<TrialRow> trial;
  std::vector<AnswerRow> answers;
  std::optional<QuestionAnswerRow> question_answer{};
};

/// When a commit is safe from a power cut.
enum class Durability {
  /// The commit is synced before `append` returns. The only choice for sessions with a person.
  kEveryCommit,
  kAtClose,  ///< For simulated sessions, which can be repeated from their seed.
};

/// The study folder NAME.study/: `study.sqlite` (events and the rows projected from them) and
/// `recordings/`. It is append-only: no row is ever changed, and a later event supersedes an
/// earlier one. Only one process may write at a time. Several threads may call it. Not real
/// time.
class StudyStore {
 public:
  enum class Mode { kReadOnly, kReadWrite, kCreate };

  /// Throws `Error` if the folder is missing or foreign, if its layout is newer than this
  /// program, or if another process writes to it. An older layout is brought up to date; in
  /// read-only mode a copy in memory is. A reader sees the study as it was when it was opened,
  /// whoever writes meanwhile.
  StudyStore(std::filesystem::path folder, Mode mode,
             Durability durability = Durability::kEveryCommit);
  ~StudyStore();
  StudyStore(const StudyStore&) = delete;
  StudyStore& operator=(const StudyStore&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const noexcept;
  /// Returns the path of a session's recording, such as recordings/0001.sqlite.
  [[nodiscard]] std::filesystem::path recording_file(std::int64_t session) const;

  /// Stores the text once, under its hash, and returns the hash. Name and path are for people.
  std::string add_protocol(const std::string& file_name, const std::string& text,
                           const std::string& relative_path = "");
  [[nodiscard]] ProtocolRow protocol(const std::string& hash) const;
  /// Returns them in the order in which they were added.
  [[nodiscard]] std::vector<ProtocolRow> protocols() const;

  /// Stores the text once, under its hash, and returns the hash.
  std::string add_device_profile(const std::string& text);
  /// Throws `Error` if there is none with this hash.
  [[nodiscard]] DeviceProfileRow device_profile(const std::string& hash) const;
  /// Returns them in the order in which they were added.
  [[nodiscard]] std::vector<DeviceProfileRow> device_profiles() const;

  /// Adds a session with the next free number, unless `row.session` names one. Returns its
  /// number.
  std::int64_t add_session(SessionRow row);
  /// Appends one act, which is durable when the function returns. Throws `Error` if its
  /// sequence number is not the next one.
  void append(const Commit& commit);

  [[nodiscard]] std::vector<SessionRow> sessions() const;
  /// Throws `Error` if there is no session with this number.
  [[nodiscard]] SessionRow session(std::int64_t number) const;
  /// Returns one line for each session, ordered by number. Quick, because no event is read.
  [[nodiscard]] std::vector<SessionOverview> overview() const;
  [[nodiscard]] std::vector<EventRow> events(std::int64_t session) const;
  /// `include_voided` adds trials that were drawn for an answer that was taken back.
  [[nodiscard]] std::vector<DesignRow> design(std::int64_t session,
                                              bool include_voided = false) const;
  /// Returns the answered trials that count, that is, are not superseded. `include_excluded`
  /// adds those that were set aside.
  [[nodiscard]] std::vector<TrialRow> trials(std::int64_t session,
                                             bool include_excluded = false) const;
  /// Returns the presentations of attempts whose answer stands. `include_excluded` adds those
  /// of trials that were set aside.
  [[nodiscard]] std::vector<PresentationRow> presentations(std::int64_t session,
                                                           bool include_excluded = false) const;
  /// Answers that count: the last one given to each item, each time that its stage came.
  [[nodiscard]] std::vector<AnswerRow> answers(std::int64_t session) const;
  /// Returns the answers to questions after trials whose answer stands, in the order in which
  /// they were given. `include_excluded` adds those of trials that were set aside.
  [[nodiscard]] std::vector<QuestionAnswerRow> question_answers(
      std::int64_t session, bool include_excluded = false) const;
  /// Whether the session was completed.
  [[nodiscard]] bool completed(std::int64_t session) const;
  /// Whether the session was completed or ended early, so that nothing is left to resume.
  [[nodiscard]] bool finished(std::int64_t session) const;
  /// Whether somebody asked to see what a double-blind study hides.
  [[nodiscard]] bool unblinded() const;
  void add_unblinding(std::int64_t time_ns, const std::string& reason);
  /// The look is on disk when the function returns. Throws `Error` for a look that is not the
  /// next one.
  void add_look(const SequentialLookRow& look);
  [[nodiscard]] std::vector<SequentialLookRow> looks() const;
  /// The row is on disk when the function returns.
  void add_unsealing(const UnsealingRow& unsealing);
  /// Returns them in the order of time.
  [[nodiscard]] std::vector<UnsealingRow> unsealings() const;
  /// The event is on disk when the function returns. Throws `Error` for a session that does not
  /// exist.
  void add_adverse_event(std::int64_t session, std::int64_t time_ns, const std::string& text);
  /// Returns them in the order in which they were reported.
  [[nodiscard]] std::vector<AdverseEventRow> adverse_events() const;
  /// Returns an id that every backup of the study shares and no other study has.
  [[nodiscard]] std::string study_id() const;
  [[nodiscard]] std::vector<WithdrawalRow> withdrawals() const;
  [[nodiscard]] std::vector<UnfinishedWithdrawal> unfinished_withdrawals() const;
  /// Returns what SQLite's own check finds wrong with the database; empty for a sound one.
  [[nodiscard]] std::vector<std::string> database_damage() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::core
