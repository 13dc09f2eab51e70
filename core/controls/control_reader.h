#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/controls/control.h"
#include "core/controls/control_source.h"
#include "core/markers/serial_port.h"

namespace jnd::core {

/// Reads controls from a thread of its own: input devices that come and go, and serial boxes.
/// A device is opened where somebody listens to it, and taken for ourselves where it is mapped,
/// so that a pedal that is a keyboard does not type besides. Not real time.
class ControlReader {
 public:
  struct SerialBoxPort {
    std::filesystem::path path;
    int baud = 9600;
  };
  struct Parameters {
    std::filesystem::path folder = "/dev/input";  ///< Watched for what is plugged in.
    std::vector<SerialBoxPort> serial_boxes;
    /// Opens an input device; of another kind in tests.
    std::function<std::unique_ptr<ControlSource>(const std::filesystem::path&)> open =
        open_input_device;
    /// Called by the thread, at once: something was pressed or let go.
    std::function<void(const ControlEvent&)> on_event;
    /// Called by the thread: a mapped device that was open is gone.
    std::function<void(const std::string& device)> on_lost;
    std::function<void()> on_change;  ///< Likewise: `devices` tells something else.
  };

  /// Who is listened to.
  enum class Listens {
    kToNobody,
    kToMapped,  ///< While a session runs.
    kToAll,     ///< While somebody maps.
  };

  /// A device as it stands.
  struct DeviceState {
    std::string device;  ///< As in `Control`; the file's name where it could not be opened.
    bool is_mapped = false;
    bool is_ours = false;      ///< Taken for ourselves.
    bool is_keyboard = false;  ///< It has the keys of a whole keyboard.
    std::string problem;       ///< Why it cannot be used: a sentence; "" where it can.

    friend bool operator==(const DeviceState&, const DeviceState&) = default;
  };

  explicit ControlReader(Parameters parameters);
  ~ControlReader();
  ControlReader(const ControlReader&) = delete;
  ControlReader& operator=(const ControlReader&) = delete;

  /// From now on. Returns at once; the thread opens and closes.
  void listen(Listens listens, const ControlMap& map);
  /// Of the devices that are open or should be, since the thread has looked last.
  [[nodiscard]] std::vector<DeviceState> devices() const;
  /// What was asked for by `listen` is done: for tests.
  [[nodiscard]] bool is_settled() const;

 private:
  struct OpenDevice {
    std::filesystem::path path;
    bool is_box = false;
    std::string name;                       ///< As in `Control`; "": it is none, or not known.
    std::unique_ptr<ControlSource> source;  ///< nullptr: not open.
    bool is_ours = false;
    bool has_failed = false;  ///< While it was open: it is gone, and its file goes, too.
    std::string problem;
  };

  void run() noexcept;
  void wait_for_something();
  void take_wishes();
  void look_for_devices();
  void open(const std::filesystem::path& path, bool is_box,
            const std::function<std::unique_ptr<ControlSource>()>& make);
  void take(OpenDevice& device);
  void settle(OpenDevice& device);
  void tell_devices();
  [[nodiscard]] bool wants(const std::string& device) const;

  const Parameters parameters_;
  OwnedDescriptor wake_, watch_;
  mutable std::mutex mutex_;
  Listens wished_listens_ = Listens::kToNobody;
  ControlMap wished_map_;
  std::uint64_t num_wishes_ = 0, num_settled_ = 0;
  std::vector<DeviceState> told_;
  bool is_ending_ = false;
  // The thread's own.
  Listens listens_ = Listens::kToNobody;
  ControlMap map_;
  std::vector<OpenDevice> devices_;
  bool has_folder_changed_ = false;
  std::thread thread_;
};

}  // namespace jnd::core
