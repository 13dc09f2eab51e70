#pragma once

#include <filesystem>
#include <functional>

namespace jnd::analysis {

/// A folder that is there as a whole or not at all. It is filled beside its place, as
/// NAME.unfinished-XXXXXX, or in it if there is an empty folder already, perhaps of another
/// disk, as NAME/unfinished-XXXXXX; it gets its name at the end, and what failed is removed. Of
/// a program that was killed only the unfinished one is left. Not real time.
class UnfinishedFolder {
 public:
  /// Throws `Error` if there is something in `folder` or at its place, or nothing can be
  /// written there; `MissingRight` if that is not allowed.
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
  [[noreturn]] void refuse(const std::string& reason) const;
  void publish_inside();

  std::filesystem::path folder_, place_, path_;
  bool inside_ = false;
  bool published_ = false;
};

/// Fills a new or empty folder and publishes it. An `Error` of `fill` is passed on with
/// `folder` for the unfinished place, and says that nothing was written.
void write_folder(const std::filesystem::path& folder,
                  const std::function<void(const UnfinishedFolder&)>& fill);

}  // namespace jnd::analysis
