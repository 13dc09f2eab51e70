#include "analysis/export/unfinished_folder.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/missing_right.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

constexpr char kNothingWritten[] = "; nothing was written";

/// Whether there is an empty folder already.
bool is_there(const fs::path& folder) {
  std::error_code error;
  const fs::file_status link = fs::symlink_status(folder, error);
  if (link.type() == fs::file_type::not_found) return false;
  const std::string expected = folder.string() + ": expected a new or empty folder, found ";
  if (!fs::is_directory(folder, error)) {
    throw core::Error(expected + "something else of this name; nothing is overwritten");
  }
  const bool empty = fs::is_empty(folder, error);
  if (error) {
    throw core::MissingRight(folder.string() +
                             ": expected to look into this folder, found: " + error.message());
  }
  if (!empty) throw core::Error(expected + "files in it; nothing is overwritten");
  return true;
}

/// The path without a final slash and with links resolved, so that a folder can be renamed to
/// it.
fs::path place_of(const fs::path& folder) {
  std::error_code error;
  fs::path whole = fs::weakly_canonical(fs::absolute(folder), error);
  if (error) whole = fs::absolute(folder).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

[[noreturn]] void refuse_to_make(const fs::path& folder, const std::error_code& error) {
  const std::string sentence =
      folder.string() + ": expected to make this folder, found: " + error.message();
  if (error == std::errc::permission_denied || error == std::errc::operation_not_permitted) {
    throw core::MissingRight(sentence);
  }
  throw core::Error(sentence);
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at)) {
    text.replace(at, part.size(), by);
    at += by.size();
  }
  return text;
}

}  // namespace

UnfinishedFolder::UnfinishedFolder(const fs::path& folder)
    : folder_(folder), place_(place_of(folder)), inside_(is_there(folder)) {
  std::error_code error;
  if (!inside_) fs::create_directories(place_.parent_path(), error);
  if (error) refuse_to_make(folder, error);
  std::string pattern = inside_ ? (place_ / "unfinished-XXXXXX").string()
                                : place_.string() + ".unfinished-XXXXXX";
  if (::mkdtemp(pattern.data()) == nullptr) {
    refuse_to_make(folder, std::error_code(errno, std::generic_category()));
  }
  path_ = pattern;
  // The folder gets the usual permissions of this user, because mkdtemp makes it private.
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
  if (error) refuse_to_make(folder_ / relative, error);
  return path_ / relative;
}

void UnfinishedFolder::refuse(const std::string& reason) const {
  throw core::Error(folder_.string() +
                    ": expected to give the finished folder this name, found: " + reason +
                    kNothingWritten);
}

/// Moves everything one folder up, and back again after a failure.
void UnfinishedFolder::publish_inside() {
  std::error_code error;
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    names.push_back(entry.path().filename());
  }
  for (const auto& entry : fs::directory_iterator(place_, error)) {
    if (entry.path() != path_) refuse("files in it");
  }
  std::size_t num_moved = 0;
  while (!error && num_moved < names.size()) {
    fs::rename(path_ / names[num_moved], place_ / names[num_moved], error);
    if (!error) ++num_moved;
  }
  if (!error) {
    fs::remove(path_, error);
    return;
  }
  std::error_code ignored;
  for (std::size_t i = 0; i < num_moved; ++i) {
    fs::rename(place_ / names[i], path_ / names[i], ignored);
  }
  refuse(error.message());
}

void UnfinishedFolder::publish() {
  if (inside_) {
    publish_inside();
  } else {
    std::error_code error;
    fs::rename(path_, place_, error);
    if (error) refuse(error.message());
  }
  published_ = true;
}

void write_folder(const fs::path& folder,
                  const std::function<void(const UnfinishedFolder&)>& fill) {
  UnfinishedFolder unfinished(folder);
  try {
    fill(unfinished);
  } catch (const core::Error& error) {
    throw core::Error(replaced(error.what(), unfinished.path().string(), folder.string()) +
                      kNothingWritten);
  }
  unfinished.publish();
}

}  // namespace jnd::analysis
