#pragma once

#include <filesystem>

namespace jnd::analysis {

/// A folder that is there as a whole or not at all. It is filled beside its place, as
/// NAME.unfinished-XXXXXX, and gets its name at the end; what failed is removed. Of a program
/// that was killed only the unfinished one is left. Not real time.
class UnfinishedFolder {
 public:
  /// Throws `Error` if there is something in `folder`, or nothing can be written beside it.
  explicit UnfinishedFolder(const std::filesystem::path& folder);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  /// Where to write to until it is published.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Makes a folder in it, and those above. Throws `Error`.
  std::filesystem::path make(const std::filesystem::path& relative) const;
  /// Throws `Error` if somebody put something in its place meanwhile.
  void publish();

 private:
  std::filesystem::path folder_, path_;
  bool published_ = false;
};

}  // namespace jnd::analysis
