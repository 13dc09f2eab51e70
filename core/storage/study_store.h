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
  std::string relative_path;  ///< Seen from the study folder; "" if nobody knows.
};

/// What was measured of a device, as it was when a session began on it: text that storage never
/// looks into.
struct DeviceProfileRow {
  std::string sha256;
  std::string text;
};

/// What is left of the session of a participant who withdrew.
struct WithdrawalRow {
  std::int64_t session = 0;
  std::string participant;
  std::int64_t time_ns = 0;
};

/// A withdrawal that was interrupted, or has not reached every backup.
struct UnfinishedWithdrawal {
  std::string participant;
  bool erased = false;  ///< Nothing of the person is left in this folder.
};

/// Something that must not happen to a participant, and did: pain, a fright, an injury. Kept
/// for good, also after a withdrawal.
struct AdverseEventRow {
  std::int64_t session = 0;
  std::string participant;
  std::int64_t time_ns = 0;
  std::string text;
  std::int64_t adverse_event = 0;  ///< Its number in the study, from 1.
};

/// A look at a sequential study, as it was told.
struct SequentialLookRow {
  std::int64_t look = 0;  ///< From 1.
  std::string decision;   ///< "go_on" or "stop".
  std::int64_t time_ns = 0;
  std::string program_version;
  /// The sessions that came to it since the look before, by number.
  std::vector<std::int64_t> sessions;
};

/// Somebody opened the results of a sequential study before its end.
struct UnsealingRow {
  std::int64_t time_ns = 0;
  std::int64_t num_complete = 0;  ///< Complete sessions by then.
  std::string reason;
};

/// What a session has come to, as a line of a list.
struct SessionOverview {
  std::int64_t session = 0;
  std::int64_t num_trials = 0;   ///< Drawn so far.
  std::int64_t num_answers = 0;  ///< Trials whose answer stands, those set aside among them.
  /// Of the last event of the visit itself; acts on a session afterwards do not count.
  std::optional<std::int64_t> last_time_ns;
  bool completed = false;
  bool ended_early = false;
  bool is_set_aside = false;  ///< It has answers, and every one of them is set aside.

  /// It came to its end, and something of it counts.
  [[nodiscard]] bool counts() const { return completed && !is_set_aside; }
};

/// Everything that one act appends. All of it in one transaction, or none.
struct Commit {
  EventRow event;
  std::vector<DesignRow> design;
  std::optional<PresentationRow> presentation;
  std::optional<TrialRow> trial;
  std::vector<AnswerRow> answers;
  std::optional<QuestionAnswerRow> question_answer{};
};

/// How soon a commit is safe from a power cut.
enum class Durability {
  kEveryCommit,  ///< Synced before `append` returns. The only choice with a person.
  kAtClose,      ///< Simulated sessions, which their seed can repeat.
};

/// The study folder NAME.study/: `study.sqlite` (events and the rows projected from them) and
/// `recordings/`. Append only: no row is ever changed; a later event supersedes an earlier one.
/// One writer process at a time; safe to call from several threads. Not real time.
class StudyStore {
 public:
  enum class Mode { kReadOnly, kReadWrite, kCreate };

  /// Throws `Error`: folder missing or foreign, layout newer than this program, another writer.
  /// An older layout is brought up to date; read-only, in a copy in memory. Who only reads sees
  /// the study as it was when it was opened, whoever writes meanwhile.
  StudyStore(std::filesystem::path folder, Mode mode,
             Durability durability = Durability::kEveryCommit);
  ~StudyStore();
  StudyStore(const StudyStore&) = delete;
  StudyStore& operator=(const StudyStore&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const noexcept;
  /// Where the recording of a session lies: recordings/0001.sqlite.
  [[nodiscard]] std::filesystem::path recording_file(std::int64_t session) const;

  /// Keeps the text once, under its hash; returns the hash. Name and path are for people.
  std::string add_protocol(const std::string& file_name, const std::string& text,
                           const std::string& relative_path = "");
  [[nodiscard]] ProtocolRow protocol(const std::string& hash) const;
  /// In the order in which they were added.
  [[nodiscard]] std::vector<ProtocolRow> protocols() const;

  /// Keeps the text once, under its hash; returns the hash.
  std::string add_device_profile(const std::string& text);
  /// Throws `Error` if there is none of this hash.
  [[nodiscard]] DeviceProfileRow device_profile(const std::string& hash) const;
  /// In the order in which they were added.
  [[nodiscard]] std::vector<DeviceProfileRow> device_profiles() const;

  /// Adds a session with the next free number unless `row.session` names one; returns its
  /// number.
  std::int64_t add_session(SessionRow row);
  /// Appends one act; durable when it returns. Throws `Error` if the sequence is not the next
  /// one.
  void append(const Commit& commit);

  [[nodiscard]] std::vector<SessionRow> sessions() const;
  /// Throws `Error` if there is none of this number.
  [[nodiscard]] SessionRow session(std::int64_t number) const;
  /// One a session, by its number. Quick: no event is read.
  [[nodiscard]] std::vector<SessionOverview> overview() const;
  [[nodiscard]] std::vector<EventRow> events(std::int64_t session) const;
  /// With `include_voided` also those that were drawn for an answer which was taken back.
  [[nodiscard]] std::vector<DesignRow> design(std::int64_t session,
                                              bool include_voided = false) const;
  /// Answered trials that count: not superseded. With `include_excluded`, also those set aside.
  [[nodiscard]] std::vector<TrialRow> trials(std::int64_t session,
                                             bool include_excluded = false) const;
  /// The presentations of attempts whose answer stands. With `include_excluded`, those of
  /// trials that were set aside as well.
  [[nodiscard]] std::vector<PresentationRow> presentations(std::int64_t session,
                                                           bool include_excluded = false) const;
  /// Answers that count: the last one given to each item, each time that its stage came.
  [[nodiscard]] std::vector<AnswerRow> answers(std::int64_t session) const;
  /// Answers to questions after trials whose answer stands, in the order in which they were
  /// given. With `include_excluded`, of trials that were set aside as well.
  [[nodiscard]] std::vector<QuestionAnswerRow> question_answers(
      std::int64_t session, bool include_excluded = false) const;
  /// Whether the session was completed.
  [[nodiscard]] bool completed(std::int64_t session) const;
  /// Whether it was completed or ended early: nothing is left to resume.
  [[nodiscard]] bool finished(std::int64_t session) const;
  /// Whether somebody asked to see what a double-blind study hides.
  [[nodiscard]] bool unblinded() const;
  void add_unblinding(std::int64_t time_ns, const std::string& reason);
  /// On disk when it returns. Throws `Error` for a look that is not the next one.
  void add_look(const SequentialLookRow& look);
  [[nodiscard]] std::vector<SequentialLookRow> looks() const;
  /// On disk when it returns.
  void add_unsealing(const UnsealingRow& unsealing);
  /// In the order of time.
  [[nodiscard]] std::vector<UnsealingRow> unsealings() const;
  /// On disk when it returns. Throws `Error` for a session that is not there.
  void add_adverse_event(std::int64_t session, std::int64_t time_ns, const std::string& text);
  /// In the order in which they were reported.
  [[nodiscard]] std::vector<AdverseEventRow> adverse_events() const;
  /// The same in every backup of a study, and in no other study.
  [[nodiscard]] std::string study_id() const;
  [[nodiscard]] std::vector<WithdrawalRow> withdrawals() const;
  [[nodiscard]] std::vector<UnfinishedWithdrawal> unfinished_withdrawals() const;
  /// What SQLite's own check finds wrong with the database; empty for a sound one.
  [[nodiscard]] std::vector<std::string> database_damage() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::core
