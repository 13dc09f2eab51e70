#include "app/operator/recent_studies.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/language/words.h"
#include "core/error.h"
#include "core/storage/files.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path as_kept(const fs::path& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  // "a.study/" is the same as "a.study".
  return whole.has_filename() ? whole : whole.parent_path();
}

std::optional<RecentStudy> from_json(const json& entry) {
  if (!entry.is_object() || !entry.contains("path") || !entry.contains("opened_ns")) return {};
  if (!entry["path"].is_string() || !entry["opened_ns"].is_number_integer()) return {};
  RecentStudy study{.path = entry["path"].get<std::string>(),
                    .opened_ns = entry["opened_ns"].get<std::int64_t>()};
  if (!study.path.is_absolute()) return {};
  std::error_code ignored;
  study.exists = fs::exists(study.path, ignored);
  return study;
}

/// None if JSON cannot represent a path.
std::optional<std::string> text_of(const std::vector<RecentStudy>& studies) try {
  json list = json::array();
  for (const RecentStudy& study : studies) {
    list.push_back({{"path", study.path.string()}, {"opened_ns", study.opened_ns}});
  }
  return json{{"studies", std::move(list)}}.dump(1) + "\n";
} catch (const json::exception&) {
  return std::nullopt;
}

}  // namespace

fs::path RecentStudies::default_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && fs::path(state).is_absolute()) {
    return fs::path(state) / "jnd" / "recent.json";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') return {};
  return fs::path(home) / ".local" / "state" / "jnd" / "recent.json";
}

RecentStudies::RecentStudies(fs::path file) : file_(std::move(file)) {}

std::vector<RecentStudy> RecentStudies::list() const {
  std::ifstream stream(file_, std::ios::binary);
  const json document = json::parse(stream, nullptr, /*allow_exceptions=*/false);
  std::vector<RecentStudy> studies;
  if (!document.is_object() || !document.contains("studies")) return studies;
  for (const json& entry : document["studies"]) {
    std::optional<RecentStudy> study = from_json(entry);
    if (study && studies.size() < kMost) studies.push_back(std::move(*study));
  }
  return studies;
}

void RecentStudies::add(const fs::path& path, std::int64_t time_ns) const {
  const fs::path kept = as_kept(path);
  std::vector<RecentStudy> studies = list();
  std::erase_if(studies, [&](const RecentStudy& known) { return known.path == kept; });
  studies.insert(studies.begin(), {.path = kept, .opened_ns = time_ns});
  if (studies.size() > kMost) studies.resize(kMost);
  write(studies);
}

void RecentStudies::remove(const fs::path& path) const {
  const fs::path kept = as_kept(path);
  std::vector<RecentStudy> studies = list();
  const auto removed =
      std::erase_if(studies, [&](const RecentStudy& known) { return known.path == kept; });
  if (removed > 0) write(studies);
}

/// The new file is written beside the old one and then replaces it, so a reader finds one or
/// the other.
void RecentStudies::write(const std::vector<RecentStudy>& studies) const {
  const std::optional<std::string> text = text_of(studies);
  if (file_.empty() || !text) return;
  core::make_private_folders(file_.parent_path());
  const fs::path fresh = file_.string() + "." + std::to_string(::getpid());
  core::make_private_file(fresh);
  std::ofstream stream(fresh, std::ios::binary | std::ios::trunc);
  stream << *text;
  stream.close();
  std::error_code error;
  if (stream) fs::rename(fresh, file_, error);
  if (stream && !error) return;
  std::error_code ignored;
  fs::remove(fresh, ignored);
  throw core::Error(
      tr("{}: expected to keep the list of recent studies here, found {}; look at the folder's "
         "rights and its disk",
         file_.string(), error ? error.message() : tr("that it cannot be written")));
}

}  // namespace jnd::app
