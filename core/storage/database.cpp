#include "core/storage/database.h"

#include <sqlite3.h>
#include <unistd.h>

#include <cstdio>

#include "core/storage/files.h"

namespace jnd::core {
namespace {

/// Whether nobody can write here and no write-ahead log is left: a finished study on a
/// read-only disk, or in another user's folder.
bool is_archived(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (::access(folder.c_str(), W_OK) == 0) return false;
  std::error_code error;
  const auto log_bytes = std::filesystem::file_size(file.string() + "-wal", error);
  return error || log_bytes == 0;
}

/// Rolls back the journal of a program that was killed while it made this database. A reader
/// may not do so.
void roll_back(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file.string() + "-journal", error)) return;
  Database database(file, Database::Mode::kReadWrite, Durability::kEveryCommit);
  (void)is_empty(database);
}

/// Returns an address that tells SQLite that nothing will change. Otherwise it needs a writable
/// folder for its shared memory.
std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char letter : file.string()) {
    if (letter == '%' || letter == '?' || letter == '#') {
      char escaped[4];
      std::snprintf(escaped, sizeof escaped, "%%%02X", static_cast<unsigned char>(letter));
      uri += escaped;
    } else {
      uri += letter;
    }
  }
  return uri + "?immutable=1";
}

void require_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::is_regular_file(status)) return;
  const bool exists = std::filesystem::exists(status);
  throw Error(file.string() + ": expected a database of jnd, found " +
              (exists ? "something that is no file" : "no such file"));
}

}  // namespace

Database::Database(const std::filesystem::path& file, Mode mode, Durability durability)
    : file_(file) {
  if (mode == Mode::kCreate) {
    // SQLite would create the file with the umask's rights, but answers are for their owner
    // only.
    make_private_file(file);
  } else {
    require_file(file);
    if (mode == Mode::kReadOnly && !is_archived(file)) roll_back(file);
  }
  const int flags = mode == Mode::kReadOnly ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE;
  const bool archived = mode == Mode::kReadOnly && is_archived(file);
  const std::string name = archived ? immutable_uri(file) : file.string();
  if (sqlite3_open_v2(name.c_str(), &handle_,
                      flags | SQLITE_OPEN_FULLMUTEX | (archived ? SQLITE_OPEN_URI : 0),
                      nullptr) != SQLITE_OK) {
    try {
      fail("open");
    } catch (...) {
      sqlite3_close(handle_);
      throw;
    }
  }
  try {
    sqlite3_busy_timeout(handle_, 5000);
    execute("PRAGMA foreign_keys = ON");
    if (mode != Mode::kReadOnly) {
      execute("PRAGMA journal_mode = WAL");
      // FULL syncs the log at every commit, NORMAL only when it is folded into the database.
      execute(durability == Durability::kEveryCommit ? "PRAGMA synchronous = FULL"
                                                     : "PRAGMA synchronous = NORMAL");
    }
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::Database() : file_("a database in memory") {
  if (sqlite3_open_v2(":memory:", &handle_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_FULLMUTEX,
                      nullptr) != SQLITE_OK) {
    sqlite3_close(handle_);
    throw Error("expected memory for a database, found none");
  }
}

Database::~Database() { sqlite3_close_v2(handle_); }

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(sql);
}

void Database::fail(const std::string& doing) const {
  const std::string reason = sqlite3_errmsg(handle_);
  const std::string place = file_.string() + ": expected ";
  switch (sqlite3_errcode(handle_) & 0xff) {
    case SQLITE_FULL:
      throw Error(place +
                  "room to write, found the disk full; nothing acknowledged is lost: "
                  "make room, then go on");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw Error(place +
                  "to be let in within five seconds, found the database locked by "
                  "another program; close it, then go on");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      throw Error(place + "a database that can be written, found it read-only");
    case SQLITE_NOTADB:
      throw Error(place + "a database of jnd, found another kind of file");
    case SQLITE_CORRUPT:
      throw Error(place + "a sound database, found it damaged (" + reason +
                  "); keep it as it is and go on with a backup");
    case SQLITE_CANTOPEN:
    case SQLITE_IOERR:
      throw Error(place + "to read and write this file, found that the system refuses (" +
                  reason + "); look at its rights and its disk");
    default:
      throw Error(place + "SQLite to carry out \"" + doing.substr(0, 60) +
                  "\", found: " + reason);
  }
}

void Database::require_in_place() const {
  int has_moved = 0;
  sqlite3_file_control(handle_, "main", SQLITE_FCNTL_HAS_MOVED, &has_moved);
  if (has_moved == 0) return;
  throw Error(
      file_.string() +
      ": expected this file to stay in its place while a session runs, found it moved or "
      "deleted; put it back, then resume");
}

void Database::checkpoint() {
  Statement pragma(*this, "PRAGMA wal_checkpoint(TRUNCATE)");
  // If another connection held it up, the statement returns a row and no error.
  if (pragma.step() && pragma.integer(0) == 0) return;
  throw Error(
      file_.string() +
      ": expected to be the only program that has this database open, found another one "
      "reading it; close it, then run this again");
}

void Database::copy_to(Database& target) const {
  sqlite3_backup* copy = sqlite3_backup_init(target.handle_, "main", handle_, "main");
  if (copy == nullptr) target.fail("copy a database");
  // One step copies all pages, so the copy has one state of the database, whatever is written
  // meanwhile.
  constexpr int kMostTries = 500;
  int result = SQLITE_BUSY;
  for (int tries = 0; tries < kMostTries; ++tries) {
    result = sqlite3_backup_step(copy, -1);
    if (result != SQLITE_BUSY && result != SQLITE_LOCKED) break;
    sqlite3_sleep(10);
  }
  const int finished = sqlite3_backup_finish(copy);
  if (finished != SQLITE_OK) target.fail("copy a database");
  if (result != SQLITE_DONE) fail("copy a database");
}

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement_, nullptr) !=
      SQLITE_OK) {
    database.fail(sql);
  }
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::bind(std::int64_t value) {
  if (sqlite3_bind_int64(statement_, next_parameter_++, value) != SQLITE_OK) {
    database_.fail("bind");
  }
  return *this;
}

Statement& Statement::bind(double value) {
  if (sqlite3_bind_double(statement_, next_parameter_++, value) != SQLITE_OK) {
    database_.fail("bind");
  }
  return *this;
}

Statement& Statement::bind(const std::string& value) {
  if (sqlite3_bind_text(statement_, next_parameter_++, value.data(),
                        static_cast<int>(value.size()), SQLITE_TRANSIENT) != SQLITE_OK) {
    database_.fail("bind");
  }
  return *this;
}

Statement& Statement::bind_bytes(std::string_view bytes) {
  if (sqlite3_bind_blob(statement_, next_parameter_++, bytes.data(),
                        static_cast<int>(bytes.size()), SQLITE_STATIC) != SQLITE_OK) {
    database_.fail("bind");
  }
  return *this;
}

Statement& Statement::bind_null() {
  if (sqlite3_bind_null(statement_, next_parameter_++) != SQLITE_OK) database_.fail("bind");
  return *this;
}

bool Statement::step() {
  const int result = sqlite3_step(statement_);
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE) return false;
  const char* sql = sqlite3_sql(statement_);
  const std::string doing = sql != nullptr ? sql : "step";
  sqlite3_reset(statement_);
  next_parameter_ = 1;
  database_.fail(doing);
}

void Statement::run() {
  if (step()) {
    reset();
    throw Error(database_.file().string() + ": expected a statement without rows, found one");
  }
  reset();
}

void Statement::reset() {
  sqlite3_reset(statement_);
  next_parameter_ = 1;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double Statement::number(int column) const { return sqlite3_column_double(statement_, column); }

std::string Statement::text(int column) const {
  const auto* letters = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return letters == nullptr
             ? std::string()
             : std::string(letters,
                           static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
}

std::string_view Statement::bytes(int column) const {
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::optional<std::int64_t> Statement::optional_integer(int column) const {
  if (sqlite3_column_type(statement_, column) == SQLITE_NULL) return std::nullopt;
  return integer(column);
}

std::optional<double> Statement::optional_number(int column) const {
  if (sqlite3_column_type(statement_, column) == SQLITE_NULL) return std::nullopt;
  return number(column);
}

bool is_empty(Database& database) {
  Statement tables(database, "SELECT COUNT(*) FROM sqlite_master");
  return tables.step() && tables.integer(0) == 0;
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) return;
  // Nothing more can be done here about a failing rollback; SQLite rolls back when the database
  // is opened again.
  sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

}  // namespace jnd::core
