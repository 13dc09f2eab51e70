#include "core/controls/control_reader.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

namespace jnd::core {
namespace {

/// Interval at which the thread retries to take a device that still has keys held, and to open
/// a box that is missing.
constexpr int kBetweenTries_ms = 200;

/// Returns a descriptor that watches the folder, or -1 if the folder is missing or the system
/// allows no further watch.
int watch_of(const std::filesystem::path& folder) {
  const int watch = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  if (watch >= 0) {
    ::inotify_add_watch(watch, folder.c_str(), IN_CREATE | IN_ATTRIB | IN_DELETE | IN_MOVED_TO);
  }
  return watch;
}

void drain(int descriptor) {
  std::array<char, 4096> ignored;
  while (::read(descriptor, ignored.data(), ignored.size()) > 0) {
  }
}

}  // namespace

ControlReader::ControlReader(Parameters parameters)
    : parameters_(std::move(parameters)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      watch_(watch_of(parameters_.folder)),
      thread_([this] { run(); }) {}

ControlReader::~ControlReader() {
  {
    const std::lock_guard guard(mutex_);
    is_ending_ = true;
  }
  ::eventfd_write(wake_.get(), 1);
  thread_.join();
}

void ControlReader::listen(Listens listens, const ControlMap& map) {
  {
    const std::lock_guard guard(mutex_);
    wished_listens_ = listens;
    wished_map_ = map;
    ++num_wishes_;
  }
  ::eventfd_write(wake_.get(), 1);
}

std::vector<ControlReader::DeviceState> ControlReader::devices() const {
  const std::lock_guard guard(mutex_);
  return told_;
}

bool ControlReader::is_settled() const {
  const std::lock_guard guard(mutex_);
  return num_settled_ == num_wishes_;
}

void ControlReader::run() noexcept {
  try {
    for (;;) {
      std::uint64_t wish = 0;
      {
        const std::lock_guard guard(mutex_);
        if (is_ending_) return;
        wish = num_wishes_;
      }
      take_wishes();
      look_for_devices();
      for (OpenDevice& device : devices_) settle(device);
      tell_devices();
      {
        const std::lock_guard guard(mutex_);
        num_settled_ = wish;
      }
      wait_for_something();
    }
  } catch (const std::exception&) {
    // Memory ran out. The mapped controls are lost, and callers see no device.
    const std::lock_guard guard(mutex_);
    told_.clear();
  }
}

void ControlReader::take_wishes() {
  const std::lock_guard guard(mutex_);
  listens_ = wished_listens_;
  map_ = wished_map_;
}

bool ControlReader::wants(const std::string& device) const {
  return listens_ == Listens::kToAll || (listens_ == Listens::kToMapped && map_.names(device));
}

/// Closes devices that are gone or that nobody listens to, and opens new ones.
void ControlReader::look_for_devices() {
  const bool has_changed = std::exchange(has_folder_changed_, false);
  const bool listens = listens_ != Listens::kToNobody;
  const std::vector<InputDevice> there =
      listens ? input_devices(parameters_.folder) : std::vector<InputDevice>{};
  std::vector<std::string> lost;
  std::erase_if(devices_, [&](const OpenDevice& device) {
    const bool is_there =
        listens && (device.is_box ||
                    std::ranges::find(there, device.path, &InputDevice::path) != there.end());
    if (!is_there && listens && device.source && map_.names(device.name)) {
      lost.push_back(device.name);
    }
    if (!is_there) return true;
    if (device.source) return !wants(device.name);
    // Such a device is looked at again: it may have been mapped, replaced or allowed in the
    // meantime.
    return has_changed || (device.is_box && !device.problem.empty()) ||
           (!device.has_failed && !device.name.empty() && wants(device.name));
  });
  for (const std::string& device : lost) {
    if (parameters_.on_lost) parameters_.on_lost(device);
  }
  for (const InputDevice& device : there) {
    open(device.path, /*is_box=*/false, [&] { return parameters_.open(device.path); });
  }
  if (!listens) return;
  for (const SerialBoxPort& box : parameters_.serial_boxes) {
    open(box.path, /*is_box=*/true, [&] { return open_serial_box(box.path, box.baud); });
  }
}

void ControlReader::open(const std::filesystem::path& path, bool is_box,
                         const std::function<std::unique_ptr<ControlSource>()>& make) {
  if (std::ranges::find(devices_, path, &OpenDevice::path) != devices_.end()) return;
  OpenDevice device;
  device.path = path;
  device.is_box = is_box;
  try {
    device.source = make();
    if (device.source) device.name = device.source->device();
    if (!wants(device.name)) device.source.reset();
  } catch (const std::exception& error) {
    device.problem = error.what();
  }
  devices_.push_back(std::move(device));
}

/// Takes the device exclusively if it is mapped, and gives it back if it is not.
void ControlReader::settle(OpenDevice& device) {
  if (device.source == nullptr) return;
  const bool is_mapped = map_.names(device.name);
  if (is_mapped == device.is_ours) return;
  try {
    if (device.source->take_for_ourselves(is_mapped)) device.is_ours = is_mapped;
    device.problem.clear();
  } catch (const std::exception& error) {
    device.problem = error.what();
  }
}

void ControlReader::tell_devices() {
  std::vector<DeviceState> told;
  for (const OpenDevice& device : devices_) {
    if (device.source == nullptr && device.problem.empty())
      continue;  // Nobody listens to this
                 // device.
    DeviceState state{.device = device.name.empty() ? device.path.string() : device.name,
                      .is_ours = device.is_ours,
                      .problem = device.problem};
    state.is_mapped = map_.names(state.device);
    state.is_keyboard = device.source && device.source->is_keyboard();
    told.push_back(std::move(state));
  }
  {
    const std::lock_guard guard(mutex_);
    if (told_ == told) return;
    told_ = std::move(told);
  }
  if (parameters_.on_change) parameters_.on_change();
}

void ControlReader::take(OpenDevice& device) {
  try {
    for (const ControlEvent& event : device.source->take()) {
      if (parameters_.on_event) parameters_.on_event(event);
    }
  } catch (const std::exception& error) {
    device.source.reset();
    device.is_ours = false;
    device.has_failed = true;
    device.problem = error.what();
    if (map_.names(device.name) && parameters_.on_lost) parameters_.on_lost(device.name);
  }
}

void ControlReader::wait_for_something() {
  std::vector<pollfd> waits = {{.fd = wake_.get(), .events = POLLIN, .revents = 0},
                               {.fd = watch_.get(), .events = POLLIN, .revents = 0}};
  bool tries_again = false;
  std::vector<std::size_t> sources;
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    const OpenDevice& device = devices_[i];
    tries_again |= device.is_box && device.source == nullptr && !device.problem.empty();
    if (device.source == nullptr) continue;
    tries_again |= map_.names(device.name) != device.is_ours;
    waits.push_back({.fd = device.source->descriptor(), .events = POLLIN, .revents = 0});
    sources.push_back(i);
  }
  // The loop passes presses on until the wishes change, or a device comes or goes.
  for (;;) {
    const int num = ::poll(waits.data(), waits.size(), tries_again ? kBetweenTries_ms : -1);
    bool goes_round = num <= 0 || waits[0].revents != 0 || waits[1].revents != 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (waits[i + 2].revents == 0) continue;
      take(devices_[sources[i]]);
      goes_round |= devices_[sources[i]].source == nullptr;
    }
    if (!goes_round) continue;
    drain(wake_.get());
    has_folder_changed_ = waits[1].revents != 0;
    if (has_folder_changed_) drain(watch_.get());
    return;
  }
}

}  // namespace jnd::core
