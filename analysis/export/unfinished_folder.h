#pragma once

#include <filesystem>
#include <functional>

namespace jnd::analysis {

/// A folder that is written as a whole or not at all. It is filled beside its place, as
/// NAME.unfinished-XXXXXX. If there is an empty folder already, which may be on another disk,
/// it is filled inside, as NAME/unfinished-XXXXXX. It gets its name at the end, and is removed
/// after a failure. If the program is killed, only the unfinished folder remains.
/// Not real time.
class UnfinishedFolder {
 public:
  /// Throws `Error` if `folder` or its place contains something, or if nothing can be written
  /// there. Throws `MissingRight` if writing is not permitted.
  explicit UnfinishedFolder(const std::filesystem::path& folder);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  /// The folder to write to until it is published.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Makes a folder inside, with its parents. Throws `Error`.
  std::filesystem::path make(const std::filesystem::path& relative) const;
  /// Throws `Error` if something has appeared at its place meanwhile.
  void publish();

 private:
  [[noreturn]] void refuse(const std::string& reason) const;
  void publish_inside();

  std::filesystem::path folder_, place_, path_;
  bool inside_ = false;
  bool published_ = false;
};

/// Fills a new or empty folder and publishes it. An `Error` from `fill` is passed on with
/// `folder` in place of the unfinished path, and says that nothing was written.
void write_folder(const std::filesystem::path& folder,
                  const std::function<void(const UnfinishedFolder&)>& fill);

}  // namespace jnd::analysis
