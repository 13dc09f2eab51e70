#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace jnd::app {

/// A study folder or file that was opened recently.
struct RecentStudy {
  std::filesystem::path path;  ///< An absolute path.
  std::int64_t opened_ns = 0;  ///< Nanoseconds since 1970-01-01 UTC.
  bool exists = false;         ///< The folder or file is still there.
};

/// The studies that were opened recently, for the start of the program. It stores paths and
/// times but nothing from the studies, so it cannot tell what a blind study hides. The list is
/// in one small file, which is replaced as a whole; a damaged file counts as empty. Not real
/// time.
class RecentStudies {
 public:
  static constexpr std::size_t kMost = 12;

  /// The file in $XDG_STATE_HOME/jnd, or in ~/.local/state/jnd if that is not set; "" if there
  /// is no home folder.
  [[nodiscard]] static std::filesystem::path default_file();

  /// Reads and writes nothing yet.
  explicit RecentStudies(std::filesystem::path file = default_file());

  /// The newest study comes first; there are at most `kMost`. Those that have vanished are
  /// marked.
  [[nodiscard]] std::vector<RecentStudy> list() const;
  /// Puts a path first; a path that is not UTF-8 is left out. Throws `core::Error` if the file
  /// cannot be written, which is no reason to stop.
  void add(const std::filesystem::path& path, std::int64_t time_ns) const;
  void remove(const std::filesystem::path& path) const;

 private:
  void write(const std::vector<RecentStudy>& studies) const;

  std::filesystem::path file_;
};

}  // namespace jnd::app
