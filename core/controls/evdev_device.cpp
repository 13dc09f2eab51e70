#include <fcntl.h>
#include <libevdev/libevdev.h>
#include <linux/input.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <utility>

#include "core/controls/control_source.h"
#include "core/controls/input_events.h"
#include "core/error.h"
#include "core/markers/serial_port.h"

namespace jnd::core {
namespace {

struct EvdevDeleter {
  void operator()(libevdev* device) const noexcept { ::libevdev_free(device); }
};
using Evdev = std::unique_ptr<libevdev, EvdevDeleter>;

bool has_key(const libevdev* device, unsigned code) {
  return ::libevdev_has_event_code(device, EV_KEY, code) != 0;
}

/// Whether it is a pointing device. Its clicks would count as answers.
bool points(const libevdev* device) {
  return ::libevdev_has_event_code(device, EV_REL, REL_X) != 0 || has_key(device, BTN_TOUCH) ||
         ::libevdev_has_property(device, INPUT_PROP_POINTER) != 0 ||
         ::libevdev_has_property(device, INPUT_PROP_DIRECT) != 0;
}

bool has_keys_or_hat(const libevdev* device) {
  return ::libevdev_has_event_type(device, EV_KEY) != 0 ||
         ::libevdev_has_event_code(device, EV_ABS, ABS_HAT0X) != 0;
}

bool has_a_keyboard(const libevdev* device) {
  constexpr std::array<unsigned, 6> kOfAKeyboard = {KEY_ESC, KEY_ENTER, KEY_SPACE,
                                                    KEY_Q,   KEY_M,     KEY_LEFTSHIFT};
  return std::ranges::all_of(kOfAKeyboard,
                             [&](unsigned code) { return has_key(device, code); });
}

std::string device_name(const libevdev* device) {
  char numbers[16];
  std::snprintf(numbers, sizeof numbers, "%04x:%04x ",
                static_cast<unsigned>(::libevdev_get_id_vendor(device)) & 0xffffU,
                static_cast<unsigned>(::libevdev_get_id_product(device)) & 0xffffU);
  const char* name = ::libevdev_get_name(device);
  return numbers + std::string(name != nullptr && *name != '\0' ? name : "unnamed");
}

class EvdevDevice final : public ControlSource {
 public:
  EvdevDevice(std::filesystem::path path, OwnedDescriptor descriptor, Evdev evdev)
      : path_(std::move(path)),
        descriptor_(std::move(descriptor)),
        evdev_(std::move(evdev)),
        name_(device_name(evdev_.get())),
        events_(name_) {
    for (unsigned code = 0; code < KEY_CNT; ++code) {
      int value = 0;
      if (::libevdev_fetch_event_value(evdev_.get(), EV_KEY, code, &value) != 0 && value != 0) {
        const char* name = ::libevdev_event_code_get_name(EV_KEY, code);
        if (name != nullptr) events_.note_down(name);
      }
    }
  }

  [[nodiscard]] const std::string& device() const noexcept override { return name_; }
  [[nodiscard]] int descriptor() const noexcept override { return descriptor_.get(); }
  [[nodiscard]] bool is_keyboard() const noexcept override {
    return has_a_keyboard(evdev_.get());
  }

  [[nodiscard]] std::vector<ControlEvent> take() override {
    std::array<std::byte, 64 * sizeof(input_event)> bytes;
    const ssize_t count = ::read(descriptor_.get(), bytes.data(), bytes.size());
    if (count > 0) return events_.take(std::span(bytes).first(static_cast<std::size_t>(count)));
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return {};
    throw Error(path_.string() + ": expected presses of " + name_ +
                ", found that it is gone; plug it in again");
  }

  [[nodiscard]] bool take_for_ourselves(bool wanted) override {
    if (wanted && events_.any_down()) return false;
    const int result = ::libevdev_grab(evdev_.get(), wanted ? LIBEVDEV_GRAB : LIBEVDEV_UNGRAB);
    if (result == 0) return true;
    throw Error(path_.string() + ": expected to have " + name_ + " for ourselves, found `" +
                std::strerror(-result) + "`; close the program that has it");
  }

 private:
  std::filesystem::path path_;
  OwnedDescriptor descriptor_;
  Evdev evdev_;
  std::string name_;
  InputEvents events_;
};

/// Returns the number after "event", or -1 for another file.
int number_of(const std::filesystem::path& path) {
  int number = -1;
  char rest = '\0';
  const std::string name = path.filename().string();
  return std::sscanf(name.c_str(), "event%d%c", &number, &rest) == 1 ? number : -1;
}

}  // namespace

std::vector<InputDevice> input_devices(const std::filesystem::path& folder) {
  std::vector<InputDevice> devices;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (number_of(entry.path()) < 0) continue;
    const std::string file = entry.path().filename().string();
    InputDevice device{.path = entry.path(), .name = file};
    // The name is read from here because every user may read this file.
    std::ifstream name("/sys/class/input/" + file + "/device/name");
    if (std::string line; std::getline(name, line) && !line.empty()) device.name = line;
    device.can_read = ::access(entry.path().c_str(), R_OK) == 0;
    devices.push_back(std::move(device));
  }
  std::ranges::sort(devices, {}, [](const InputDevice& one) { return number_of(one.path); });
  return devices;
}

std::unique_ptr<ControlSource> open_input_device(const std::filesystem::path& path) {
  OwnedDescriptor descriptor = open_port(path, O_RDONLY | O_NONBLOCK, "input");
  libevdev* made = nullptr;
  const int result = ::libevdev_new_from_fd(descriptor.get(), &made);
  Evdev evdev(made);
  if (result != 0) {
    throw Error(path.string() + ": expected an input device, found `" + std::strerror(-result) +
                "`");
  }
  if (points(evdev.get()) || !has_keys_or_hat(evdev.get())) return nullptr;
  const int clock = ::libevdev_set_clock_id(evdev.get(), CLOCK_MONOTONIC);
  if (clock != 0) {
    throw Error(path.string() + ": expected times of the monotonic clock, found `" +
                std::strerror(-clock) + "`");
  }
  return std::make_unique<EvdevDevice>(path, std::move(descriptor), std::move(evdev));
}

}  // namespace jnd::core
