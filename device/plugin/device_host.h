#pragma once

namespace jnd::device {

/// Does everything that the process of a driver does: loads the driver, opens its device,
/// answers the program, and closes the device. Forces last no longer than `command_timeout_s`
/// after the program has fallen silent, by this process's own clock. A second thread then halts
/// the device, even while the driver is stuck, and ends this process when the program has
/// ended. Returns the exit code: 0 if it was told to end, 1 if the program is gone, 2 if
/// something else than the program started it. Not real time.
int run_device_host() noexcept;

}  // namespace jnd::device
