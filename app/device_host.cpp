#include "device/plugin/device_host.h"

/// jnd-device-host: the process of a driver. The program starts it; by hand it does nothing.
int main() { return jnd::device::run_device_host(); }
