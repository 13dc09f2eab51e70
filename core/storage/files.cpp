#include "core/storage/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/storage/flight_record.h"
#include "core/storage/stream_file.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot(const fs::path& path, const char* expected) {
  throw Error(path.string() + ": expected to " + expected + ", found: " + std::strerror(errno));
}

fs::path above(const fs::path& path) {
  const fs::path parent =
      path.has_filename() ? path.parent_path() : path.parent_path().parent_path();
  return parent.empty() ? "." : parent;
}

void sync(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (descriptor < 0) cannot(path, "open this");
  // Some file systems cannot sync a folder and say so by EINVAL.
  const bool failed = ::fsync(descriptor) != 0 && errno != EINVAL;
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  if (failed) cannot(path, "write this to disk");
}

}  // namespace

void make_private_folders(const fs::path& folder) {
  if (fs::is_directory(folder)) return;
  const fs::path parent = above(folder);
  if (parent != folder) make_private_folders(parent);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) cannot(folder, "make this folder");
  if (!fs::is_directory(folder)) {
    errno = ENOTDIR;
    cannot(folder, "make this folder");
  }
  sync_folder(parent);
}

void make_private_file(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor < 0) cannot(file, "create this file");
  ::close(descriptor);
  sync_folder(above(file));
}

void sync_folder(const fs::path& folder) { sync(folder, O_DIRECTORY); }

void sync_file(const fs::path& file) { sync(file, 0); }

void copy_file_durably(const fs::path& source, const fs::path& target) {
  fs::path unfinished = target;
  unfinished += ".unfinished";
  std::error_code error;
  fs::copy_file(source, unfinished, fs::copy_options::overwrite_existing, error);
  if (!error)
    fs::permissions(unfinished, fs::perms::owner_read | fs::perms::owner_write, error);
  if (error) {
    throw Error(target.string() + ": expected to copy " + source.string() +
                " here, found: " + error.message());
  }
  sync_file(unfinished);
  fs::rename(unfinished, target);
  sync_folder(above(target));
}

void remove_recording(const fs::path& file) {
  std::vector<fs::path> files = flight_records(file);
  std::vector<fs::path> databases = stream_files(file);
  databases.push_back(file);
  for (const fs::path& database : databases) {
    for (const char* ending : {"", "-wal", "-shm"}) {
      files.emplace_back(database.string() + ending);
    }
  }
  bool removed = false;
  for (const fs::path& one : files) {
    std::error_code error;
    removed |= fs::remove(one, error);
    if (error) {
      throw Error(one.string() + ": expected to remove this file, found: " + error.message());
    }
  }
  if (removed) sync_folder(above(file));
}

}  // namespace jnd::core
