#include "app/operator/kept_controls.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "app/language/words.h"
#include "core/error.h"
#include "core/storage/files.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kControlKeys[] = {"action", "device", "control"};

}  // namespace

fs::path kept_controls_file() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && fs::path(config).is_absolute()) {
    return fs::path(config) / "jnd" / "controls.json";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') return {};
  return fs::path(home) / ".config" / "jnd" / "controls.json";
}

core::ControlMap kept_controls(const fs::path& file) {
  core::ControlMap map;
  std::ifstream stream(file, std::ios::binary);
  const json document = json::parse(stream, nullptr, /*allow_exceptions=*/false);
  if (!document.is_object() || !document.contains("controls")) return map;
  for (const json& row : document["controls"]) {
    bool is_row = row.is_object();
    for (const char* key : kControlKeys) {
      is_row = is_row && row.contains(key) && row[key].is_string();
    }
    if (!is_row) continue;
    try {
      map.set(row["action"].get<std::string>(),
              {row["device"].get<std::string>(), row["control"].get<std::string>()});
    } catch (const core::Error&) {
      // The row was written by another version of the program.
    }
  }
  return map;
}

/// The new file is written beside the old one and then replaces it, so a reader finds one or
/// the other.
void keep_controls(const fs::path& file, const core::ControlMap& map) {
  if (file.empty()) return;
  json rows = json::array();
  for (const core::ControlMap::Row& row : map.rows()) {
    rows.push_back({{kControlKeys[0], row.action},
                    {kControlKeys[1], row.control.device},
                    {kControlKeys[2], row.control.name}});
  }
  const std::string text =
      json{{"controls", std::move(rows)}}.dump(1, ' ', false, json::error_handler_t::replace) +
      "\n";
  core::make_private_folders(file.parent_path());
  const fs::path fresh = file.string() + "." + std::to_string(::getpid());
  core::make_private_file(fresh);
  std::ofstream stream(fresh, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) fs::rename(fresh, file, error);
  if (stream && !error) return;
  std::error_code ignored;
  fs::remove(fresh, ignored);
  throw core::Error(
      tr("{}: expected to keep here which pedal does what, found {}; look at the folder's "
         "rights and its disk",
         file.string(), error ? error.message() : tr("that it cannot be written")));
}

}  // namespace jnd::app
