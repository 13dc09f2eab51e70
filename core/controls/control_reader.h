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

/// Reads controls in a thread of its own: input devices that come and go, and serial boxes. It
/// opens a device when somebody listens to it. It takes a mapped device exclusively, so that a
/// pedal that acts as a keyboard does not also type. Not real time.
class ControlReader {
 public:
  struct SerialBoxPort {
    std::filesystem::path path;
    int baud = 9600;
  };
  struct Parameters {
    /// The thread watches this folder for devices that are plugged in.
    std::filesystem::path folder = "/dev/input";
    std::vector<SerialBoxPort> serial_boxes;
    /// Opens an input device. Tests pass a function of their own.
    std::function<std::unique_ptr<ControlSource>(const std::filesystem::path&)> open =
        open_input_device;
    /// The thread calls it at once when something is pressed or released.
    std::function<void(const ControlEvent&)> on_event;
    /// The thread calls it when a mapped device that was open is gone.
    std::function<void(const std::string& device)> on_lost;
    /// The thread calls it when the result of `devices` has changed.
    std::function<void()> on_change;
  };

  /// Which devices the thread listens to.
  enum class Listens {
    kToNobody,
    kToMapped,  ///< While a session runs.
    kToAll,     ///< While somebody assigns controls.
  };

  /// The current state of a device.
  struct DeviceState {
    /// The name as in `Control`, or the file's name if it could not be opened.
    std::string device;
    bool is_mapped = false;
    bool is_ours = false;      ///< Taken exclusively.
    bool is_keyboard = false;  ///< The device has the keys of a whole keyboard.
    /// A sentence that says why the device cannot be used; "" if it can.
    std::string problem;

    friend bool operator==(const DeviceState&, const DeviceState&) = default;
  };

  explicit ControlReader(Parameters parameters);
  ~ControlReader();
  ControlReader(const ControlReader&) = delete;
  ControlReader& operator=(const ControlReader&) = delete;

  /// Sets what the thread listens to from now on. Returns at once; the thread then opens and
  /// closes devices.
  void listen(Listens listens, const ControlMap& map);
  /// Returns the devices that are open or should be, as of the thread's last look.
  [[nodiscard]] std::vector<DeviceState> devices() const;
  /// Whether the thread has done everything that `listen` asked for. For tests.
  [[nodiscard]] bool is_settled() const;

 private:
  struct OpenDevice {
    std::filesystem::path path;
    bool is_box = false;
    /// The name as in `Control`; "" if the device has no controls or is not known.
    std::string name;
    std::unique_ptr<ControlSource> source;  ///< nullptr if the device is not open.
    bool is_ours = false;
    /// It failed while it was open: the device is gone, and its file will disappear, too.
    bool has_failed = false;
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
  // Only the thread uses these.
  Listens listens_ = Listens::kToNobody;
  ControlMap map_;
  std::vector<OpenDevice> devices_;
  bool has_folder_changed_ = false;
  std::thread thread_;
};

}  // namespace jnd::core
