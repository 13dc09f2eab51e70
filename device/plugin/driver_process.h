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
/// started anew for each opening, and is gone when this is. The driver's stdout goes to stderr.
///
/// One thread, but for `halt`, and `request` and `answer`, which are another's while it is
/// open.
class DriverProcess {
 public:
  struct Parameters {
    std::filesystem::path host;    ///< The program "jnd-device-host".
    std::filesystem::path driver;  ///< Its shared object.
    std::string options;           ///< For the driver.
    std::string place;             ///< How a sentence about it begins: "device plugin hand.so".
    double rate_hz = 1000.0;
    double load_patience_s = 5.0;   ///< For the driver to be loaded and describe itself, > 0.
    double close_patience_s = 2.0;  ///< For it to close before the process is killed, > 0.
  };

  /// Throws `core::Error`. Not real time.
  explicit DriverProcess(Parameters parameters);
  ~DriverProcess() { end(); }
  DriverProcess(const DriverProcess&) = delete;
  DriverProcess& operator=(const DriverProcess&) = delete;

  /// What the driver says of its device, which is not opened. Throws `DeviceUnreachable`: what
  /// the driver lacks, that it crashed or that it does not return. Not real time.
  [[nodiscard]] jnd_device_description describe();

  /// Starts the driver and opens the device, for as long as it says that this may take. Throws
  /// as `describe` does. Not real time.
  [[nodiscard]] jnd_device_description open(bool believes_simulated);

  /// Closes the device and ends the process, by force where it does not go. Not real time.
  void end() noexcept;

  /// Wakes the process where `wakes`: it answers what has risen. Real time.
  void request(const DriverRequest& request, bool wakes) noexcept;

  /// "its process crashed (Aborted)": where it ended without being asked to; else "". Not real
  /// time.
  [[nodiscard]] std::string words_of_end() const;

  /// The newest answer, as the process has written it, to be checked. False: none. Real time.
  [[nodiscard]] bool answer(DriverAnswer& answer) const noexcept {
    return host_page().answer.load(answer);
  }
  /// Until there may be another answer than the one with this version, or this monotonic time
  /// is over. Real time but for the waiting.
  void wait_for_answer(std::uint32_t seen, std::int64_t deadline_ns) const noexcept;
  [[nodiscard]] std::uint32_t answer_version() const noexcept {
    return host_page().answer.version().load(std::memory_order_acquire);
  }

  /// Tells it to halt the device, which it does beside whatever it is stuck in. Any thread.
  /// Real time.
  void halt() noexcept;

  /// -1: none. For tests, and words.
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
  cpu_set_t cpus_{};  ///< When this was made: the loop keeps one of them free later.
  pid_t process_ = -1;
  bool is_stuck_ = false;  ///< Killed, and still there: its pages are not to be used again.
  int exit_status_ = 0;    ///< As `waitpid` has it, of the process that ended last.
};

}  // namespace jnd::device
