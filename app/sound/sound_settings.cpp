#include "app/sound/sound_settings.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/error.h"
#include "core/storage/files.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr char kUsualOutput[] = "default";

/// The settings; an empty object if there is no file.
json read_settings(const fs::path& file) {
  if (file.empty() || !fs::exists(file)) return json::object();
  std::ifstream stream(file, std::ios::binary);
  json document = json::parse(stream, nullptr, /*allow_exceptions=*/false);
  const bool is_sound =
      document.is_object() &&
      (!document.contains("output") || document["output"].is_string()) &&
      (!document.contains("calibrations") || document["calibrations"].is_array());
  if (!is_sound) {
    throw core::Error(file.string() +
                      ": expected this machine's sound settings, found something else; mend "
                      "it, or move it away and calibrate anew (`jnd sound --calibrate`)");
  }
  return document;
}

/// The new file is written beside the old one and then replaces it, so a reader finds one or
/// the other.
void write_settings(const fs::path& file, const json& document) {
  if (file.empty()) {
    throw core::Error(
        "sound settings: expected a home folder or JND_SOUND_FILE to keep them in, found "
        "neither; set one of them");
  }
  core::make_private_folders(file.parent_path());
  const fs::path fresh = file.string() + "." + std::to_string(::getpid());
  core::make_private_file(fresh);
  std::ofstream stream(fresh, std::ios::binary | std::ios::trunc);
  stream << document.dump(2) << '\n';
  stream.close();
  std::error_code error;
  if (stream) {
    core::sync_file(fresh);
    fs::rename(fresh, file, error);
  }
  if (!stream || error) {
    std::error_code ignored;
    fs::remove(fresh, ignored);
    throw core::Error(file.string() + ": expected to keep the sound settings here, found " +
                      (error ? error.message() : std::string("that it cannot be written")) +
                      "; look at the folder's rights and its disk");
  }
  core::sync_folder(file.parent_path());
}

}  // namespace

fs::path SoundSettings::default_file() {
  if (const char* file = std::getenv("JND_SOUND_FILE"); file != nullptr && *file != '\0') {
    return file;
  }
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') return fs::path(config) / "jnd" / "sound.json";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') return {};
  return fs::path(home) / ".config" / "jnd" / "sound.json";
}

std::string SoundSettings::output() const {
  const json document = read_settings(file_);
  const std::string chosen = document.value("output", std::string());
  return chosen.empty() ? kUsualOutput : chosen;
}

std::optional<SoundCalibration> SoundSettings::calibration_of(const std::string& output) const {
  const json document = read_settings(file_);
  if (!document.contains("calibrations")) return std::nullopt;
  std::optional<SoundCalibration> last;
  for (const json& one : document["calibrations"]) {
    const bool is_one = one.is_object() && one.contains("output") &&
                        one["output"].is_string() && one.contains("full_scale_db_spl") &&
                        one["full_scale_db_spl"].is_number();
    if (!is_one || one["output"].get<std::string>() != output) continue;
    last = SoundCalibration{
        .output = output,
        .full_scale_db_spl = one["full_scale_db_spl"].get<double>(),
        .measured_on = one.contains("measured_on") && one["measured_on"].is_string()
                           ? one["measured_on"].get<std::string>()
                           : std::string()};
  }
  return last;
}

void SoundSettings::choose(const std::string& output) const {
  json document = read_settings(file_);
  document["output"] = output;
  write_settings(file_, document);
}

void SoundSettings::add(const SoundCalibration& calibration) const {
  json document = read_settings(file_);
  document["calibrations"].push_back({{"output", calibration.output},
                                      {"full_scale_db_spl", calibration.full_scale_db_spl},
                                      {"measured_on", calibration.measured_on}});
  write_settings(file_, document);
}

}  // namespace jnd::app
