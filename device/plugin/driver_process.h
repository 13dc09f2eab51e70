#pragma once

#include <sched.h>
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "device/plugin/driver_pages.h"

namespace jnd::device {

/// The process in which a driver runs, and the pages that it shares with this one. It is
/// started for each opening and ends with this object. The driver's stdout goes to stderr.
///
/// One thread may use it. Any thread may call `halt`, and while it is open another thread may
/// call `request` and `answer`.
class DriverProcess {
 public:
  struct Parameters {
    std::filesystem::path host;    ///< The program "jnd-device-host".
    std::filesystem::path driver;  ///< The driver's shared object.
    std::string options;           ///< Options of the driver.
    /// Beginning of a sentence about it: "device plugin hand.so".
    std::string place;
    double rate_hz = 1000.0;
    double load_patience_s = 5.0;   ///< Time for the driver to load and describe itself, > 0.
    double close_patience_s = 2.0;  ///< Time for it to close before the process is killed, > 0.
  };

  /// Throws `core::Error`. Not real time.
  explicit DriverProcess(Parameters parameters);
  ~DriverProcess() { end(); }
  DriverProcess(const DriverProcess&) = delete;
  DriverProcess& operator=(const DriverProcess&) = delete;

  /// Returns the driver's description of its device, which is not opened. Throws
  /// `DeviceUnreachable` if the driver lacks something, crashes or does not return. Not real
  /// time.
  [[nodiscard]] jnd_device_description describe();

  /// Starts the driver and opens the device, within the time that the description allows.
  /// Throws like `describe`. Not real time.
  [[nodiscard]] jnd_device_description open(bool believes_simulated);

  /// Closes the device and ends the process, by force if necessary. Not real time.
  void end() noexcept;

  /// Publishes a request. With `wakes`, it wakes the process to answer what has increased. Real
  /// time.
  void request(const DriverRequest& request, bool wakes) noexcept;

  /// "its process crashed (Aborted)": where it ended without being asked to; else "". Not real
  /// time.
  [[nodiscard]] std::string words_of_end() const;

  /// The newest answer, as the process has written it, to be checked. False: none. Real time.
  [[nodiscard]] bool answer(DriverAnswer& answer) const noexcept {
    return host_page().answer.load(answer);
  }
  /// Returns how many reads were asked for since the one that was answered last. Any thread.
  [[nodiscard]] std::uint64_t num_unanswered() const noexcept;
  /// Waits until there may be another answer than that with this version, or until this
  /// monotonic time. Real time apart from the waiting.
  void wait_for_answer(std::uint32_t seen, std::int64_t deadline_ns) const noexcept;
  [[nodiscard]] std::uint32_t answer_version() const noexcept {
    return host_page().answer.version().load(std::memory_order_acquire);
  }

  /// Tells the process to halt the device, which it does even while the driver is stuck. Any
  /// thread. Real time.
  void halt() noexcept;

  /// Returns -1 if there is none. For tests and messages.
  [[nodiscard]] pid_t process() const noexcept { return process_; }

 private:
  void start(bool only_describes, bool believes_simulated);
  DriverReport wait_for(DriverPhase phase, double patience_s);
  [[nodiscard]] bool has_ended() noexcept;
  [[noreturn]] void give_up(const std::string& what);
  [[nodiscard]] ProgramPage& program_page() const noexcept {
    return *static_cast<ProgramPage*>(program_.memory());
  }
  [[nodiscard]] const HostPage& host_page() const noexcept {
    return *static_cast<const HostPage*>(host_.memory());
  }
  void clear_pages();

  Parameters parameters_;
  struct File {
    explicit File(int number) : number(number) {}
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    int number;
  };
  File program_file_, host_file_;
  MappedPage program_, host_;
  /// CPUs at the construction. Later the loop keeps one of them for itself.
  cpu_set_t cpus_{};
  pid_t process_ = -1;
  /// It was killed but still exists, so its pages must not be used again.
  bool is_stuck_ = false;
  int exit_status_ = 0;  ///< As from `waitpid`, of the process that ended last.
};

}  // namespace jnd::device
