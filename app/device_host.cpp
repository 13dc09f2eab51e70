#include "device/plugin/device_host.h"

/// jnd-device-host: the process in which a driver runs. The program starts it; started by hand,
/// it does nothing.
int main() { return jnd::device::run_device_host(); }
