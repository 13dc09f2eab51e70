#include "app/operator/remembered_stop.h"

#include <fcntl.h>
#include <unistd.h>

#include <cctype>
#include <string>
#include <string_view>
#include <system_error>

#include "app/language/words.h"
#include "app/operator/recent_studies.h"
#include "core/error.h"
#include "core/storage/sha256.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

/// A device's name such as "network:10.0.0.2:5000" contains characters that file names must not
/// have.
std::string file_name_for(std::string_view device) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string name = "stop_";
  for (const char letter : device) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) != 0 || letter == '_') {
      name += letter;
    } else {
      name += {'-', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return name;
}

/// The path of a driver may be longer than the name of a file may be.
fs::path file_for(const fs::path& folder, const std::string& device) {
  constexpr std::size_t kLongest = 200;
  const std::string name = file_name_for(device::canonical_name(device));
  return folder / (name.size() <= kLongest ? name : "stop_" + core::sha256(name));
}

/// What an earlier version of this program wrote, which went by the device's name as it was
/// typed.
fs::path file_as_typed(const fs::path& folder, const std::string& device) {
  return folder / file_name_for(std::string_view(device).substr(0, device.find(',')));
}

}  // namespace

void remember_stop(const fs::path& folder, const std::string& device) {
  if (folder.empty()) return;
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  const int file =
      ::open(file_for(folder, device).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return;
  (void)::fsync(file);
  ::close(file);
  const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  (void)::fsync(directory);
  ::close(directory);
}

void forget_stop(const fs::path& folder, const std::string& device) {
  if (folder.empty()) return;
  std::error_code ignored;
  fs::remove(file_for(folder, device), ignored);
  fs::remove(file_as_typed(folder, device), ignored);
}

bool is_stop_remembered(const fs::path& folder, const std::string& device) {
  std::error_code ignored;
  return !folder.empty() && (fs::exists(file_for(folder, device), ignored) ||
                             fs::exists(file_as_typed(folder, device), ignored));
}

void require_stop_released(const fs::path& folder, const std::string& device, bool releases) {
  if (releases || !is_stop_remembered(folder, device)) return;
  throw core::Error(
      tr("{}: expected its emergency stop to be released, found that it was pressed in an "
         "earlier run and nobody has released it; see to the reason, then release it in the "
         "window or add --release-stop",
         device));
}

fs::path stops_folder() {
  const fs::path recent = RecentStudies::default_file();
  return recent.empty() ? fs::path() : recent.parent_path();
}

}  // namespace jnd::app
