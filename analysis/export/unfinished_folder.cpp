#include "analysis/export/unfinished_folder.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

void require_free(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(folder, error);
  if (status.type() == fs::file_type::not_found) return;
  if (fs::is_directory(folder, error)) {
    const bool empty = fs::is_empty(folder, error);
    if (error) {
      throw core::Error(folder.string() +
                        ": expected to look into this folder, found: " + error.message());
    }
    if (empty) return;
  }
  throw core::Error(
      folder.string() +
      ": expected a new or empty folder, found files in it; nothing is overwritten");
}

/// Without a slash at the end, and where a link points to, so that it can be renamed to.
fs::path place_of(const fs::path& folder) {
  std::error_code error;
  fs::path whole = fs::weakly_canonical(fs::absolute(folder), error);
  if (error) whole = fs::absolute(folder).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

UnfinishedFolder::UnfinishedFolder(const fs::path& folder) : folder_(folder) {
  require_free(folder);
  const fs::path place = place_of(folder);
  std::error_code error;
  fs::create_directories(place.parent_path(), error);
  std::string pattern = place.string() + ".unfinished-XXXXXX";
  const bool made = !error && ::mkdtemp(pattern.data()) != nullptr;
  if (!made) {
    throw core::Error(folder.string() + ": expected to make this folder, found: " +
                      (error ? error.message() : std::strerror(errno)));
  }
  path_ = pattern;
  // As any folder of this user; mkdtemp makes it for its owner alone.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  fs::permissions(path_, static_cast<fs::perms>(0777 & ~mask), error);
}

UnfinishedFolder::~UnfinishedFolder() {
  std::error_code ignored;
  if (!published_) fs::remove_all(path_, ignored);
}

fs::path UnfinishedFolder::make(const fs::path& relative) const {
  std::error_code error;
  fs::create_directories(path_ / relative, error);
  if (error) {
    throw core::Error((folder_ / relative).string() +
                      ": expected to make this folder, found: " + error.message());
  }
  return path_ / relative;
}

void UnfinishedFolder::publish() {
  std::error_code error;
  fs::rename(path_, place_of(folder_), error);
  if (error) {
    throw core::Error(folder_.string() +
                      ": expected to give the finished folder this name, found: " +
                      error.message() + "; nothing was written");
  }
  published_ = true;
}

}  // namespace jnd::analysis
