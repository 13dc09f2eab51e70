#include "app/session/found_ports.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "core/controls/control_source.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

/// False for a place where a port could be but is none; the kernel gives it the type "0".
bool has_hardware(const fs::path& root, const std::string& port) {
  if (!port.starts_with("ttyS")) return true;
  std::string type;
  std::ifstream(root / "sys/class/tty" / port / "type") >> type;
  return !type.empty() && type != "0";
}

}  // namespace

const char* kind_words(FoundPort::Kind kind) noexcept {
  return kind == FoundPort::Kind::kInput    ? "input"
         : kind == FoundPort::Kind::kSerial ? "serial"
                                            : "parallel";
}

const char* group_of(FoundPort::Kind kind) noexcept {
  return kind == FoundPort::Kind::kInput    ? "input"
         : kind == FoundPort::Kind::kSerial ? "dialout"
                                            : "lp";
}

std::vector<FoundPort> found_ports(const fs::path& root) {
  using enum FoundPort::Kind;
  std::vector<FoundPort> found;
  for (const core::InputDevice& device : core::input_devices(root / "dev/input")) {
    found.push_back({kInput, device.path, device.name, device.can_read});
  }
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(root / "dev", ignored)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    const bool is_serial =
        name.starts_with("ttyUSB") || name.starts_with("ttyACM") || name.starts_with("ttyS");
    const bool is_parallel = name.starts_with("parport");
    if (!is_parallel && !(is_serial && has_hardware(root, name))) continue;
    found.push_back({is_parallel ? kParallel : kSerial, file, "",
                     ::access(file.c_str(), R_OK | W_OK) == 0});
  }
  return found;
}

}  // namespace jnd::app
