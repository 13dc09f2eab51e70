#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace jnd::app {

/// One thing about this machine that a session needs, or is better off with.
struct MachineCheck {
  std::string name;
  bool ok = false;
  std::string found;
  std::string remedy;  ///< What mends it; "" if nothing needs to be.
};

/// Whether the system would grant SCHED_FIFO; what was in force is so again afterwards. Asks on
/// behalf of the calling thread. None of these is real time.
[[nodiscard]] MachineCheck check_realtime_priority();
/// Whether it would lock memory. Unlocks the process's memory: not while a loop runs.
[[nodiscard]] MachineCheck check_memory_lock();

/// Whether the machine can be kept from falling asleep in a session; it is not afterwards.
[[nodiscard]] MachineCheck check_sleep();

/// Everything `jnd doctor` tells, in its order.
[[nodiscard]] std::vector<MachineCheck> machine_checks();

/// Free for this user where `path` is or will be; nothing if the system does not say.
[[nodiscard]] std::optional<double> free_bytes(const std::filesystem::path& path);

}  // namespace jnd::app
