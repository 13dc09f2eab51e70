#include "core/storage/study_store.h"

#include <cstdio>
#include <mutex>

#include "core/storage/backup_mark.h"
#include "core/storage/database.h"
#include "core/storage/files.h"
#include "core/storage/row_statements.h"
#include "core/storage/sha256.h"
#include "core/storage/study_format.h"
#include "core/storage/writer_lock.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

/// Makes the folders if asked to, and returns the database file. A file that belongs to
/// something else is detected before anything is written.
fs::path prepared_file(const fs::path& folder, StudyStore::Mode mode) {
  fs::path file = folder / "study.sqlite";
  std::error_code error;
  if (mode != StudyStore::Mode::kCreate || fs::exists(file, error)) require_study(folder);
  if (mode != StudyStore::Mode::kReadOnly) require_no_backup(folder);
  if (mode == StudyStore::Mode::kCreate) make_private_folders(folder / "recordings");
  return file;
}

[[noreturn]] void refuse_empty(const fs::path& file) {
  throw Error(file.string() + ": expected a study of jnd, found an empty database");
}

/// Returns the database in this program's layout. An older database that is only read stays as
/// it is; a copy in memory is brought up to date instead.
std::unique_ptr<Database> opened(const fs::path& file, StudyStore::Mode mode,
                                 Durability durability) {
  if (mode == StudyStore::Mode::kReadOnly) {
    auto database = std::make_unique<Database>(file, Database::Mode::kReadOnly, durability);
    // The transaction begins with the first read, so that answers which come meanwhile cannot
    // contradict rows that were read before.
    database->execute("BEGIN");
    const std::int64_t format = study_format_of(*database);
    if (format == 0) refuse_empty(file);
    if (format == current_study_format()) return database;
    auto copy = std::make_unique<Database>();
    database->copy_to(*copy);
    bring_up_to_date(*copy);
    return copy;
  }
  const bool create = mode == StudyStore::Mode::kCreate;
  auto database = std::make_unique<Database>(
      file, create && !fs::exists(file) ? Database::Mode::kCreate : Database::Mode::kReadWrite,
      durability);
  if (!create && is_empty(*database)) refuse_empty(file);
  bring_up_to_date(*database);
  return database;
}

/// When the session began. Older programs did not keep it of a person's: its first event tells.
void find_start(Database& database, SessionRow& row) {
  if (row.started_time_ns != 0) return;
  Statement first(database,
                  "SELECT time_ns FROM event WHERE session = ? ORDER BY sequence LIMIT 1");
  if (first.bind(row.session).step()) row.started_time_ns = first.integer(0);
}

/// The rows of the view design_in_force, found in an order that the view leaves open: for each
/// drawn trial first the answers that were taken back, mostly none, by the index of their kind
/// (hence the +, which forbids the one of sequences: all events of a session), and the trial's
/// own answers only where it was drawn for such a one.
constexpr char kDesignInForce[] =
    "(SELECT d.* FROM design AS d WHERE NOT EXISTS"
    " (SELECT 1 FROM event AS undone CROSS JOIN design AS its"
    "  WHERE its.session = undone.session AND its.trial = undone.trial"
    "   AND undone.session = d.session AND undone.kind = 'answer_undone'"
    "   AND +undone.sequence > d.sequence"
    "   AND CASE WHEN its.stage = d.stage AND its.sequence < d.sequence THEN NOT EXISTS"
    "    (SELECT 1 FROM trial AS t"
    "     WHERE t.session = d.session AND t.trial = d.trial AND t.sequence < undone.sequence"
    "      AND NOT EXISTS (SELECT 1 FROM event AS later"
    "       WHERE later.session = t.session AND later.supersedes = t.sequence"
    "        AND later.sequence < undone.sequence)) END))";

}  // namespace

struct StudyStore::Implementation {
  Implementation(fs::path the_folder, Mode mode, Durability durability)
      : folder(std::move(the_folder)),
        file(prepared_file(folder, mode)),
        lock(mode == Mode::kReadOnly ? nullptr : std::make_unique<WriterLock>(folder)),
        owner(opened(file, mode, durability)),
        database(*owner) {
    if (mode == Mode::kReadOnly) return;
    insert_event.emplace(database, insert_into<EventRow>("event"));
    insert_design.emplace(database, insert_into<DesignRow>("design"));
    insert_presentation.emplace(database, insert_into<PresentationRow>("presentation"));
    insert_trial.emplace(database, insert_into<TrialRow>("trial"));
    insert_answer.emplace(database, insert_into<AnswerRow>("answer"));
    insert_question_answer.emplace(database, insert_into<QuestionAnswerRow>("question_answer"));
    last_sequence.emplace(database,
                          "SELECT COALESCE(MAX(sequence), 0) FROM event WHERE session = ?");
  }

  fs::path folder;
  fs::path file;
  std::unique_ptr<WriterLock> lock;
  mutable std::mutex mutex;
  std::unique_ptr<Database> owner;
  Database& database;
  std::optional<Statement> insert_event, insert_design, insert_presentation, insert_trial,
      insert_answer, insert_question_answer, last_sequence;
};

StudyStore::StudyStore(fs::path folder, Mode mode, Durability durability)
    : implementation_(std::make_unique<Implementation>(std::move(folder), mode, durability)) {}

StudyStore::~StudyStore() = default;

const fs::path& StudyStore::folder() const noexcept { return implementation_->folder; }

fs::path StudyStore::recording_file(std::int64_t session) const {
  char name[32];
  std::snprintf(name, sizeof name, "%04lld.sqlite", static_cast<long long>(session));
  return folder() / "recordings" / name;
}

std::string StudyStore::add_protocol(const std::string& file_name, const std::string& text,
                                     const std::string& relative_path) {
  const std::lock_guard guard(implementation_->mutex);
  std::string hash = sha256(text);
  Statement statement(implementation_->database,
                      "INSERT OR IGNORE INTO protocol (sha256, file_name, text, relative_path)"
                      " VALUES (?, ?, ?, ?)");
  statement.bind(hash).bind(file_name).bind(text).bind(relative_path).run();
  return hash;
}

ProtocolRow StudyStore::protocol(const std::string& hash) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement statement(implementation_->database,
                      "SELECT file_name, text, relative_path FROM protocol WHERE sha256 = ?");
  if (!statement.bind(hash).step()) {
    throw Error(implementation_->file.string() + ": expected the protocol " +
                hash.substr(0, 12) + ", found none of that hash");
  }
  return {.sha256 = hash,
          .file_name = statement.text(0),
          .text = statement.text(1),
          .relative_path = statement.text(2)};
}

std::vector<ProtocolRow> StudyStore::protocols() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 "SELECT sha256, file_name, text, relative_path FROM protocol ORDER BY rowid");
  std::vector<ProtocolRow> all;
  while (rows.step()) {
    all.push_back({.sha256 = rows.text(0),
                   .file_name = rows.text(1),
                   .text = rows.text(2),
                   .relative_path = rows.text(3)});
  }
  return all;
}

std::string StudyStore::add_device_profile(const std::string& text) {
  const std::lock_guard guard(implementation_->mutex);
  std::string hash = sha256(text);
  Statement(implementation_->database,
            "INSERT OR IGNORE INTO device_profile (sha256, text) VALUES (?, ?)")
      .bind(hash)
      .bind(text)
      .run();
  return hash;
}

DeviceProfileRow StudyStore::device_profile(const std::string& hash) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement statement(implementation_->database,
                      "SELECT text FROM device_profile WHERE sha256 = ?");
  if (!statement.bind(hash).step()) {
    throw Error(implementation_->file.string() + ": expected the device profile " +
                hash.substr(0, 12) + ", found none of that hash");
  }
  return {.sha256 = hash, .text = statement.text(0)};
}

std::vector<DeviceProfileRow> StudyStore::device_profiles() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 "SELECT sha256, text FROM device_profile ORDER BY rowid");
  std::vector<DeviceProfileRow> all;
  while (rows.step()) all.push_back({.sha256 = rows.text(0), .text = rows.text(1)});
  return all;
}

std::int64_t StudyStore::add_session(SessionRow row) {
  const std::lock_guard guard(implementation_->mutex);
  Database& database = implementation_->database;
  Transaction transaction(database);
  if (row.session == 0) {
    // The number of a withdrawn session is never given again.
    Statement next(database,
                   "SELECT COALESCE(MAX(session), 0) + 1 FROM"
                   " (SELECT session FROM session UNION SELECT session FROM withdrawal)");
    if (next.step()) row.session = next.integer(0);
    // Nor is the number of a recording whose session an older study.sqlite does not know.
    std::error_code error;
    while (fs::exists(recording_file(row.session), error)) ++row.session;
  }
  Statement statement(database, insert_into<SessionRow>("session"));
  insert(row, statement);
  transaction.commit();
  return row.session;
}

void StudyStore::append(const Commit& commit) {
  const std::lock_guard guard(implementation_->mutex);
  Implementation& my = *implementation_;
  if (!my.insert_event) {
    throw Error(my.file.string() + ": expected to write an event, found it opened read-only");
  }
  my.database.require_in_place();
  Transaction transaction(my.database);
  const EventRow& event = commit.event;
  if (!my.last_sequence->bind(event.session).step()) my.database.fail("last sequence");
  const std::int64_t last = my.last_sequence->integer(0);
  my.last_sequence->reset();
  if (event.sequence != last + 1) {
    throw Error(my.file.string() + ": session " + std::to_string(event.session) +
                ": expected event " + std::to_string(last + 1) + ", found " +
                std::to_string(event.sequence) + "; another program wrote to this session");
  }
  insert(event, *my.insert_event);
  for (const DesignRow& row : commit.design) {
    insert(row, *my.insert_design);
  }
  if (commit.presentation) {
    insert(*commit.presentation, *my.insert_presentation);
  }
  if (commit.trial) {
    insert(*commit.trial, *my.insert_trial);
  }
  for (const AnswerRow& row : commit.answers) {
    insert(row, *my.insert_answer);
  }
  if (commit.question_answer) {
    insert(*commit.question_answer, *my.insert_question_answer);
  }
  transaction.commit();
}

SessionRow StudyStore::session(std::int64_t number) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 select_from<SessionRow>("session") + " WHERE session = ?");
  if (rows.bind(number).step()) {
    SessionRow row = read_row<SessionRow>(rows);
    find_start(implementation_->database, row);
    return row;
  }
  throw Error(implementation_->folder.string() + ": expected session " +
              std::to_string(number) + ", found none of that number");
}

std::vector<SessionRow> StudyStore::sessions() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 select_from<SessionRow>("session") + " ORDER BY session");
  std::vector<SessionRow> all = read_rows<SessionRow>(rows);
  for (SessionRow& row : all) find_start(implementation_->database, row);
  return all;
}

std::vector<SessionOverview> StudyStore::overview() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(
      implementation_->database,
      "SELECT session,"
      " (SELECT COUNT(*) FROM " +
          std::string(kDesignInForce) +
          " AS d WHERE d.session = s.session),"
          " (SELECT COUNT(DISTINCT trial) FROM trial_in_force AS t WHERE t.session = "
          "s.session),"
          " (SELECT time_ns FROM event AS e WHERE e.session = s.session AND e.kind NOT IN"
          "   ('trial_excluded', 'trial_included', 'unblinded') AND NOT"
          "   (e.kind IN ('answer_corrected', 'note_added') AND EXISTS"
          "    (SELECT 1 FROM event AS its WHERE its.session = s.session AND its.kind IN"
          "     ('session_completed', 'session_ended_early') AND its.sequence < e.sequence))"
          "   ORDER BY sequence DESC LIMIT 1),"
          " EXISTS (SELECT 1 FROM event AS e WHERE e.session = s.session"
          "         AND e.kind = 'session_completed'),"
          " EXISTS (SELECT 1 FROM event AS e WHERE e.session = s.session"
          "         AND e.kind = 'session_ended_early'),"
          " EXISTS (SELECT 1 FROM trial_in_force AS t WHERE t.session = s.session)"
          " AND NOT EXISTS (SELECT 1 FROM trial_in_force AS t WHERE t.session = s.session"
          "                 AND NOT t.excluded)"
          " FROM session AS s ORDER BY session");
  std::vector<SessionOverview> all;
  while (rows.step()) {
    all.push_back({.session = rows.integer(0),
                   .num_trials = rows.integer(1),
                   .num_answers = rows.integer(2),
                   .last_time_ns = rows.optional_integer(3),
                   .completed = rows.integer(4) != 0,
                   .ended_early = rows.integer(5) != 0,
                   .is_set_aside = rows.integer(6) != 0});
  }
  return all;
}

std::vector<EventRow> StudyStore::events(std::int64_t session) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 select_from<EventRow>("event") + " WHERE session = ? ORDER BY sequence");
  rows.bind(session);
  return read_rows<EventRow>(rows);
}

std::vector<DesignRow> StudyStore::design(std::int64_t session, bool include_voided) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 select_from<DesignRow>(include_voided ? "design" : kDesignInForce) +
                     " WHERE session = ? ORDER BY trial");
  rows.bind(session);
  return read_rows<DesignRow>(rows);
}

std::vector<TrialRow> StudyStore::trials(std::int64_t session, bool include_excluded) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database, select_from<TrialRow>("trial_in_force") +
                                                " WHERE session = ?" +
                                                (include_excluded ? "" : " AND NOT excluded") +
                                                " ORDER BY trial, attempt");
  rows.bind(session);
  return read_rows<TrialRow>(rows);
}

std::vector<PresentationRow> StudyStore::presentations(std::int64_t session,
                                                       bool include_excluded) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 select_from<PresentationRow>("presentation") +
                     // This is like presentation_in_force, but lists the trials once. The view
                     // would search all of them for each presentation.
                     " WHERE session = ?1 AND (trial, attempt) IN"
                     " (SELECT trial, attempt FROM trial_in_force WHERE session = ?1" +
                     (include_excluded ? "" : " AND NOT excluded") +
                     ") ORDER BY trial, attempt, presentation");
  rows.bind(session);
  return read_rows<PresentationRow>(rows);
}

std::vector<AnswerRow> StudyStore::answers(std::int64_t session) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database, select_from<AnswerRow>("answer_in_force") +
                                                " WHERE session = ? ORDER BY sequence, item");
  rows.bind(session);
  return read_rows<AnswerRow>(rows);
}

std::vector<QuestionAnswerRow> StudyStore::question_answers(std::int64_t session,
                                                            bool include_excluded) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 select_from<QuestionAnswerRow>("question_answer") +
                     // This is like question_answer_in_force, but lists the trials once.
                     " WHERE session = ?1 AND (trial, attempt) IN"
                     " (SELECT trial, attempt FROM trial_in_force WHERE session = ?1" +
                     (include_excluded ? "" : " AND NOT excluded") + ") ORDER BY sequence");
  rows.bind(session);
  return read_rows<QuestionAnswerRow>(rows);
}

bool StudyStore::completed(std::int64_t session) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 "SELECT 1 FROM event WHERE session = ? AND kind = 'session_completed'");
  return rows.bind(session).step();
}

bool StudyStore::finished(std::int64_t session) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 "SELECT 1 FROM event WHERE session = ? "
                 "AND kind IN ('session_completed', 'session_ended_early')");
  return rows.bind(session).step();
}

bool StudyStore::unblinded() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 "SELECT 1 FROM unblinding UNION SELECT 1 FROM event WHERE kind = 'unblinded'");
  return rows.step();
}

void StudyStore::add_unblinding(std::int64_t time_ns, const std::string& reason) {
  const std::lock_guard guard(implementation_->mutex);
  Statement(implementation_->database, "INSERT INTO unblinding VALUES (?, ?)")
      .bind(time_ns)
      .bind(reason)
      .run();
}

void StudyStore::add_look(const SequentialLookRow& look) {
  const auto num_known = static_cast<std::int64_t>(looks().size());
  if (look.look != num_known + 1) {
    throw Error(folder().string() + ": expected look " + std::to_string(num_known + 1) +
                " as the next one, found look " + std::to_string(look.look));
  }
  const std::lock_guard guard(implementation_->mutex);
  Database& database = implementation_->database;
  Transaction transaction(database);
  Statement(database, "INSERT INTO sequential_look VALUES (?, ?, ?, ?)")
      .bind(look.look)
      .bind(look.decision)
      .bind(look.time_ns)
      .bind(look.program_version)
      .run();
  for (const std::int64_t session : look.sessions) {
    Statement(database, "INSERT INTO sequential_look_session VALUES (?, ?)")
        .bind(look.look)
        .bind(session)
        .run();
  }
  transaction.commit();
}

std::vector<SequentialLookRow> StudyStore::looks() const {
  const std::lock_guard guard(implementation_->mutex);
  std::vector<SequentialLookRow> all;
  Statement rows(implementation_->database,
                 "SELECT look, decision, time_ns, program_version FROM sequential_look"
                 " ORDER BY look");
  while (rows.step()) {
    all.push_back({.look = rows.integer(0),
                   .decision = rows.text(1),
                   .time_ns = rows.integer(2),
                   .program_version = rows.text(3),
                   .sessions = {}});
  }
  for (SequentialLookRow& look : all) {
    Statement sessions(implementation_->database,
                       "SELECT session FROM sequential_look_session WHERE look = ?"
                       " ORDER BY session");
    sessions.bind(look.look);
    while (sessions.step()) look.sessions.push_back(sessions.integer(0));
  }
  return all;
}

void StudyStore::add_unsealing(const UnsealingRow& unsealing) {
  const std::lock_guard guard(implementation_->mutex);
  Statement(implementation_->database, "INSERT INTO unsealing VALUES (?, ?, ?)")
      .bind(unsealing.time_ns)
      .bind(unsealing.num_complete)
      .bind(unsealing.reason)
      .run();
}

std::vector<UnsealingRow> StudyStore::unsealings() const {
  const std::lock_guard guard(implementation_->mutex);
  std::vector<UnsealingRow> all;
  Statement rows(implementation_->database,
                 "SELECT time_ns, num_complete, reason FROM unsealing ORDER BY rowid");
  while (rows.step()) {
    all.push_back(
        {.time_ns = rows.integer(0), .num_complete = rows.integer(1), .reason = rows.text(2)});
  }
  return all;
}

void StudyStore::add_adverse_event(std::int64_t session, std::int64_t time_ns,
                                   const std::string& text) {
  const std::string participant = this->session(session).participant;
  const std::lock_guard guard(implementation_->mutex);
  Statement(
      implementation_->database,
      "INSERT INTO adverse_event (session, participant, time_ns, text) VALUES (?, ?, ?, ?)")
      .bind(session)
      .bind(participant)
      .bind(time_ns)
      .bind(text)
      .run();
}

std::vector<AdverseEventRow> StudyStore::adverse_events() const {
  const std::lock_guard guard(implementation_->mutex);
  std::vector<AdverseEventRow> all;
  Statement rows(implementation_->database,
                 "SELECT session, participant, time_ns, text, adverse_event FROM adverse_event"
                 " ORDER BY adverse_event");
  while (rows.step()) {
    all.push_back({.session = rows.integer(0),
                   .participant = rows.text(1),
                   .time_ns = rows.integer(2),
                   .text = rows.text(3),
                   .adverse_event = rows.integer(4)});
  }
  return all;
}

std::string StudyStore::study_id() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database, "SELECT study_id FROM study_identity");
  return rows.step() ? rows.text(0) : "";
}

std::vector<WithdrawalRow> StudyStore::withdrawals() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 "SELECT session, participant, time_ns FROM withdrawal ORDER BY session");
  std::vector<WithdrawalRow> all;
  while (rows.step()) {
    all.push_back(
        {.session = rows.integer(0), .participant = rows.text(1), .time_ns = rows.integer(2)});
  }
  return all;
}

std::vector<UnfinishedWithdrawal> StudyStore::unfinished_withdrawals() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 "SELECT participant, state FROM withdrawal_step AS w WHERE state <> 'finished'"
                 " AND step = (SELECT MAX(step) FROM withdrawal_step"
                 " WHERE participant = w.participant) ORDER BY participant");
  std::vector<UnfinishedWithdrawal> all;
  while (rows.step()) {
    all.push_back({.participant = rows.text(0), .erased = rows.text(1) == "erased"});
  }
  return all;
}

std::vector<std::string> StudyStore::database_damage() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database, "PRAGMA integrity_check");
  std::vector<std::string> damage;
  while (rows.step()) {
    if (rows.text(0) != "ok") damage.push_back(rows.text(0));
  }
  return damage;
}

}  // namespace jnd::core
