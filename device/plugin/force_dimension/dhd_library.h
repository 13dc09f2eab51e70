#ifndef JND_DHD_LIBRARY_H
#define JND_DHD_LIBRARY_H

/* The functions of Force Dimension's library that the driver uses. They are looked up at run
 * time in the user's own libdhd.so (or libdrd.so, which has them as well). Nothing of the
 * maker's is needed to compile this: the declarations are ours, and say what a caller has to
 * pass.
 *
 * The descriptions are in our own words, based on public sources: the documentation of the
 * free Python bindings, which was adapted from the maker's
 * (github.com/EmDash00/forcedimension_core-python and -python-docs, for the versions 3.14
 * and 3.16), and the declarations in the trees of CHAI3D and of WPI-AIM/ambf (versions 3.2
 * to 3.7).
 *
 * `id` is the result of opening. Any thread may call any function. Functions of type int
 * return a negative number on failure, and `dhdErrorGetLast` then gives the reason, for each
 * thread that of its own calls. The type of a switch differs between versions (int, unsigned
 * char, bool). Here it is an int, of which the others read the lowest byte, in the calling
 * conventions of x86-64 and of 64-bit ARM. */

#include <stdbool.h>
#include <stddef.h>

enum {
  /* Results that are no errors. */
  /* The library did not ask the device, because its last answer was recent enough. */
  FD_TIME_GUARD = 1,
  /* A motor cannot give that much. All were scaled, so the direction is kept. */
  FD_SATURATED = 2,

  FD_OFF = 0,
  FD_ON = 1,

  /* Reasons of a failure. */
  FD_ERROR_COMMUNICATION = 2,
  FD_ERROR_CONTROLLER_BUSY = 3,
  FD_ERROR_NO_DRIVER = 4,
  FD_ERROR_NO_DEVICE = 5,
  FD_ERROR_NOT_AVAILABLE = 6,
  FD_ERROR_TIMEOUT = 7,
  FD_ERROR_DEVICE_NOT_READY = 12,
  FD_ERROR_DEVICE_IN_USE = 20,

  /* Indices in the result of `dhdGetStatus`. */
  FD_STATUS_POWER = 0,
  FD_STATUS_CONNECTED = 1,
  FD_STATUS_RESET = 3, /* 1: it has to be calibrated. */
  FD_STATUS_FORCE = 5, /* 1: the motors give force; 0: they do not, and mostly brake. */
  FD_STATUS_ERROR = 9,
  FD_STATUS_GRAVITY = 10,         /* 1: it compensates its own weight. */
  FD_STATUS_WRIST_INIT = 12,      /* 1: the wrist has been initialised. */
  FD_STATUS_FORCE_OFF_CAUSE = 14, /* What ended the force last. */
  /* Versions write 12 to 17 numbers. Later ones may write more. */
  FD_STATUS_ROOM = 64,

  FD_FORCE_OFF_BUTTON = 1,
  FD_FORCE_OFF_VELOCITY = 2,
  FD_FORCE_OFF_WATCHDOG = 3,
  FD_FORCE_OFF_SOFTWARE = 4,
  FD_FORCE_OFF_DEADMAN = 6,

  FD_VELOCITY_BY_WINDOW = 0, /* How velocities are estimated; the only way there is. */
  FD_MODE_VIRTUAL = 3        /* The device is a simulation of the maker's. */
};

struct dhd_library {
  /* Version of the library: major, minor, release, revision. */
  void (*dhdGetSDKVersion)(int* major, int* minor, int* release, int* revision);

  int (*dhdErrorGetLast)(void);
  const char* (*dhdErrorGetLastStr)(void);

  /* Returns how many devices are connected, including those that another program uses. */
  int (*dhdGetDeviceCount)(void);
  /* Returns how many of them no program uses. */
  int (*dhdGetAvailableCount)(void);
  /* These return the id of the device that they open: the first available one, one by its
   * index in the system's order, which stays until a device is added or removed, or one by
   * its serial number. */
  int (*dhdOpen)(void);
  int (*dhdOpenID)(char index);
  int (*dhdOpenSerial)(int serial);
  int (*dhdClose)(char id);

  int (*dhdGetSystemType)(char id);
  const char* (*dhdGetSystemName)(char id);
  /* Devices without a serial number give an error, and the Falcon 65535. */
  int (*dhdGetSerialNumber)(unsigned short* serial, char id);
  /* Version of the controller in the device. */
  int (*dhdGetVersion)(double* version, char id);
  int (*dhdGetStatus)(int* status, char id);
  bool (*dhdHasWrist)(char id);
  bool (*dhdHasActiveWrist)(char id);
  bool (*dhdHasGripper)(char id);
  bool (*dhdHasActiveGripper)(char id);

  /* Begins a calibration, for which a person puts the end effector to its place of rest, and
   * waits for its end. After `timeout_ms` it fails with FD_ERROR_TIMEOUT. */
  int (*dhdWaitForReset)(int timeout_ms, char id);

  /* Sets whether this computer adds the weight of arms and end effector to each force. */
  int (*dhdSetGravityCompensation)(int on, char id);
  /* For another end effector than the maker's, kg. */
  int (*dhdSetEffectorMass)(double mass_kg, char id);
  /* Sets the window over which positions are subtracted to get a velocity. */
  int (*dhdConfigLinearVelocity)(int window_ms, int mode, char id);

  /* Asks the device, or returns FD_TIME_GUARD. The position is in m, in the device's frame:
   * +x towards the person, +y to the right, +z up, with the origin in the middle of its
   * reach (CHAI3D's page on haptic devices; HAPI turns positions in the same way). */
  int (*dhdGetPosition)(double* x_m, double* y_m, double* z_m, char id);
  /* The velocity is in m/s. Fails with FD_ERROR_TIMEOUT if the window has less than two
   * positions. */
  int (*dhdGetLinearVelocity)(double* x_m_per_s, double* y_m_per_s, double* z_m_per_s, char id);
  /* Rotation from the end effector's frame to the device's, by rows. */
  int (*dhdGetOrientationFrame)(double (*rotation)[3], char id);
  /* Opening of the gripper, m. */
  int (*dhdGetGripperGap)(double* gap_m, char id);
  unsigned (*dhdGetButtonMask)(char id);

  /* Whether the motors give force. */
  int (*dhdEnableForce)(int on, char id);
  /* Sets the force on the hand, N, in the device's frame, until the next call. Returns 0 or
   * FD_SATURATED. */
  int (*dhdSetForce)(double x_n, double y_n, double z_n, char id);
  int (*dhdSetForceAndTorqueAndGripperForce)(double x_n, double y_n, double z_n, double x_n_m,
                                             double y_n_m, double z_n_m, double gripper_n,
                                             char id);
  /* Brakes by short-circuited motors, so that the device does not fall hard. */
  int (*dhdSetBrakes)(int on, char id);
  /* Ends the force and brakes. */
  int (*dhdStop)(char id);

  /* Expert mode is needed for settings of the controller. It is that of the whole library,
   * not of a device. */
  int (*dhdEnableExpertMode)(void);
  int (*dhdDisableExpertMode)(void);

  /* Null in versions that lack these functions. */

  /* Sets the library's own limit for the magnitude of a force, N; below 0 for none. */
  int (*dhdSetMaxForce)(double limit_n, char id);
  double (*dhdGetMaxForce)(char id);
  /* Sets the time after the last force at which the controller ends the force, in steps of
   * 0.125 ms; 0 for never. It needs expert mode, and a controller of version 3 or later. */
  int (*dhdSetWatchdog)(unsigned char steps, char id);
  int (*dhdGetWatchdog)(unsigned char* steps, char id);
  /* Sets the time for which an answer counts as recent, in microseconds; 0 for none, -1 for
   * the maker's. It needs expert mode. */
  int (*dhdSetTimeGuard)(int period_us, char id);
  /* Returns how the device is connected. */
  int (*dhdGetComMode)(char id);
  /* Sets whether the maker's simulations count as devices. */
  void (*dhdEnableSimulator)(bool on);
};

/* Returns the library at this path, or, if it is empty, the one that the system finds.
 * Returns null if there is none that can be used; `words` then says in one line what was
 * found and what to do. The library stays loaded, because what it has started cannot be
 * stopped safely. */
const struct dhd_library* load_dhd_library(const char* path, char* words, size_t words_size);

#endif
