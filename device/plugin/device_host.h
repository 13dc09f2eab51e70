#pragma once

namespace jnd::device {

/// What the process of a driver does, from its start to its end: loads the driver, opens its
/// device, answers the program, and closes it. Forces last no longer than `command_timeout_s`
/// after the one who computed them fell silent, by this process's own clock; a second thread
/// halts the device then, also while the driver is stuck, and ends this process when the
/// program has ended. Returns the exit code: 0 where it was told to end, 1 where the program is
/// gone, 2 where it was started by something else than the program. Not real time.
int run_device_host() noexcept;

}  // namespace jnd::device
