#pragma once

#include <filesystem>

namespace jnd::core {

/// Held by the one process that may write to a study folder; freed by the system when it dies.
/// Throws `Error` naming the folder if another one holds it or the folder cannot be written.
class WriterLock {
 public:
  explicit WriterLock(const std::filesystem::path& folder);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace jnd::core
