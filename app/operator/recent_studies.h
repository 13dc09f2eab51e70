#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace jnd::app {

/// A study folder or file that was opened lately.
struct RecentStudy {
  std::filesystem::path path;  ///< Absolute.
  std::int64_t opened_ns = 0;  ///< Since 1970-01-01 UTC.
  bool exists = false;         ///< Still there.
};

/// What was opened lately, for the start of the program: paths and times, nothing out of the
/// studies, so that it cannot tell what a blind one hides. Kept in one small file, replaced
/// whole; a damaged one counts as empty. Not real time.
class RecentStudies {
 public:
  static constexpr std::size_t kMost = 12;

  /// In $XDG_STATE_HOME/jnd, or ~/.local/state/jnd where that is not set; "" without a home.
  [[nodiscard]] static std::filesystem::path default_file();

  /// Nothing is read or written yet.
  explicit RecentStudies(std::filesystem::path file = default_file());

  /// The newest first, at most `kMost`; those that vanished are marked.
  [[nodiscard]] std::vector<RecentStudy> list() const;
  /// Puts a path first. One that is not UTF-8 is left out. Throws `core::Error` if the file
  /// cannot be written: nothing to stop for.
  void add(const std::filesystem::path& path, std::int64_t time_ns) const;
  void remove(const std::filesystem::path& path) const;

 private:
  void write(const std::vector<RecentStudy>& studies) const;

  std::filesystem::path file_;
};

}  // namespace jnd::app
