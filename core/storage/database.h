#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/storage/study_store.h"

struct sqlite3;
struct sqlite3_stmt;

namespace jnd::core {

/// One SQLite connection with the project's settings: write-ahead log, foreign keys, checked
/// results, files of mode 0600. Not thread-safe. Throws `Error` naming file, statement and
/// SQLite's reason. Not real time.
class Database {
 public:
  enum class Mode { kReadOnly, kReadWrite, kCreate };

  Database(const std::filesystem::path& file, Mode mode, Durability durability);
  /// Makes an empty database in memory.
  Database();
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);
  /// Folds the write-ahead log into the file and empties it, so that the file alone holds
  /// everything. Throws `Error` while another program reads.
  void checkpoint();
  /// Replaces the content of `target` by this database's content as it is at one moment,
  /// whoever writes to it meanwhile.
  void copy_to(Database& target) const;
  /// Throws `Error` if the file is no longer where it was opened, because whatever is written
  /// from then on may never be seen.
  void require_in_place() const;
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  [[nodiscard]] sqlite3* handle() const noexcept { return handle_; }
  /// Throws what SQLite found wrong. The message is in words for a person if the disk or the
  /// file is the cause.
  [[noreturn]] void fail(const std::string& doing) const;

 private:
  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

/// A prepared statement. `bind` sets the next parameter, `step` returns whether there is a row,
/// and `reset` makes the statement ready for its next use.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(const std::string& value);
  Statement& bind_bytes(std::string_view bytes);  ///< The bytes must live until `reset`.
  template <typename T>
  Statement& bind(const std::optional<T>& value) {
    return value.has_value() ? bind(*value) : bind_null();
  }
  Statement& bind_null();

  [[nodiscard]] bool step();
  /// Steps and resets a statement that returns no rows.
  void run();
  void reset();

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double number(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::string_view bytes(int column) const;  ///< Valid until the next step.
  [[nodiscard]] std::optional<std::int64_t> optional_integer(int column) const;
  [[nodiscard]] std::optional<double> optional_number(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int next_parameter_ = 1;
};

/// Whether the database has no table yet, because a program made it just now or died meanwhile.
[[nodiscard]] bool is_empty(Database& database);

/// A transaction for the scope of the object. `commit` ends it; otherwise the destructor rolls
/// back.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace jnd::core
