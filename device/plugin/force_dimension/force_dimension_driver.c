/* A driver for the devices of Force Dimension (delta, omega, sigma, lambda) and the Novint
 * Falcon. It uses the maker's own library libdhd.so, which the user installs and which is
 * looked up at run time.
 *
 *     jnd devices --device plugin:force_dimension
 *     jnd loop --device plugin:force_dimension --seconds 10
 *
 * NOT TRIED ON HARDWARE: it was tried with a library that stands in for the maker's
 * (tests/device/plugin/force_dimension), and that behaves as the public documentation says,
 * as far as it says so. For options, for what is checked and for what is not known, see
 * docs/devices.md, "Force Dimension".
 *
 * The device is read once in each tick, within `read`, and commanded once, within `write`;
 * the driver has no thread of its own. Neither function uses heap or locks of ours. What the
 * library does inside is unknown: it says that any thread may call its functions, so it may
 * let a halt wait for a call that is stuck. That is why a real device must have a watchdog
 * in its controller, which ends the force 20 ms after the last command. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "dhd_library.h"
#include "jnd_device.h"

/* Properties that the library does not report. Force and reach are those that CHAI3D uses
 * for the model (src/devices/CDeltaDevices.cpp), with the reach as a box whose half width is
 * its radius. Models that CHAI3D does not know get less than any other. */
struct model {
  int type; /* As the library numbers them. */
  double max_force_n;
  double half_width_m;
};

static const struct model models[] = {
    {33, 12.0, 0.075},  /* omega.3 */
    {34, 12.0, 0.075},  /* omega.6, right */
    {36, 12.0, 0.075},  /* omega.6, left */
    {35, 12.0, 0.075},  /* omega.7, right */
    {37, 12.0, 0.075},  /* omega.7, left */
    {60, 8.0, 0.040},   /* Falcon */
    {63, 20.0, 0.150},  /* delta.3 */
    {64, 20.0, 0.150},  /* delta.6 */
    {104, 12.0, 0.075}, /* sigma.7, right */
    {105, 12.0, 0.075}, /* sigma.7, left */
    {106, 12.0, 0.090}, /* sigma.6+, right */
    {107, 12.0, 0.090}, /* sigma.6+, left */
    {206, 8.0, 0.040},  /* sigma.3: not from CHAI3D */
    {203, 8.0, 0.040},  /* lambda.3: not from CHAI3D */
    {108, 8.0, 0.040},  /* lambda.7, right: not from CHAI3D */
    {109, 8.0, 0.040},  /* lambda.7, left: not from CHAI3D */
};

/* Conservative, and the same for all models, because no public document has these values. */
static const double max_slew_n_per_s = 1000.0;
static const double max_speed_m_per_s = 2.0;
/* A period of the loop, and what USB takes in both directions. */
static const double closed_loop_delay_s = 0.002;
/* Rate of the loop that reads and commands. Over USB there may be up to 4000 in a second. */
static const double nominal_rate_hz = 1000.0;

/* 20 ms, as SAFETY.md demands of every controller. */
enum { WATCHDOG_STEPS = 160 };
/* How often the status is read, 1/s. */
static const double status_rate_hz = 100.0;
/* After the force was switched on or off, the library's status may be older than that for
 * this time. */
static const double status_patience_s = 0.050;

struct options {
  char library[1024];
  double device, serial; /* Below 0 if not chosen. */
  double wait_for_calibration_s;
  double effector_mass_kg; /* Below 0 for the maker's end effector. */
  double max_force_n;      /* At most the model's. */
  double velocity_window_ms;
  double time_guard_us; /* Below 0 for the maker's value. */
  double surface_z_m;   /* Height of jnd's z = 0 in the device's frame. */
  bool without_gravity_compensation, without_watchdog, with_simulator;
};

/* What is known of a connected device. */
struct connection {
  const struct dhd_library* dhd;
  char id;
  struct model model;
  bool has_wrist, has_gripper, is_virtual;
  /* It has motors that turn or grip, which must be told to give no force. */
  bool has_more_motors;
};

struct jnd_device {
  struct connection at;
  struct options options;
  double max_force_n;
  uint64_t num_reads, sample_number;
  uint64_t reads_per_status, next_status;
  double acted_n[3]; /* The last accepted force, in the workspace frame. */
  /* The newest position, in the device's frame, and the time when the library reported it,
   * s. */
  double known_m[3], known_s;
  bool is_fresh; /* Nothing has been written yet. */
  /* After any failure, no force is passed on before jnd has written zeros. jnd does the
   * same; this is for failures that it cannot know yet. */
  bool is_withholding;
  bool is_blind;      /* The last read failed. */
  bool is_enabled;    /* Nobody has switched the motors' force off. */
  bool may_switch_on; /* Neither a person nor a guard of the device has switched it off. */
  unsigned known_halts;
  /* Shared with the thread that halts. */
  atomic_uint num_halts;
  atomic_bool is_on; /* The motors give the force that is set. */
};

static char error_text[256] = "";

__attribute__((format(printf, 1, 2))) static int failed(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(error_text, sizeof error_text, format, arguments);
  va_end(arguments);
  return JND_DEVICE_FAILED;
}

/* Returns the library's words about its last failure in this thread. */
static const char* reason(const struct dhd_library* dhd) {
  const char* words = dhd->dhdErrorGetLastStr();
  return words == NULL || words[0] == '\0' ? "no reason told" : words;
}

/* ---- Options ---------------------------------------------------------------------------- */

static int take_number(const char* key, const char* value, double least, double most,
                       double* number) {
  char* end = NULL;
  const double found = strtod(value, &end);
  if (end != value && *end == '\0' && found >= least && found <= most) {
    *number = found;
    return JND_DEVICE_OK;
  }
  return failed("%.30s=%.30s; write a number from %g to %g", key, value, least, most);
}

static int take_word(const char* key, const char* value, const char* word, bool* is_said) {
  if (strcmp(value, word) != 0) {
    return failed("%.30s=%.30s; write %.30s=%s or leave it away", key, value, key, word);
  }
  *is_said = true;
  return JND_DEVICE_OK;
}

static int take_option(const char* key, const char* value, struct options* options) {
  if (strcmp(key, "library") == 0) {
    snprintf(options->library, sizeof options->library, "%s", value);
    return JND_DEVICE_OK;
  }
  if (strcmp(key, "device") == 0) return take_number(key, value, 0, 100, &options->device);
  if (strcmp(key, "serial") == 0) return take_number(key, value, 0, 65534, &options->serial);
  if (strcmp(key, "wait_for_calibration_s") == 0) {
    return take_number(key, value, 0, 100, &options->wait_for_calibration_s);
  }
  if (strcmp(key, "effector_mass_kg") == 0) {
    return take_number(key, value, 0, 2, &options->effector_mass_kg);
  }
  if (strcmp(key, "max_force_n") == 0) {
    return take_number(key, value, 0.1, 20, &options->max_force_n);
  }
  if (strcmp(key, "velocity_window_ms") == 0) {
    return take_number(key, value, 2, 20, &options->velocity_window_ms);
  }
  if (strcmp(key, "time_guard_us") == 0) {
    return take_number(key, value, 0, 1000, &options->time_guard_us);
  }
  if (strcmp(key, "surface_z_m") == 0) {
    return take_number(key, value, -0.2, 0.2, &options->surface_z_m);
  }
  if (strcmp(key, "gravity_compensation") == 0) {
    return take_word(key, value, "off", &options->without_gravity_compensation);
  }
  if (strcmp(key, "controller_watchdog") == 0) {
    return take_word(key, value, "off", &options->without_watchdog);
  }
  if (strcmp(key, "simulator") == 0) {
    return take_word(key, value, "on", &options->with_simulator);
  }
  return failed("the option %.40s, which this driver has not; its options stand in "
                "docs/devices.md, \"Force Dimension\"",
                key);
}

static int take_options(const char* text, struct options* options) {
  /* The window is 8 ms, because a velocity that is 4 ms late is like one behind a filter of
   * 40 Hz, the slowest that jnd accepts. The library's own 20 ms would be 10 ms late. */
  *options = (struct options){.device = -1.0,
                              .serial = -1.0,
                              .effector_mass_kg = -1.0,
                              .max_force_n = HUGE_VAL,
                              .velocity_window_ms = 8.0,
                              .time_guard_us = -1.0};
  char copy[1024];
  if (strlen(text) >= sizeof copy) return failed("options of more than 1000 letters");
  strcpy(copy, text);
  for (char* at = copy; *at != '\0';) {
    char* end = at + strcspn(at, ",");
    char* next = *end == '\0' ? end : end + 1;
    *end = '\0';
    char* value = strchr(at, '=');
    if (value == NULL) return failed("the option %.40s without a value; write KEY=VALUE", at);
    *value++ = '\0';
    if (take_option(at, value, options) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
    at = next;
  }
  if (options->device >= 0.0 && options->serial >= 0.0) {
    return failed("device= and serial= at once; choose by one of them");
  }
  return JND_DEVICE_OK;
}

/* ---- To find it -------------------------------------------------------------------------- */

static void pause_ms(int milliseconds) {
  const struct timespec pause = {.tv_nsec = 1000000L * milliseconds};
  nanosleep(&pause, NULL);
}

static int failed_by_another(void) {
  return failed("a device that another program uses; end that program, then try again");
}

static int failed_to_connect(const struct dhd_library* dhd) {
  switch (dhd->dhdErrorGetLast()) {
    case FD_ERROR_DEVICE_IN_USE:
    case FD_ERROR_CONTROLLER_BUSY:
    case FD_ERROR_NOT_AVAILABLE:
      return failed_by_another();
    case FD_ERROR_NO_DEVICE:
      return failed("no such device; look at its cable and power, and at serial= if it is "
                    "given");
    case FD_ERROR_NO_DRIVER:
      return failed("no access to the device; give this user access to it (the udev rule of "
                    "the Force Dimension SDK)");
    default:
      return failed("a device that does not open (%.80s); look at its cable and power, then "
                    "try again",
                    reason(dhd));
  }
}

/* Opens the chosen device and gives its id. */
static int connect_one(const struct dhd_library* dhd, const struct options* options, int* id) {
  const int num_devices = dhd->dhdGetDeviceCount();
  if (num_devices < 0) {
    return failed("a library that cannot look for devices (%.80s); install the Force Dimension "
                  "SDK anew",
                  reason(dhd));
  }
  if (num_devices == 0) {
    return failed("no device; connect its cable, switch it on, and give this user access to it "
                  "(the udev rule of the Force Dimension SDK)");
  }
  if (num_devices > 1 && options->device < 0.0 && options->serial < 0.0) {
    return failed("%d devices, and none of them is chosen; write device=0 to device=%d, or "
                  "serial=NUMBER",
                  num_devices, num_devices - 1);
  }
  if (options->device >= num_devices) {
    return failed("device=%g, and %d connected; write device=0 to device=%d", options->device,
                  num_devices, num_devices - 1);
  }
  /* An earlier process may be about to release it. */
  for (int i = 0; i < 10 && dhd->dhdGetAvailableCount() == 0; ++i) pause_ms(50);
  if (dhd->dhdGetAvailableCount() == 0) return failed_by_another();
  if (options->serial >= 0.0) {
    *id = dhd->dhdOpenSerial((int)options->serial);
  } else if (options->device >= 0.0) {
    *id = dhd->dhdOpenID((char)options->device);
  } else {
    *id = dhd->dhdOpen();
  }
  return *id < 0 ? failed_to_connect(dhd) : JND_DEVICE_OK;
}

static int know(struct connection* at, const struct options* options) {
  const struct dhd_library* dhd = at->dhd;
  const int type = dhd->dhdGetSystemType(at->id);
  const size_t num_models = sizeof models / sizeof models[0];
  size_t i = 0;
  while (i < num_models && models[i].type != type) ++i;
  if (i == num_models) {
    return failed("a device of type %d, whose force and reach this driver does not know; use "
                  "one of docs/devices.md, \"Force Dimension\"",
                  type);
  }
  at->model = models[i];
  at->has_wrist = dhd->dhdHasWrist(at->id);
  at->has_gripper = dhd->dhdHasGripper(at->id);
  at->has_more_motors = dhd->dhdHasActiveWrist(at->id) || dhd->dhdHasActiveGripper(at->id);
  at->is_virtual =
      dhd->dhdGetComMode != NULL && dhd->dhdGetComMode(at->id) == FD_MODE_VIRTUAL;
  if (options->with_simulator && !at->is_virtual) {
    return failed("a real device where simulator=on asks for a simulated one; disconnect it, or "
                  "leave simulator=on away");
  }
  return JND_DEVICE_OK;
}

static int connect_to(const struct options* options, struct connection* at) {
  *at = (struct connection){0};
  at->dhd = load_dhd_library(options->library, error_text, sizeof error_text);
  if (at->dhd == NULL) return JND_DEVICE_FAILED;
  if (options->with_simulator) {
    if (at->dhd->dhdEnableSimulator == NULL) {
      return failed("a library without simulated devices; leave simulator=on away");
    }
    at->dhd->dhdEnableSimulator(true);
  }
  int id = -1;
  if (connect_one(at->dhd, options, &id) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  at->id = (char)id;
  if (know(at, options) == JND_DEVICE_OK) return JND_DEVICE_OK;
  at->dhd->dhdClose(at->id);
  return JND_DEVICE_FAILED;
}

/* ---- What it is -------------------------------------------------------------------------- */

static void take_printable(const char* text, char* to, size_t size) {
  snprintf(to, size, "%s", text);
  for (; *to != '\0'; ++to) {
    if (*to < 0x20 || *to > 0x7e) *to = '?';
  }
}

static double force_limit_n(const struct connection* at, const struct options* options) {
  return fmin(at->model.max_force_n, options->max_force_n);
}

static void describe(const struct connection* at, const struct options* options,
                     jnd_device_description* description) {
  const struct dhd_library* dhd = at->dhd;
  const char* name = dhd->dhdGetSystemName(at->id);
  const bool is_named = name != NULL && name[0] != '\0';
  take_printable(is_named ? name : "Force Dimension device", description->name,
                 sizeof description->name);

  /* All Falcons report 65535. */
  unsigned short serial = 0;
  if (dhd->dhdGetSerialNumber(&serial, at->id) >= 0 && serial != 65535) {
    snprintf(description->serial, sizeof description->serial, "%u", (unsigned)serial);
  }
  int major = 0, minor = 0, release = 0, revision = 0;
  double controller = 0.0;
  dhd->dhdGetSDKVersion(&major, &minor, &release, &revision);
  if (dhd->dhdGetVersion(&controller, at->id) < 0 || !isfinite(controller)) controller = 0.0;
  snprintf(description->firmware, sizeof description->firmware, "controller %.4g, SDK %d.%d.%d",
           controller, major, minor, release);

  /* The library's clock is this computer's, so jnd itself stamps new measurements. */
  description->flags = JND_DEVICE_HAS_OWN_CLOCK | JND_DEVICE_TELLS_ACTED_FORCE |
                       JND_DEVICE_HAS_ENABLE_SWITCH | JND_DEVICE_HAS_BUTTONS;
  if (at->has_wrist) description->flags |= JND_DEVICE_HAS_ORIENTATION;
  if (at->has_gripper) description->flags |= JND_DEVICE_HAS_GRIPPER;
  if (at->is_virtual) description->flags |= JND_DEVICE_IS_SIMULATED;

  /* A tool that is held like a pen. */
  description->contact_point_bits = 1;
  description->area_share_ratio[0] = 1.0;
  description->rate_hz = nominal_rate_hz;
  description->max_force_per_point_n = force_limit_n(at, options);
  description->max_total_force_n = force_limit_n(at, options);
  description->max_slew_n_per_s = max_slew_n_per_s;
  description->max_speed_m_per_s = max_speed_m_per_s;
  for (int axis = 0; axis < 3; ++axis) {
    description->workspace_half_width_m[axis] = at->model.half_width_m;
  }
  /* The box is about jnd's origin and has to contain what the device reaches about its own. */
  description->workspace_half_width_m[2] += fabs(options->surface_z_m);
  description->closed_loop_delay_s = closed_loop_delay_s;
  description->open_timeout_s = 10.0 + options->wait_for_calibration_s;
}

uint32_t jnd_device_abi(void) { return JND_DEVICE_ABI; }

int jnd_device_describe(jnd_device* device, const char* text,
                        jnd_device_description* description) {
  if (device != NULL) {
    describe(&device->at, &device->options, description);
    return JND_DEVICE_OK;
  }
  /* The library tells the model only of an open device. Opening one brings no force, and
   * this one is closed at once. */
  struct options options;
  struct connection at;
  if (take_options(text, &options) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  if (connect_to(&options, &at) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  describe(&at, &options, description);
  at.dhd->dhdClose(at.id);
  return JND_DEVICE_OK;
}

/* ---- Forces ------------------------------------------------------------------------------ */

/* The device's x is jnd's -y, and its y is jnd's x. */
static int set_force(const struct connection* at, const double force_n[3]) {
  const double x_n = -force_n[1], y_n = force_n[0], z_n = force_n[2];
  if (!at->has_more_motors) return at->dhd->dhdSetForce(x_n, y_n, z_n, at->id);
  return at->dhd->dhdSetForceAndTorqueAndGripperForce(x_n, y_n, z_n, 0.0, 0.0, 0.0, 0.0, at->id);
}

static int set_no_force(const struct connection* at) {
  const double none_n[3] = {0.0, 0.0, 0.0};
  return set_force(at, none_n);
}

/* Sets zero force on the hand, while the device continues to carry its own weight. If the
 * device does not accept that, its motors are switched off, and brake. Any thread may call
 * it. */
static void end_force(jnd_device* device) {
  if (atomic_load(&device->is_on) && set_no_force(&device->at) >= 0) return;
  atomic_store(&device->is_on, false);
  device->at.dhd->dhdStop(device->at.id);
}

/* Call it after a failure, and store the words about the failure before. */
static void withhold(jnd_device* device) {
  device->is_withholding = true;
  memset(device->acted_n, 0, sizeof device->acted_n);
  end_force(device);
}

/* Switches the motors on, with zero force before and after it. */
static int switch_on(jnd_device* device) {
  const struct connection* at = &device->at;
  if (set_no_force(at) < 0 || at->dhd->dhdEnableForce(FD_ON, at->id) < 0) {
    const int result = failed("its motors do not switch on (%.60s)", reason(at->dhd));
    withhold(device);
    return result;
  }
  atomic_store(&device->is_on, true);
  device->next_status = device->num_reads + (uint64_t)(status_patience_s * nominal_rate_hz);
  if (set_no_force(at) >= 0) return JND_DEVICE_OK;
  const int result = failed("it takes no force (%.60s)", reason(at->dhd));
  withhold(device);
  return result;
}

static int write_none(jnd_device* device, unsigned num_halts) {
  device->is_fresh = device->is_withholding = false;
  device->known_halts = num_halts;
  memset(device->acted_n, 0, sizeof device->acted_n);
  /* A program must not switch on what a person or the device itself has switched off. But it
   * still gets zeros, so that a person who switches it on does not meet an old force. */
  if (!atomic_load(&device->is_on) && device->may_switch_on) return switch_on(device);
  if (set_no_force(&device->at) >= 0) return JND_DEVICE_OK;
  const int result = failed("it does not take zero force (%.60s); it was switched off",
                            reason(device->at.dhd));
  withhold(device);
  return result;
}

int jnd_device_write(jnd_device* device, const jnd_device_command* command) {
  const double* force_n = command->force_on_hand_n[0];
  const unsigned num_halts = atomic_load(&device->num_halts);
  const double squared_n2 =
      force_n[0] * force_n[0] + force_n[1] * force_n[1] + force_n[2] * force_n[2];
  if (squared_n2 == 0.0) return write_none(device, num_halts);
  /* A simulated device may get a force at once. Its motors still start with zeros. */
  if (device->is_fresh && num_halts == 0 && write_none(device, num_halts) != JND_DEVICE_OK) {
    return JND_DEVICE_FAILED;
  }

  /* jnd has ensured all of this, so a violation is a mistake of ours. */
  const double most_n = device->max_force_n * (1.0 + 1e-6);
  if (!(squared_n2 <= most_n * most_n)) {
    withhold(device);
    return failed("a force above its limit was to be written, or one that is no number");
  }
  if (device->is_withholding || device->is_blind || num_halts != device->known_halts) {
    withhold(device);
    return failed("a force was to be written after a halt or a failure, and before zeros");
  }
  if (!atomic_load(&device->is_on)) {
    withhold(device);
    return failed("its motors are off: its force button, its own guards, or its watchdog");
  }
  if (set_force(&device->at, force_n) < 0) {
    const int result = failed("it did not take the force (%.60s); look at cable and power",
                              reason(device->at.dhd));
    withhold(device);
    return result;
  }
  memcpy(device->acted_n, force_n, sizeof device->acted_n);
  /* If a halt came in the middle of this, perhaps before this force did, the force must not
   * persist. */
  if (atomic_load(&device->num_halts) != num_halts) withhold(device);
  return JND_DEVICE_OK;
}

void jnd_device_halt(jnd_device* device) {
  atomic_fetch_add(&device->num_halts, 1);
  end_force(device);
}

/* ---- To open and to close it ------------------------------------------------------------- */

static int read_status(const struct connection* at, int* status) {
  memset(status, 0, FD_STATUS_ROOM * sizeof *status);
  if (at->dhd->dhdGetStatus(status, at->id) < 0) {
    return failed("it does not tell how it is (%.60s); look at its cable", reason(at->dhd));
  }
  if (status[FD_STATUS_CONNECTED] == 0) return failed("it is disconnected; look at its cable");
  if (status[FD_STATUS_POWER] == 0) return failed("it has no power; switch it on");
  if (status[FD_STATUS_ERROR] != 0) {
    return failed("its controller reports an error; switch it off and on, and see its manual");
  }
  return JND_DEVICE_OK;
}

/* Positions of an uncalibrated device are wrong, and so would be the forces. Nothing here
 * moves the device: a person puts it to its place of rest. */
static int require_calibration(jnd_device* device) {
  const struct connection* at = &device->at;
  const double patience_s = device->options.wait_for_calibration_s;
  int status[FD_STATUS_ROOM];
  if (read_status(at, status) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  if (status[FD_STATUS_RESET] != 0) {
    if (patience_s == 0.0) {
      return failed("a device that is not calibrated; put its end effector to its place of rest "
                    "as its manual says, or write wait_for_calibration_s=60 and do it then");
    }
    if (at->dhd->dhdWaitForReset((int)(1000.0 * patience_s), at->id) < 0) {
      return at->dhd->dhdErrorGetLast() == FD_ERROR_TIMEOUT
                 ? failed("a device that nobody has calibrated within %g s; put its end effector "
                          "to its place of rest as its manual says",
                          patience_s)
                 : failed("a device that failed while it was calibrated (%.80s); look at its "
                          "cable and power",
                          reason(at->dhd));
    }
    if (read_status(at, status) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
    if (status[FD_STATUS_RESET] != 0) {
      return failed("a device that is still not calibrated; see its manual");
    }
  }
  if (at->has_wrist && status[FD_STATUS_WRIST_INIT] == 0) {
    return failed("a device whose wrist is not calibrated; switch it off and on, and wait until "
                  "its wrist has moved");
  }
  return JND_DEVICE_OK;
}

static int carry_its_weight(const jnd_device* device) {
  const struct connection* at = &device->at;
  if (device->options.effector_mass_kg >= 0.0 &&
      at->dhd->dhdSetEffectorMass(device->options.effector_mass_kg, at->id) < 0) {
    return failed("a device that does not take the mass of its end effector (%.60s); leave "
                  "effector_mass_kg= away",
                  reason(at->dhd));
  }
  const bool is_wanted = !device->options.without_gravity_compensation;
  if (at->dhd->dhdSetGravityCompensation(is_wanted ? FD_ON : FD_OFF, at->id) < 0 && is_wanted) {
    return failed("a device that does not carry its own weight (%.60s); write "
                  "gravity_compensation=off to feel it in the hand",
                  reason(at->dhd));
  }
  return JND_DEVICE_OK;
}

/* Sets the library's limit, against mistakes of ours, and the controller's watchdog, against
 * a computer that stands still. */
static int guard_it(const jnd_device* device) {
  const struct connection* at = &device->at;
  const struct dhd_library* dhd = at->dhd;
  if (dhd->dhdSetMaxForce != NULL) {
    const int result = dhd->dhdSetMaxForce(device->max_force_n, at->id);
    const double found_n = dhd->dhdGetMaxForce == NULL || result < 0
                               ? device->max_force_n
                               : dhd->dhdGetMaxForce(at->id);
    if (result < 0 || !(fabs(found_n - device->max_force_n) <= 0.01 * device->max_force_n)) {
      return failed("a library that does not keep to a limit of %g N (%.60s); write another "
                    "max_force_n=",
                    device->max_force_n, result < 0 ? reason(dhd) : "it tells another one");
    }
  }
  /* Expert mode applies to the whole library, so it is on only for these calls. */
  bool is_watched = false;
  if (dhd->dhdEnableExpertMode() >= 0) {
    if (device->options.time_guard_us >= 0.0 && dhd->dhdSetTimeGuard != NULL) {
      dhd->dhdSetTimeGuard((int)device->options.time_guard_us, at->id);
    }
    unsigned char steps = 0;
    is_watched = dhd->dhdSetWatchdog != NULL && dhd->dhdGetWatchdog != NULL &&
                 dhd->dhdSetWatchdog(WATCHDOG_STEPS, at->id) >= 0 &&
                 dhd->dhdGetWatchdog(&steps, at->id) >= 0 && steps != 0 &&
                 steps <= WATCHDOG_STEPS;
    dhd->dhdDisableExpertMode();
  }
  if (is_watched || at->is_virtual || device->options.without_watchdog) return JND_DEVICE_OK;
  return failed("a controller that does not end the force by itself 20 ms after the last command; "
                "read docs/devices.md before you write controller_watchdog=off");
}

static double now_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Waits until positions and velocities come, for half a second at most. */
static int wait_for_measurements(jnd_device* device) {
  const struct connection* at = &device->at;
  if (at->dhd->dhdConfigLinearVelocity((int)device->options.velocity_window_ms,
                                       FD_VELOCITY_BY_WINDOW, at->id) < 0) {
    return failed("a device that does not take a window of %g ms for velocities (%.60s); write "
                  "another velocity_window_ms=",
                  device->options.velocity_window_ms, reason(at->dhd));
  }
  for (int i = 0; i < 500; ++i) {
    double p_m[3] = {NAN, NAN, NAN}, v_m_per_s[3] = {NAN, NAN, NAN};
    if (at->dhd->dhdGetPosition(&p_m[0], &p_m[1], &p_m[2], at->id) < 0) {
      return failed("a device that does not tell where it is (%.80s); look at its cable and power",
                    reason(at->dhd));
    }
    if (at->dhd->dhdGetLinearVelocity(&v_m_per_s[0], &v_m_per_s[1], &v_m_per_s[2], at->id) >= 0 &&
        isfinite(p_m[0] + p_m[1] + p_m[2]) &&
        isfinite(v_m_per_s[0] + v_m_per_s[1] + v_m_per_s[2])) {
      memcpy(device->known_m, p_m, sizeof p_m);
      device->known_s = now_s();
      return JND_DEVICE_OK;
    }
    pause_ms(1);
  }
  return failed("a device that tells no position and velocity within half a second (%.60s); look "
                "at its cable and power",
                reason(at->dhd));
}

static int prepare(jnd_device* device) {
  const struct connection* at = &device->at;
  /* This ends whatever another program has left. */
  if (at->dhd->dhdStop(at->id) < 0) {
    return failed("a device that does not stop (%.80s); look at its cable and power",
                  reason(at->dhd));
  }
  if (require_calibration(device) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  if (carry_its_weight(device) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  if (guard_it(device) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  return wait_for_measurements(device);
}

int jnd_device_open(const char* text, double rate_hz, jnd_device** made) {
  struct options options;
  struct connection at;
  if (take_options(text, &options) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  if (connect_to(&options, &at) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  jnd_device* device = calloc(1, sizeof *device);
  if (device == NULL) {
    at.dhd->dhdClose(at.id);
    return failed("no memory");
  }
  device->at = at;
  device->options = options;
  device->max_force_n = force_limit_n(&at, &options);
  device->reads_per_status = (uint64_t)fmax(1.0, rate_hz / status_rate_hz);
  device->is_fresh = true;
  device->is_enabled = true;
  /* The motors are switched on with the first write, because the controller's watchdog runs
   * from then on. */
  device->may_switch_on = true;
  atomic_init(&device->num_halts, 0);
  atomic_init(&device->is_on, false);
  if (prepare(device) != JND_DEVICE_OK) {
    at.dhd->dhdStop(at.id);
    at.dhd->dhdClose(at.id);
    free(device);
    return JND_DEVICE_FAILED;
  }
  *made = device;
  return JND_DEVICE_OK;
}

/* The results are ignored, because the device may be gone. */
void jnd_device_close(jnd_device* device) {
  const struct connection* at = &device->at;
  set_no_force(at);
  at->dhd->dhdStop(at->id);
  at->dhd->dhdSetBrakes(FD_ON, at->id);
  at->dhd->dhdClose(at->id);
  free(device);
}

/* ---- Measurements ------------------------------------------------------------------------ */

/* Checks whether the motors still give force, and if not, who has ended it. */
static int look_after_it(jnd_device* device) {
  int status[FD_STATUS_ROOM];
  if (read_status(&device->at, status) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  if (status[FD_STATUS_RESET] != 0) return failed("it has lost its calibration; open it anew");
  if (status[FD_STATUS_FORCE] != 0) {
    atomic_store(&device->is_on, true);
    device->is_enabled = device->may_switch_on = true;
  } else if (atomic_load(&device->is_on)) {
    const int cause = status[FD_STATUS_FORCE_OFF_CAUSE];
    atomic_store(&device->is_on, false);
    device->is_enabled = false;
    device->may_switch_on = cause == FD_FORCE_OFF_WATCHDOG || cause == FD_FORCE_OFF_SOFTWARE;
    device->is_withholding = true;
    memset(device->acted_n, 0, sizeof device->acted_n);
    /* Otherwise an old force might come back with the motors. */
    set_no_force(&device->at);
  }
  return JND_DEVICE_OK;
}

static bool is_finite3(const double numbers[3]) {
  return isfinite(numbers[0]) && isfinite(numbers[1]) && isfinite(numbers[2]);
}

/* Converts from the device's frame. */
static void turn(const double from[3], double to[3]) {
  to[0] = from[1];
  to[1] = -from[0];
  to[2] = from[2];
}

/* Converts a rotation to a unit quaternion, by its largest part, which is never close to 0. */
static bool quaternion(double (*r)[3], double wxyz[4]) {
  const double parts[4] = {
      1.0 + r[0][0] + r[1][1] + r[2][2], 1.0 + r[0][0] - r[1][1] - r[2][2],
      1.0 - r[0][0] + r[1][1] - r[2][2], 1.0 - r[0][0] - r[1][1] + r[2][2]};
  const double twice[4][4] = {
      {parts[0], r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]},
      {r[2][1] - r[1][2], parts[1], r[0][1] + r[1][0], r[0][2] + r[2][0]},
      {r[0][2] - r[2][0], r[0][1] + r[1][0], parts[2], r[1][2] + r[2][1]},
      {r[1][0] - r[0][1], r[0][2] + r[2][0], r[1][2] + r[2][1], parts[3]}};
  int largest = 0;
  for (int i = 1; i < 4; ++i) {
    if (parts[i] > parts[largest]) largest = i;
  }
  double squared = 0.0;
  for (int i = 0; i < 4; ++i) squared += twice[largest][i] * twice[largest][i];
  /* For a rotation, the row's length is twice the square root of its largest part. */
  if (!isfinite(squared) || fabs(squared - 4.0 * parts[largest]) > 0.04 * squared) return false;
  for (int i = 0; i < 4; ++i) wxyz[i] = twice[largest][i] / sqrt(squared);
  return true;
}

static int read_orientation(const struct connection* at, jnd_device_state* state) {
  double of_device[3][3] = {{NAN}}, turned[3][3];
  if (at->dhd->dhdGetOrientationFrame(of_device, at->id) < 0) {
    return failed("it does not tell its orientation (%.60s)", reason(at->dhd));
  }
  /* Both frames are turned, also that of the end effector: at rest they coincide. */
  static const int axis_of[3] = {1, 0, 2};
  static const double sign_of[3] = {1.0, -1.0, 1.0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      turned[i][j] = sign_of[i] * sign_of[j] * of_device[axis_of[i]][axis_of[j]];
    }
  }
  if (quaternion(turned, state->orientation_wxyz)) return JND_DEVICE_OK;
  return failed("it tells an orientation that is none");
}

/* In m/s, in the device's frame. */
static int read_velocity(const jnd_device* device, const double p_m[3], double time_s,
                         double v_m_per_s[3]) {
  const struct dhd_library* dhd = device->at.dhd;
  const int result =
      dhd->dhdGetLinearVelocity(&v_m_per_s[0], &v_m_per_s[1], &v_m_per_s[2], device->at.id);
  if (result < 0 && dhd->dhdErrorGetLast() == FD_ERROR_TIMEOUT && time_s > device->known_s) {
    /* After a pause longer than its window, the library has no velocity before the next
     * position. The first read always comes after such a pause. */
    for (int axis = 0; axis < 3; ++axis) {
      v_m_per_s[axis] = (p_m[axis] - device->known_m[axis]) / (time_s - device->known_s);
    }
  } else if (result < 0) {
    return failed("it does not tell its velocity (%.60s)", reason(dhd));
  }
  if (is_finite3(v_m_per_s)) return JND_DEVICE_OK;
  return failed("it tells a velocity that is no number");
}

static int measure(jnd_device* device, jnd_device_state* state) {
  const struct connection* at = &device->at;
  if (device->num_reads >= device->next_status) {
    device->next_status = device->num_reads + device->reads_per_status;
    if (look_after_it(device) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  }
  ++device->num_reads;

  double p_m[3] = {NAN, NAN, NAN}, v_m_per_s[3] = {NAN, NAN, NAN};
  const int result = at->dhd->dhdGetPosition(&p_m[0], &p_m[1], &p_m[2], at->id);
  if (result < 0) {
    return failed("it does not tell where it is (%.60s); look at cable and power",
                  reason(at->dhd));
  }
  if (!is_finite3(p_m)) return failed("it tells a position that is no number");
  /* This is no error, because the device was read a moment ago, but it is no new measurement
   * either. */
  if (result == FD_TIME_GUARD && device->sample_number > 0) return JND_DEVICE_NO_SAMPLE;
  const double time_s = now_s();
  if (read_velocity(device, p_m, time_s, v_m_per_s) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  memcpy(device->known_m, p_m, sizeof p_m);
  device->known_s = time_s;
  turn(p_m, state->position_m[0]);
  state->position_m[0][2] -= device->options.surface_z_m;
  turn(v_m_per_s, state->velocity_m_per_s[0]);
  memcpy(state->end_effector_position_m, state->position_m[0], sizeof state->position_m[0]);

  if (at->has_wrist && read_orientation(at, state) != JND_DEVICE_OK) return JND_DEVICE_FAILED;
  if (at->has_gripper) {
    double gap_m = NAN;
    if (at->dhd->dhdGetGripperGap(&gap_m, at->id) < 0 || !isfinite(gap_m)) {
      return failed("it does not tell how far its gripper is open (%.60s)", reason(at->dhd));
    }
    /* Angles of left-handed grippers are negative (CHAI3D turns them). The documentation
     * does not say whether their gaps are. */
    state->gripper_m = fabs(gap_m);
  }
  state->buttons = at->dhd->dhdGetButtonMask(at->id);
  return JND_DEVICE_OK;
}

int jnd_device_read(jnd_device* device, jnd_device_state* state) {
  const int result = measure(device, state);
  if (result != JND_DEVICE_NO_SAMPLE) device->is_blind = result != JND_DEVICE_OK;
  /* It is called only once, because each of these calls may take as long as USB waits for a
   * device that is gone. */
  if (result == JND_DEVICE_FAILED && !device->is_withholding) withhold(device);
  if (result != JND_DEVICE_OK) return result;
  state->sample_number = ++device->sample_number;
  state->attached_bits = 1;
  state->enabled = device->is_enabled ? 1 : 0;
  /* The force that was written is the motors' command, unless somebody has ended it since. */
  if (atomic_load(&device->num_halts) == device->known_halts && device->is_enabled) {
    memcpy(state->acted_n[0], device->acted_n, sizeof device->acted_n);
  }
  return JND_DEVICE_OK;
}

const char* jnd_device_error(jnd_device* device) {
  (void)device;
  return error_text;
}
