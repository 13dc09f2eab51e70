#include "core/storage/study_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <mutex>

#include "core/storage/database.h"
#include "core/storage/sha256.h"
#include "core/storage/study_schema.h"

namespace jnd::core {
namespace {

constexpr std::int64_t kFormat = 1;

namespace fs = std::filesystem;

/// Held by the one process that may write to a study folder; freed by the system when it dies.
class WriterLock {
 public:
  explicit WriterLock(const fs::path& folder) {
    const fs::path file = folder / "writer.lock";
    descriptor_ = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor_ < 0) {
      throw Error(file.string() +
                  ": expected a folder that can be written, found: " + std::strerror(errno));
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw Error(folder.string() +
                  ": expected to be the only program that writes to this study, found another "
                  "one at work; close it first");
    }
  }
  ~WriterLock() { ::close(descriptor_); }
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int descriptor_ = -1;
};

Database::Mode database_mode(StudyStore::Mode mode, const fs::path& file) {
  if (mode == StudyStore::Mode::kReadOnly) return Database::Mode::kReadOnly;
  if (mode == StudyStore::Mode::kCreate && !fs::exists(file)) return Database::Mode::kCreate;
  return Database::Mode::kReadWrite;
}

/// Makes the folders if asked to; returns the database file.
fs::path prepared_file(const fs::path& folder, StudyStore::Mode mode) {
  if (mode == StudyStore::Mode::kCreate) {
    std::error_code error;
    fs::create_directories(folder / "recordings", error);
    if (error) {
      throw Error(folder.string() +
                  ": expected to make this folder, found: " + error.message());
    }
  } else if (!fs::exists(folder / "study.sqlite")) {
    throw Error(folder.string() +
                ": expected a study folder of jnd, found no study.sqlite in it");
  }
  return folder / "study.sqlite";
}

constexpr char kEventColumns[] =
    "session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick, last_tick, "
    "intensity, supersedes, data";
constexpr char kDesignColumns[] =
    "session, trial, stage, block, procedure, medium, quantity, repetition, position, "
    "intensity, "
    "reference_intensity, starting_intensity, target_percent";
constexpr char kPresentationColumns[] =
    "session, trial, attempt, presentation, sequence, interval, intensity, first_tick, "
    "last_tick, "
    "stroke_width_m, max_speed_m_per_s, mean_height_m, num_strokes, "
    "delivered_damping_n_s_per_m, "
    "commanded_damping_n_s_per_m, limited_ticks";
constexpr char kTrialColumns[] =
    "session, trial, attempt, sequence, block, procedure, medium, quantity, repetition, "
    "position, "
    "intensity, reference_intensity, starting_intensity, target_percent, response, "
    "response_time_s, num_presentations, num_steps, first_tick, last_tick";
constexpr char kAnswerColumns[] = "session, sequence, stage, item, answer";
constexpr char kSessionColumns[] =
    "session, participant, protocol_sha256, seed, cells, pilot, simulated, device, laboratory, "
    "program_version, realtime, rate_hz, recorded, started_time_ns";

std::string insert(const std::string& table, const std::string& columns) {
  std::string marks = "?";
  for (const char letter : columns) {
    if (letter == ',') marks += ", ?";
  }
  return "INSERT INTO " + table + " (" + columns + ") VALUES (" + marks + ")";
}

}  // namespace

struct StudyStore::Implementation {
  Implementation(fs::path the_folder, Mode mode, Durability durability)
      : folder(std::move(the_folder)),
        file(prepared_file(folder, mode)),
        lock(mode == Mode::kReadOnly ? nullptr : std::make_unique<WriterLock>(folder)),
        database(file, database_mode(mode, file), durability) {
    if (mode == Mode::kCreate && is_empty(database)) create();
    check_format();
    if (mode == Mode::kReadOnly) return;
    insert_event.emplace(database, insert("event", kEventColumns));
    insert_design.emplace(database, insert("design", kDesignColumns));
    insert_presentation.emplace(database, insert("presentation", kPresentationColumns));
    insert_trial.emplace(database, insert("trial", kTrialColumns));
    insert_answer.emplace(database, insert("answer", kAnswerColumns));
    last_sequence.emplace(database,
                          "SELECT COALESCE(MAX(sequence), 0) FROM event WHERE session = ?");
  }

  void create() {
    Transaction transaction(database);
    database.execute(kStudySchema);
    database.execute("INSERT INTO study_format VALUES (" + std::to_string(kFormat) +
                     ", 'jnd')");
    database.execute("PRAGMA application_id = 0x6a6e6431");  // "jnd1"
    transaction.commit();
  }

  void check_format() {
    Statement application(database, "PRAGMA application_id");
    if (!application.step() || application.integer(0) != 0x6a6e6431) {
      throw Error(file.string() + ": expected a study of jnd, found another kind of database");
    }
    Statement format(database, "SELECT MAX(version) FROM study_format");
    if (!format.step()) throw Error(file.string() + ": expected a format number, found none");
    if (format.integer(0) > kFormat) {
      throw Error(file.string() + ": expected format " + std::to_string(kFormat) +
                  " or older, found " + std::to_string(format.integer(0)) +
                  "; open it with a newer jnd");
    }
  }

  fs::path folder;
  fs::path file;
  std::unique_ptr<WriterLock> lock;
  mutable std::mutex mutex;
  mutable Database database;
  std::optional<Statement> insert_event, insert_design, insert_presentation, insert_trial,
      insert_answer, last_sequence;
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

std::string StudyStore::add_protocol(const std::string& file_name, const std::string& text) {
  const std::lock_guard guard(implementation_->mutex);
  const std::string hash = sha256(text);
  Statement statement(
      implementation_->database,
      "INSERT OR IGNORE INTO protocol (sha256, file_name, text) VALUES (?, ?, ?)");
  statement.bind(hash).bind(file_name).bind(text).run();
  return hash;
}

std::string StudyStore::protocol_text(const std::string& hash) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement statement(implementation_->database, "SELECT text FROM protocol WHERE sha256 = ?");
  if (!statement.bind(hash).step()) {
    throw Error(implementation_->file.string() + ": expected the protocol " +
                hash.substr(0, 12) + ", found none of that hash");
  }
  return statement.text(0);
}

std::int64_t StudyStore::add_session(SessionRow row) {
  const std::lock_guard guard(implementation_->mutex);
  Database& database = implementation_->database;
  Transaction transaction(database);
  if (row.session == 0) {
    Statement next(database, "SELECT COALESCE(MAX(session), 0) + 1 FROM session");
    if (next.step()) row.session = next.integer(0);
  }
  Statement statement(database, insert("session", kSessionColumns));
  statement.bind(row.session)
      .bind(row.participant)
      .bind(row.protocol_sha256)
      .bind(std::to_string(row.seed))
      .bind(row.cells)
      .bind(std::int64_t{row.pilot})
      .bind(std::int64_t{row.simulated})
      .bind(row.device)
      .bind(row.laboratory)
      .bind(row.program_version)
      .bind(row.realtime)
      .bind(row.rate_hz)
      .bind(std::int64_t{row.recorded})
      .bind(row.started_time_ns)
      .run();
  transaction.commit();
  return row.session;
}

void StudyStore::append(const Commit& commit) {
  const std::lock_guard guard(implementation_->mutex);
  Implementation& my = *implementation_;
  if (!my.insert_event) {
    throw Error(my.file.string() + ": expected to write an event, found it opened read-only");
  }
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
  my.insert_event->bind(event.session)
      .bind(event.sequence)
      .bind(event.kind)
      .bind(std::int64_t{event.version})
      .bind(event.time_ns)
      .bind(event.stage)
      .bind(event.trial)
      .bind(event.attempt)
      .bind(event.first_tick)
      .bind(event.last_tick)
      .bind(event.intensity)
      .bind(event.supersedes)
      .bind(event.data)
      .run();
  for (const DesignRow& row : commit.design) {
    my.insert_design->bind(row.session)
        .bind(row.trial)
        .bind(row.stage)
        .bind(row.block)
        .bind(row.procedure)
        .bind(row.medium)
        .bind(row.quantity)
        .bind(row.repetition)
        .bind(row.position)
        .bind(row.intensity)
        .bind(row.reference_intensity)
        .bind(row.starting_intensity)
        .bind(row.target_percent)
        .run();
  }
  if (commit.presentation) {
    const PresentationRow& row = *commit.presentation;
    my.insert_presentation->bind(row.session)
        .bind(row.trial)
        .bind(row.attempt)
        .bind(row.presentation)
        .bind(row.sequence)
        .bind(row.interval)
        .bind(row.intensity)
        .bind(row.first_tick)
        .bind(row.last_tick)
        .bind(row.stroke_width_m)
        .bind(row.max_speed_m_per_s)
        .bind(row.mean_height_m)
        .bind(row.num_strokes)
        .bind(row.delivered_damping_n_s_per_m)
        .bind(row.commanded_damping_n_s_per_m)
        .bind(row.limited_ticks)
        .run();
  }
  if (commit.trial) {
    const TrialRow& row = *commit.trial;
    my.insert_trial->bind(row.session)
        .bind(row.trial)
        .bind(row.attempt)
        .bind(row.sequence)
        .bind(row.block)
        .bind(row.procedure)
        .bind(row.medium)
        .bind(row.quantity)
        .bind(row.repetition)
        .bind(row.position)
        .bind(row.intensity)
        .bind(row.reference_intensity)
        .bind(row.starting_intensity)
        .bind(row.target_percent)
        .bind(row.response)
        .bind(row.response_time_s)
        .bind(row.num_presentations)
        .bind(row.num_steps)
        .bind(row.first_tick)
        .bind(row.last_tick)
        .run();
  }
  for (const AnswerRow& row : commit.answers) {
    my.insert_answer->bind(row.session)
        .bind(row.sequence)
        .bind(row.stage)
        .bind(row.item)
        .bind(row.answer)
        .run();
  }
  transaction.commit();
}

std::vector<SessionRow> StudyStore::sessions() const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 std::string("SELECT ") + kSessionColumns + " FROM session ORDER BY session");
  std::vector<SessionRow> all;
  while (rows.step()) {
    SessionRow row;
    row.session = rows.integer(0);
    row.participant = rows.text(1);
    row.protocol_sha256 = rows.text(2);
    const std::string seed = rows.text(3);
    std::from_chars(seed.data(), seed.data() + seed.size(), row.seed);
    row.cells = rows.text(4);
    row.pilot = rows.integer(5) != 0;
    row.simulated = rows.integer(6) != 0;
    row.device = rows.text(7);
    row.laboratory = rows.text(8);
    row.program_version = rows.text(9);
    row.realtime = rows.text(10);
    row.rate_hz = rows.number(11);
    row.recorded = rows.integer(12) != 0;
    row.started_time_ns = rows.integer(13);
    all.push_back(std::move(row));
  }
  return all;
}

std::vector<EventRow> StudyStore::events(std::int64_t session) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 std::string("SELECT ") + kEventColumns +
                     " FROM event WHERE session = ? ORDER BY sequence");
  rows.bind(session);
  std::vector<EventRow> all;
  while (rows.step()) {
    all.push_back({.session = rows.integer(0),
                   .sequence = rows.integer(1),
                   .kind = rows.text(2),
                   .version = static_cast<int>(rows.integer(3)),
                   .time_ns = rows.integer(4),
                   .stage = rows.optional_integer(5),
                   .trial = rows.optional_integer(6),
                   .attempt = rows.optional_integer(7),
                   .first_tick = rows.optional_integer(8),
                   .last_tick = rows.optional_integer(9),
                   .intensity = rows.optional_number(10),
                   .supersedes = rows.optional_integer(11),
                   .data = rows.text(12)});
  }
  return all;
}

std::vector<DesignRow> StudyStore::design(std::int64_t session) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 std::string("SELECT ") + kDesignColumns +
                     " FROM design WHERE session = ? ORDER BY trial");
  rows.bind(session);
  std::vector<DesignRow> all;
  while (rows.step()) {
    all.push_back({.session = rows.integer(0),
                   .trial = rows.integer(1),
                   .stage = rows.integer(2),
                   .block = rows.text(3),
                   .procedure = rows.text(4),
                   .medium = rows.text(5),
                   .quantity = rows.text(6),
                   .repetition = rows.integer(7),
                   .position = rows.integer(8),
                   .intensity = rows.optional_number(9),
                   .reference_intensity = rows.optional_number(10),
                   .starting_intensity = rows.optional_number(11),
                   .target_percent = rows.optional_number(12)});
  }
  return all;
}

std::vector<TrialRow> StudyStore::trials(std::int64_t session, bool include_excluded) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database, std::string("SELECT ") + kTrialColumns +
                                                " FROM trial_in_force WHERE session = ?" +
                                                (include_excluded ? "" : " AND NOT excluded") +
                                                " ORDER BY trial, attempt");
  rows.bind(session);
  std::vector<TrialRow> all;
  while (rows.step()) {
    all.push_back({.session = rows.integer(0),
                   .trial = rows.integer(1),
                   .attempt = rows.integer(2),
                   .sequence = rows.integer(3),
                   .block = rows.text(4),
                   .procedure = rows.text(5),
                   .medium = rows.text(6),
                   .quantity = rows.text(7),
                   .repetition = rows.integer(8),
                   .position = rows.integer(9),
                   .intensity = rows.optional_number(10),
                   .reference_intensity = rows.optional_number(11),
                   .starting_intensity = rows.optional_number(12),
                   .target_percent = rows.optional_number(13),
                   .response = rows.optional_number(14),
                   .response_time_s = rows.optional_number(15),
                   .num_presentations = rows.integer(16),
                   .num_steps = rows.integer(17),
                   .first_tick = rows.integer(18),
                   .last_tick = rows.integer(19)});
  }
  return all;
}

std::vector<PresentationRow> StudyStore::presentations(std::int64_t session) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 std::string("SELECT ") + kPresentationColumns +
                     " FROM presentation_in_force WHERE session = ? AND NOT excluded"
                     " ORDER BY trial, attempt, presentation");
  rows.bind(session);
  std::vector<PresentationRow> all;
  while (rows.step()) {
    all.push_back({.session = rows.integer(0),
                   .trial = rows.integer(1),
                   .attempt = rows.integer(2),
                   .presentation = rows.integer(3),
                   .sequence = rows.integer(4),
                   .interval = rows.text(5),
                   .intensity = rows.number(6),
                   .first_tick = rows.integer(7),
                   .last_tick = rows.integer(8),
                   .stroke_width_m = rows.optional_number(9),
                   .max_speed_m_per_s = rows.optional_number(10),
                   .mean_height_m = rows.optional_number(11),
                   .num_strokes = rows.integer(12),
                   .delivered_damping_n_s_per_m = rows.optional_number(13),
                   .commanded_damping_n_s_per_m = rows.optional_number(14),
                   .limited_ticks = rows.integer(15)});
  }
  return all;
}

std::vector<AnswerRow> StudyStore::answers(std::int64_t session) const {
  const std::lock_guard guard(implementation_->mutex);
  Statement rows(implementation_->database,
                 std::string("SELECT ") + kAnswerColumns +
                     " FROM answer_in_force WHERE session = ? ORDER BY sequence, item");
  rows.bind(session);
  std::vector<AnswerRow> all;
  while (rows.step()) {
    all.push_back({.session = rows.integer(0),
                   .sequence = rows.integer(1),
                   .stage = rows.text(2),
                   .item = rows.text(3),
                   .answer = rows.text(4)});
  }
  return all;
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
