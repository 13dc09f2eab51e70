#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace jnd::app {

/// A property of this machine that a session needs, or that is good for it.
struct MachineCheck {
  std::string name;
  bool ok = false;
  std::string found;
  std::string remedy;  ///< What would remedy it; "" if nothing needs to be done.
};

/// Whether the system would grant SCHED_FIFO to the calling thread; the thread's policy is
/// restored afterwards. None of these functions is real time.
[[nodiscard]] MachineCheck check_realtime_priority();
/// Whether the system would lock memory. It unlocks the process's memory, so do not call it
/// while a loop runs.
[[nodiscard]] MachineCheck check_memory_lock();

/// Whether the machine can be kept from falling asleep in a session. The lock is released
/// afterwards.
[[nodiscard]] MachineCheck check_sleep();

/// Everything that `jnd doctor` tells, in its order.
[[nodiscard]] std::vector<MachineCheck> machine_checks();

/// The bytes that are free for this user at `path`, which need not exist yet; none if the
/// system does not say it.
[[nodiscard]] std::optional<double> free_bytes(const std::filesystem::path& path);

}  // namespace jnd::app
