#pragma once

#include <filesystem>

namespace jnd::core {

/// A lock that only the one process holds that may write to a study folder. The system frees it
/// if the process dies. Throws `Error` naming the folder if another process holds it or the
/// folder cannot be written to.
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
