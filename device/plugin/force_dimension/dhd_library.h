#ifndef JND_DHD_LIBRARY_H
#define JND_DHD_LIBRARY_H

/* The functions of Force Dimension's library that the driver uses, found in the user's own
 * libdhd.so (or libdrd.so, which has them as well) when it runs. Nothing of the maker's is
 * needed to compile this: the declarations are ours, and say what a caller has to pass.
 *
 * What each function does is told in our own words after what is public: the documentation of
 * the free Python bindings, which was adapted from the maker's
 * (github.com/EmDash00/forcedimension_core-python and -python-docs, for the versions 3.14 and
 * 3.16), and the declarations in the trees of CHAI3D and of WPI-AIM/ambf (versions 3.2 to 3.7).
 *
 * `id` is what opening gave. All functions may be called by any thread. Those of type int give
 * a negative number where they failed, and `dhdErrorGetLast` then says why, to each thread of
 * its own calls. Where versions differ in the type of a switch (int, unsigned char, bool), it
 * is an int here: the others read its lowest byte, in the calling conventions of x86-64 and of
 * 64-bit ARM. */

#include <stdbool.h>
#include <stddef.h>

enum {
  /* Results of functions that are no errors. */
  FD_TIME_GUARD = 1, /* The library has not asked the device: what it knew was recent enough. */
  FD_SATURATED = 2, /* A motor cannot give that much: all were scaled, the direction is kept. */

  FD_OFF = 0,
  FD_ON = 1,

  /* Why something failed. */
  FD_ERROR_COMMUNICATION = 2,
  FD_ERROR_CONTROLLER_BUSY = 3,
  FD_ERROR_NO_DRIVER = 4,
  FD_ERROR_NO_DEVICE = 5,
  FD_ERROR_NOT_AVAILABLE = 6,
  FD_ERROR_TIMEOUT = 7,
  FD_ERROR_DEVICE_NOT_READY = 12,
  FD_ERROR_DEVICE_IN_USE = 20,

  /* Places in what `dhdGetStatus` gives. */
  FD_STATUS_POWER = 0,
  FD_STATUS_CONNECTED = 1,
  FD_STATUS_RESET = 3, /* 1: it waits to be calibrated. */
  FD_STATUS_FORCE = 5, /* 1: motors give force; 0: they do not, and mostly brake. */
  FD_STATUS_ERROR = 9,
  FD_STATUS_GRAVITY = 10,         /* 1: it carries its own weight. */
  FD_STATUS_WRIST_INIT = 12,      /* 1: the wrist knows where it is. */
  FD_STATUS_FORCE_OFF_CAUSE = 14, /* What ended the force last. */
  /* Versions write 12 to 17 numbers; there has to be room for those to come. */
  FD_STATUS_ROOM = 64,

  FD_FORCE_OFF_BUTTON = 1,
  FD_FORCE_OFF_VELOCITY = 2,
  FD_FORCE_OFF_WATCHDOG = 3,
  FD_FORCE_OFF_SOFTWARE = 4,
  FD_FORCE_OFF_DEADMAN = 6,

  FD_VELOCITY_BY_WINDOW = 0, /* How velocities are estimated; the one way there is. */
  FD_MODE_VIRTUAL = 3        /* The device is a simulation of the maker's. */
};

struct dhd_library {
  /* Of the library: major, minor, release, revision. */
  void (*dhdGetSDKVersion)(int* major, int* minor, int* release, int* revision);

  int (*dhdErrorGetLast)(void);
  const char* (*dhdErrorGetLastStr)(void);

  /* How many devices are connected, also those that another program has. */
  int (*dhdGetDeviceCount)(void);
  /* How many of them nobody has. */
  int (*dhdGetAvailableCount)(void);
  /* These give the id of the device that is open from then on. The first available; one by its
   * place in the system's order, which stays until a device is added or removed; one by its
   * serial number. */
  int (*dhdOpen)(void);
  int (*dhdOpenID)(char index);
  int (*dhdOpenSerial)(int serial);
  int (*dhdClose)(char id);

  int (*dhdGetSystemType)(char id);
  const char* (*dhdGetSystemName)(char id);
  /* Devices without one give an error, and the Falcon 65535. */
  int (*dhdGetSerialNumber)(unsigned short* serial, char id);
  /* Of the controller in the device. */
  int (*dhdGetVersion)(double* version, char id);
  int (*dhdGetStatus)(int* status, char id);
  bool (*dhdHasWrist)(char id);
  bool (*dhdHasActiveWrist)(char id);
  bool (*dhdHasGripper)(char id);
  bool (*dhdHasActiveGripper)(char id);

  /* Begins a calibration, for which a person puts the end effector to its place of rest, and
   * waits for its end; after so many milliseconds it fails with FD_ERROR_TIMEOUT. */
  int (*dhdWaitForReset)(int timeout_ms, char id);

  /* The weight of arms and end effector is added to each force that is set, by this computer.
   */
  int (*dhdSetGravityCompensation)(int on, char id);
  /* Of another end effector than the maker's, kg. */
  int (*dhdSetEffectorMass)(double mass_kg, char id);
  /* The window over which a velocity is a difference of positions. */
  int (*dhdConfigLinearVelocity)(int window_ms, int mode, char id);

  /* Asks the device, or gives FD_TIME_GUARD. m, the device's frame: +x towards the person, +y
   * to the right, +z up, the origin in the middle of what it reaches (CHAI3D's page on haptic
   * devices; HAPI turns positions in the same way). */
  int (*dhdGetPosition)(double* x_m, double* y_m, double* z_m, char id);
  /* m/s. Fails with FD_ERROR_TIMEOUT where there were less than two positions in the window. */
  int (*dhdGetLinearVelocity)(double* x_m_per_s, double* y_m_per_s, double* z_m_per_s, char id);
  /* From the end effector's frame to the device's; rows of a rotation. */
  int (*dhdGetOrientationFrame)(double (*rotation)[3], char id);
  /* Opening, m. */
  int (*dhdGetGripperGap)(double* gap_m, char id);
  unsigned (*dhdGetButtonMask)(char id);

  /* Motors give force, or do not. */
  int (*dhdEnableForce)(int on, char id);
  /* Force on the hand, N, device's frame. It stands until the next one. 0 or FD_SATURATED. */
  int (*dhdSetForce)(double x_n, double y_n, double z_n, char id);
  int (*dhdSetForceAndTorqueAndGripperForce)(double x_n, double y_n, double z_n, double x_n_m,
                                             double y_n_m, double z_n_m, double gripper_n,
                                             char id);
  /* Short-circuited motors brake what moves, so that it does not fall hard. */
  int (*dhdSetBrakes)(int on, char id);
  /* No force, and brakes. */
  int (*dhdStop)(char id);

  /* For what belongs to the controller; of the whole library, not of a device. */
  int (*dhdEnableExpertMode)(void);
  int (*dhdDisableExpertMode)(void);

  /* What not every version has: null. */

  /* A limit of the library's own to the magnitude of what is set, N; below 0: none. */
  int (*dhdSetMaxForce)(double limit_n, char id);
  double (*dhdGetMaxForce)(char id);
  /* The controller ends the force when none was set for so long, in steps of 0.125 ms; 0: it
   * never does. Expert mode; controllers of version 3 or later. */
  int (*dhdSetWatchdog)(unsigned char steps, char id);
  int (*dhdGetWatchdog)(unsigned char* steps, char id);
  /* The time for which what is known counts as recent, microseconds; 0: none, -1: the maker's.
   * Expert mode. */
  int (*dhdSetTimeGuard)(int period_us, char id);
  /* How the device is connected. */
  int (*dhdGetComMode)(char id);
  /* Whether simulations of the maker's count as devices. */
  void (*dhdEnableSimulator)(bool on);
};

/* The library at this path, or the one that the system finds if it is empty. Null: there is
 * none that can be used, and `words` says in a line what was found and what to do. It stays
 * loaded, for what a library has started cannot be taken away safely. */
const struct dhd_library* load_dhd_library(const char* path, char* words, size_t words_size);

#endif
