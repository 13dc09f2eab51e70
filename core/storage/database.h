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
  /// An empty one in memory.
  Database();
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);
  /// Folds the write-ahead log into the file and empties it, so that the file alone is all
  /// there is. Throws `Error` while another program reads.
  void checkpoint();
  /// Replaces the content of `target` by this one's, as it is at one moment, whoever
  /// writes to it meanwhile.
  void copy_to(Database& target) const;
  /// Throws `Error` if the file is no longer where it was opened: whatever is written from then
  /// on may be seen by nobody.
  void require_in_place() const;
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  [[nodiscard]] sqlite3* handle() const noexcept { return handle_; }
  /// Throws what SQLite found wrong, in words for a person where it is the disk or the file.
  [[noreturn]] void fail(const std::string& doing) const;

 private:
  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

/// A prepared statement. `bind` takes the parameters in order; `step` returns whether there is
/// a row; `reset` makes it ready for the next use.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(const std::string& value);
  Statement& bind_bytes(std::string_view bytes);  ///< Must live until `reset`.
  template <typename T>
  Statement& bind(const std::optional<T>& value) {
    return value.has_value() ? bind(*value) : bind_null();
  }
  Statement& bind_null();

  [[nodiscard]] bool step();
  /// For statements without rows: step, then reset.
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

/// Whether there is no table in it yet: just made, by a program that may have died since.
[[nodiscard]] bool is_empty(Database& database);

/// The scope is the transaction: `commit` is explicit, anything else rolls back.
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
