/* A twin of Force Dimension's libdhd.so, for tests: it has the functions that the driver
 * uses, over a simulated device with a controller of its own. It behaves as the public
 * documentation says, as far as that says anything; otherwise it behaves as is assumed here
 * and marked as such. Nothing of the maker's is in it. It records every force that it is
 * given and judges it (`judge`).
 *
 * It retells these sources in our own words: (B), the documentation of the free Python
 * bindings, which was adapted from the maker's
 * (github.com/EmDash00/forcedimension_core-python at forcedimension_core/dhd/__init__.py and
 * dhd/expert/__init__.py, and -python-docs at docs/source/forcedimension_core.dhd-doc.rst);
 * (H), the declarations of version 3.7 in WPI-AIM/ambf at external/DHD/include/dhdc.h; (C),
 * src/devices/CDeltaDevices.cpp of CHAI3D.
 *
 * Build it with -D for what a library may lack: LACKS_SET_FORCE, LACKS_WATCHDOG,
 * LACKS_MAX_FORCE, LACKS_COM_MODE. The test tells everything else by the page of
 * twin_page.h. */
#define _GNU_SOURCE

#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "twin_page.h"

#define EXPORT __attribute__((visibility("default")))

enum { TIME_GUARD = 1, SATURATED = 2, NUM_STATUS = 17, NUM_HISTORY = 256 };
/* The numbers are those of (H), the enumeration of errors. */
enum {
  NO_ERROR,
  ERROR_COM = 2,
  ERROR_NO_DEVICE = 5,
  ERROR_NOT_AVAILABLE = 6,
  ERROR_TIMEOUT = 7,
  ERROR_EXPERT_MODE = 9,
  ERROR_DEVICE_NOT_READY = 12,
  ERROR_INDEX = 15,
  ERROR_IN_USE = 20
};
enum { CAUSE_BUTTON = 1, CAUSE_VELOCITY, CAUSE_WATCHDOG, CAUSE_SOFTWARE };

static volatile struct twin_page* page;

/* Each thread has its own last error: (B), error management. */
static _Thread_local int last_error = NO_ERROR;

/* The first is the library's, whose functions are thread-safe: (B), threading. The second is
 * the controller's, which a library that is stuck does not stop. */
static pthread_mutex_t library_lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_mutex_t controller_lock = PTHREAD_MUTEX_INITIALIZER;

static bool is_open, is_mine, is_expert, has_failed, is_halted, is_ended_by_somebody;
static pthread_t opener;
static double late_since_s;
static double force_n[3];
static double set_n[3]; /* The force that was set last, also while the motors are off. */
static double position_m[3], velocity_m_per_s[3];
static double last_force_s, last_asked_s, known_m[3];
static int off_cause;
static bool is_weightless;
static double history_s[NUM_HISTORY], history_m[NUM_HISTORY][3];
static int num_history;

static double now_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void sleep_ms(double milliseconds) {
  struct timespec pause = {.tv_sec = (time_t)(1e-3 * milliseconds)};
  pause.tv_nsec = (long)(1e6 * (milliseconds - 1e3 * (double)pause.tv_sec));
  nanosleep(&pause, NULL);
}

static int fail(int error) {
  last_error = error;
  has_failed = true;
  return -1;
}

static void unsafe(int act) {
  if (page->num_unsafe++ == 0) page->first_unsafe = act;
}

static double magnitude(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void act(double x_n, double y_n, double z_n) {
  const double now_n[3] = {x_n, y_n, z_n};
  for (int i = 0; i < 3; ++i) page->force_n[i] = force_n[i] = now_n[i];
  if (magnitude(now_n) > page->most_force_n) page->most_force_n = magnitude(now_n);
}

/* Where the force is ended, the motors brake: (B), safety feature and electromagnetic
 * brakes. */
static void end_force(int cause) {
  act(0.0, 0.0, 0.0);
  if (page->is_on) off_cause = cause;
  page->is_on = 0;
  page->are_brakes_on = 1;
  if (cause == CAUSE_BUTTON || cause == CAUSE_VELOCITY) is_ended_by_somebody = true;
}

/* It is assumed, as the worst case, that the force that was set last acts as soon as the
 * motors are on. */
static void begin_force(void) {
  if (magnitude(set_n) != 0.0) unsafe(TWIN_SWITCHED_ON_PUSHING);
  page->is_on = 1;
  page->are_brakes_on = 0;
  last_force_s = now_s();
  act(set_n[0], set_n[1], set_n[2]);
}

/* ---- The controller: a mass in a hand, and what ends the force by itself ------------------ */

/* 0.25 kg hang on a spring of 400 N/m and a damper of 8 N s/m that end where the hand wants
 * to be. Brakes add 20 N s/m, and the weight that is not carried is 1.5 N. */
static void move(double dt_s, double time_s) {
  double wanted_m[3];
  for (int i = 0; i < 3; ++i) wanted_m[i] = page->held_m[i];
  wanted_m[1] += page->stroke_m * sin(4.0 * time_s);
  const double wanted_y_m_per_s = 4.0 * page->stroke_m * cos(4.0 * time_s);
  for (int i = 0; i < 3; ++i) {
    const double hand_m_per_s = i == 1 ? wanted_y_m_per_s : 0.0;
    double all_n = 400.0 * (wanted_m[i] - position_m[i]) +
                   8.0 * (hand_m_per_s - velocity_m_per_s[i]) + force_n[i];
    if (page->are_brakes_on) all_n -= 20.0 * velocity_m_per_s[i];
    if (i == 2 && !(page->is_on && is_weightless)) all_n -= 1.5;
    velocity_m_per_s[i] += dt_s / 0.25 * all_n;
    position_m[i] += dt_s * velocity_m_per_s[i];
    page->position_m[i] = position_m[i];
  }
}

static void* control(void* unused) {
  (void)unused;
  double last_s = now_s(), simulated_s = 0.0;
  for (;;) {
    sleep_ms(0.5);
    pthread_mutex_lock(&controller_lock);
    const double time_s = now_s();
    /* Another process has the page's device, and this process has none any more. */
    if (!is_mine) {
      last_s = time_s;
      pthread_mutex_unlock(&controller_lock);
      continue;
    }
    /* If the machine was held up, the hand was too: it must not leap. */
    last_s = fmax(last_s, time_s - 0.002);
    for (; last_s + 0.0005 <= time_s; last_s += 0.0005) {
      simulated_s += 0.0005;
      move(0.0005, simulated_s);
    }
    const int steps = page->watchdog_steps;
    /* If no new force comes for so many times 125 microseconds, the firmware ends the force:
     * (B), setWatchdog. */
    if (page->is_on && steps != 0 && time_s - last_force_s > page->watchdog_step_s * steps) {
      ++page->num_watchdog_ends;
      end_force(CAUSE_WATCHDOG);
    }
    if (page->is_on && page->trouble == TWIN_BUTTON) end_force(CAUSE_BUTTON);
    if (page->is_on && page->trouble == TWIN_TOO_FAST) end_force(CAUSE_VELOCITY);
    if (!page->is_on && is_open && page->trouble == TWIN_BUTTON_AGAIN) {
      is_ended_by_somebody = false;
      begin_force();
      page->trouble = TWIN_IS_WELL;
    }
    if (late_since_s != 0.0 && time_s - late_since_s > 0.005) {
      unsafe(TWIN_STANDS_AFTER_HALT);
      late_since_s = 0.0;
    }
    pthread_mutex_unlock(&controller_lock);
  }
  return NULL;
}

__attribute__((constructor)) static void load(void) {
  const char* name = getenv("FORCE_DIMENSION_TWIN");
  const int file = name == NULL ? -1 : open(name, O_RDWR);
  void* memory = file < 0 ? MAP_FAILED
                          : mmap(NULL, sizeof *page, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) abort();
  close(file);
  page = memory;
  pthread_t controller;
  if (pthread_create(&controller, NULL, control, NULL) != 0) abort();
  pthread_detach(controller);
}

/* ---- The judge of every force that is set ------------------------------------------------- */

static bool is_opener(void) { return pthread_equal(pthread_self(), opener) != 0; }

static void judge(const double asked_n[3]) {
  const bool is_none = asked_n[0] == 0.0 && asked_n[1] == 0.0 && asked_n[2] == 0.0;
  if (is_none) {
    late_since_s = 0.0;
    ++page->num_zeros;
    if (is_opener()) {
      has_failed = is_halted = false;
    } else {
      is_halted = true;
      ++page->num_zeros_of_others;
    }
    return;
  }
  ++page->num_forces;
  if (!is_open) unsafe(TWIN_AFTER_CLOSE);
  if (!isfinite(asked_n[0] + asked_n[1] + asked_n[2])) unsafe(TWIN_NO_NUMBER);
  if (magnitude(asked_n) > page->limit_n * (1.0 + 1e-5)) unsafe(TWIN_ABOVE_LIMIT);
  if (!page->is_on && off_cause == 0) unsafe(TWIN_BEFORE_ENABLED);
  if (!page->is_calibrated) unsafe(TWIN_NOT_CALIBRATED);
  if (has_failed) unsafe(TWIN_AFTER_ERROR);
  /* A force may be under way while another thread halts, if it is taken back at once. */
  if (is_halted && late_since_s != 0.0) unsafe(TWIN_AFTER_HALT);
  if (is_halted && late_since_s == 0.0) late_since_s = now_s();
}

/* ---- The library -------------------------------------------------------------------------- */

static bool unplugs_in(int phase) {
  if (page->unplugged_in == phase) page->trouble = TWIN_UNPLUGGED;
  if (page->trouble != TWIN_UNPLUGGED) return false;
  /* Its motors have power of their own, but no computer: the watchdog ends the force. */
  return true;
}

/* It is assumed that every call to a device that is gone fails with an error of
 * communication. */
static bool is_gone(void) { return !is_open || unplugs_in(-1); }

EXPORT void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
  *major = page->version[0];
  *minor = page->version[1];
  *release = page->version[2];
  *revision = 0;
}

EXPORT int dhdErrorGetLast(void) { return last_error; }

EXPORT const char* dhdErrorGetLastStr(void) {
  switch (last_error) {
    case NO_ERROR:
      return "no error";
    case ERROR_COM:
      return "communication error";
    case ERROR_TIMEOUT:
      return "timeout";
    default:
      return "unspecified error";
  }
}

/* The first of these counts the devices that another program has locked, too: (B),
 * getDeviceCount and getAvailableCount. */
EXPORT int dhdGetDeviceCount(void) { return page->num_devices; }
EXPORT int dhdGetAvailableCount(void) { return page->num_available; }

/* These return the id, or -1: (B), open, openID, openSerial. It is assumed that a device
 * that another program has is "in use" (an error of this name is among (H)), and that motors
 * are off after opening. */
static int opened(void) {
  if (unplugs_in(TWIN_IN_OPEN)) return fail(ERROR_COM);
  if (page->num_devices == 0) return fail(ERROR_NO_DEVICE);
  if (page->num_available == 0) return fail(ERROR_IN_USE);
  pthread_mutex_lock(&controller_lock);
  opener = pthread_self();
  is_open = is_mine = true;
  has_failed = is_halted = is_weightless = is_ended_by_somebody = false;
  late_since_s = 0.0;
  off_cause = num_history = 0;
  page->is_on = 0;
  page->are_brakes_on = 1;
  page->watchdog_steps = page->has_watchdog ? 255 : 0;
  page->time_guard_us = 100; /* Assumed, as nobody tells what the maker's value is. */
  page->velocity_window_ms = 20;
  page->own_limit_n = -1.0;
  for (int i = 0; i < 3; ++i) position_m[i] = page->held_m[i];
  memset(velocity_m_per_s, 0, sizeof velocity_m_per_s);
  memset(set_n, 0, sizeof set_n);
  act(0.0, 0.0, 0.0);
  ++page->num_opened;
  pthread_mutex_unlock(&controller_lock);
  return 0;
}

EXPORT int dhdOpen(void) { return opened(); }
EXPORT int dhdOpenID(char index) {
  return index < page->num_devices ? opened() : fail(ERROR_INDEX);
}
EXPORT int dhdOpenSerial(int serial) {
  return serial == page->serial ? opened() : fail(ERROR_NO_DEVICE);
}

EXPORT int dhdClose(char id) {
  (void)id;
  if (unplugs_in(TWIN_IN_CLOSE) || !is_open) {
    is_open = false;
    return fail(ERROR_COM);
  }
  if (magnitude(force_n) != 0.0 || !page->are_brakes_on) unsafe(TWIN_CLOSED_PUSHING);
  is_open = is_mine = false;
  ++page->num_closed;
  return 0;
}

EXPORT int dhdGetSystemType(char id) {
  (void)id;
  return is_gone() ? fail(ERROR_COM) : page->type;
}
EXPORT const char* dhdGetSystemName(char id) {
  (void)id;
  return page->type == 60 ? "Falcon" : page->type == 33 ? "omega.3" : "omega.7";
}
EXPORT int dhdGetSerialNumber(unsigned short* serial, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  /* All Falcons say so, by a comment in mtsForceDimension.cpp of
   * jhu-saw/sawForceDimensionSDK. */
  *serial = (unsigned short)(page->type == 60 ? 65535 : page->serial);
  return 0;
}
EXPORT int dhdGetVersion(double* version, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  *version = 3.25;
  return 0;
}

/* The fields of a status are those of (B), and their places those of (H). */
EXPORT int dhdGetStatus(int* status, char id) {
  (void)id;
  if (is_gone() || page->trouble == TWIN_STATUS_FAILS) return fail(ERROR_COM);
  memset(status, 0, NUM_STATUS * sizeof *status);
  status[0] = page->has_power;
  status[1] = 1;
  status[2] = 1;
  status[3] = !page->is_calibrated || page->trouble == TWIN_LOST_CALIBRATION;
  status[5] = page->is_on;
  status[6] = page->are_brakes_on;
  status[8] = page->has_wrist;
  status[9] = page->trouble == TWIN_CONTROLLER_ERROR;
  status[10] = is_weightless;
  status[11] = page->time_guard_us != 0;
  status[12] = page->is_wrist_calibrated;
  status[14] = off_cause;
  return 0;
}

EXPORT bool dhdHasWrist(char id) { return (void)id, page->has_wrist != 0; }
EXPORT bool dhdHasActiveWrist(char id) { return (void)id, false; }
EXPORT bool dhdHasGripper(char id) { return (void)id, page->has_gripper != 0; }
EXPORT bool dhdHasActiveGripper(char id) { return (void)id, page->has_gripper != 0; }

/* The device goes into the mode in which a person calibrates it, and fails with "timeout"
 * when nobody has: (B), waitForReset. */
EXPORT int dhdWaitForReset(int timeout_ms, char id) {
  (void)id;
  if (is_gone() || unplugs_in(TWIN_IN_CALIBRATION)) return fail(ERROR_COM);
  const bool is_soon =
      page->calibrates_after_ms >= 0 && page->calibrates_after_ms <= timeout_ms;
  page->is_calibrated = 0;
  sleep_ms(is_soon ? page->calibrates_after_ms : timeout_ms);
  if (!is_soon) return fail(ERROR_TIMEOUT);
  page->is_calibrated = 1;
  return 0;
}

EXPORT int dhdSetGravityCompensation(int on, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  if (on && !page->has_gravity_compensation) return fail(ERROR_NOT_AVAILABLE);
  is_weightless = on != 0;
  return 0;
}
EXPORT int dhdSetEffectorMass(double mass_kg, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  page->effector_mass_kg = mass_kg;
  return 0;
}
EXPORT int dhdConfigLinearVelocity(int window_ms, int mode, char id) {
  (void)id;
  (void)mode;
  if (is_gone()) return fail(ERROR_COM);
  page->velocity_window_ms = window_ms;
  return 0;
}

/* What is younger than the guard's period is told anew, without asking the device: (B),
 * TimeGuard. */
EXPORT int dhdGetPosition(double* x_m, double* y_m, double* z_m, char id) {
  (void)id;
  if (is_gone() || unplugs_in(TWIN_IN_READ)) return fail(ERROR_COM);
  pthread_mutex_lock(&library_lock);
  if (page->trouble == TWIN_STUCK_READ) {
    for (;;) pause();
  }
  if (page->trouble == TWIN_SLOW_READ) sleep_ms(page->slow_ms);
  if (page->trouble == TWIN_READS_FAIL) {
    pthread_mutex_unlock(&library_lock);
    return fail(ERROR_COM);
  }
  const double time_s = now_s();
  int result = 0;
  if (page->trouble == TWIN_TIME_GUARD || time_s - last_asked_s < 1e-6 * page->time_guard_us) {
    result = TIME_GUARD;
  } else {
    pthread_mutex_lock(&controller_lock);
    /* The encoders have steps of a hundredth of a millimetre. */
    for (int i = 0; i < 3 && page->trouble != TWIN_STALE; ++i) {
      known_m[i] = 1e-5 * round(1e5 * position_m[i]);
    }
    pthread_mutex_unlock(&controller_lock);
    last_asked_s = time_s;
    const int place = num_history++ % NUM_HISTORY;
    history_s[place] = time_s;
    memcpy(history_m[place], known_m, sizeof known_m);
  }
  *x_m = page->trouble == TWIN_NAN_POSITION ? (double)NAN : known_m[0];
  *y_m = known_m[1];
  *z_m = known_m[2];
  ++page->num_reads;
  pthread_mutex_unlock(&library_lock);
  return result;
}

/* The velocity is a difference over the window, which has to hold at least two positions;
 * otherwise the call fails with "timeout": (B), getLinearVelocity. */
EXPORT int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  (void)id;
  if (is_gone() || page->trouble == TWIN_VELOCITIES_FAIL) return fail(ERROR_COM);
  pthread_mutex_lock(&library_lock);
  const int newest = num_history - 1;
  int oldest = newest;
  while (oldest > 0 && newest - oldest < NUM_HISTORY - 1 &&
         now_s() - history_s[(oldest - 1) % NUM_HISTORY] <= 1e-3 * page->velocity_window_ms) {
    --oldest;
  }
  static double v_m_per_s[3];
  const bool is_known = newest >= 1 && oldest < newest;
  for (int i = 0; i < 3 && is_known && page->trouble != TWIN_STALE; ++i) {
    v_m_per_s[i] = (history_m[newest % NUM_HISTORY][i] - history_m[oldest % NUM_HISTORY][i]) /
                   (history_s[newest % NUM_HISTORY] - history_s[oldest % NUM_HISTORY]);
  }
  pthread_mutex_unlock(&library_lock);
  *x = page->trouble == TWIN_NAN_VELOCITY ? (double)NAN : v_m_per_s[0];
  *y = v_m_per_s[1];
  *z = v_m_per_s[2];
  if (is_known) return 0;
  last_error = ERROR_TIMEOUT;
  return -1;
}

EXPORT int dhdGetOrientationFrame(double (*rotation)[3], char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation[i][j] = page->rotation[i][j];
  }
  if (page->trouble == TWIN_BROKEN_ROTATION) rotation[0][0] = 3.0;
  return 0;
}
EXPORT int dhdGetGripperGap(double* gap_m, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  *gap_m = page->gap_m;
  return 0;
}
EXPORT unsigned dhdGetButtonMask(char id) { return (void)id, page->buttons; }

EXPORT int dhdEnableForce(int on, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  pthread_mutex_lock(&controller_lock);
  if (on) {
    if (is_ended_by_somebody) unsafe(TWIN_SWITCHED_ON_AGAINST_SOMEBODY);
    if (!is_weightless && page->has_gravity_compensation) unsafe(TWIN_NOT_WEIGHTLESS);
    begin_force();
  } else {
    end_force(CAUSE_SOFTWARE);
  }
  pthread_mutex_unlock(&controller_lock);
  return 0;
}

/* This returns 0, or "saturated", which is no error. The force stands until the next one:
 * (B), setForce. */
static int set_force(double x_n, double y_n, double z_n) {
  const double asked_n[3] = {x_n, y_n, z_n};
  const bool is_none = x_n == 0.0 && y_n == 0.0 && z_n == 0.0;
  if (page->trouble == TWIN_SLOW_WRITE && !is_none) sleep_ms(page->slow_ms);
  pthread_mutex_lock(&library_lock);
  pthread_mutex_lock(&controller_lock);
  judge(asked_n);
  const bool is_lost = is_gone() || unplugs_in(is_none ? TWIN_NEVER - 1 : TWIN_IN_WRITE) ||
                       (!is_opener() && unplugs_in(TWIN_IN_HALT));
  int result = 0;
  if (is_lost || page->trouble == TWIN_ZEROS_FAIL ||
      (page->trouble == TWIN_WRITES_FAIL && !is_none)) {
    result = fail(ERROR_COM);
  } else {
    last_force_s = now_s();
    memcpy(set_n, asked_n, sizeof set_n);
    if (page->is_on) act(x_n, y_n, z_n);
    if (page->trouble == TWIN_SATURATED && !is_none) result = SATURATED;
  }
  pthread_mutex_unlock(&controller_lock);
  pthread_mutex_unlock(&library_lock);
  return result;
}

#ifndef LACKS_SET_FORCE
EXPORT int dhdSetForce(double x_n, double y_n, double z_n, char id) {
  (void)id;
  ++page->num_without_gripper;
  return set_force(x_n, y_n, z_n);
}
#endif
EXPORT int dhdSetForceAndTorqueAndGripperForce(double x_n, double y_n, double z_n, double x_n_m,
                                               double y_n_m, double z_n_m, double gripper_n,
                                               char id) {
  (void)id;
  if (x_n_m != 0.0 || y_n_m != 0.0 || z_n_m != 0.0 || gripper_n != 0.0) unsafe(TWIN_ABOVE_LIMIT);
  return set_force(x_n, y_n, z_n);
}

EXPORT int dhdSetBrakes(int on, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  page->are_brakes_on = on != 0;
  return 0;
}

/* The device gives no force, and brakes: (B), stop. */
EXPORT int dhdStop(char id) {
  (void)id;
  if (page->unplugged_in == TWIN_IN_CLOSE && page->num_forces > 0) page->trouble = TWIN_UNPLUGGED;
  if (is_gone()) return fail(ERROR_COM);
  pthread_mutex_lock(&controller_lock);
  ++page->num_stops;
  has_failed = is_halted = false;
  late_since_s = 0.0;
  end_force(CAUSE_SOFTWARE);
  pthread_mutex_unlock(&controller_lock);
  return 0;
}

EXPORT int dhdEnableExpertMode(void) {
  is_expert = true;
  return 0;
}
EXPORT int dhdDisableExpertMode(void) {
  is_expert = false;
  return 0;
}

#ifndef LACKS_WATCHDOG
EXPORT int dhdSetWatchdog(unsigned char steps, char id) {
  (void)id;
  if (is_gone() || unplugs_in(TWIN_IN_PREPARATION)) return fail(ERROR_COM);
  if (!is_expert) return fail(ERROR_EXPERT_MODE);
  if (!page->has_watchdog) return fail(ERROR_NOT_AVAILABLE);
  if (page->has_watchdog != TWIN_KEEPS_ITS_WATCHDOG) page->watchdog_steps = steps;
  if (page->has_watchdog == TWIN_FORGETS_ITS_WATCHDOG) page->watchdog_steps = 0;
  return 0;
}
EXPORT int dhdGetWatchdog(unsigned char* steps, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  *steps = (unsigned char)page->watchdog_steps;
  return 0;
}
#endif

#ifndef LACKS_MAX_FORCE
EXPORT int dhdSetMaxForce(double limit_n, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  page->own_limit_n = limit_n;
  return 0;
}
EXPORT double dhdGetMaxForce(char id) { return (void)id, page->own_limit_n; }
#endif

EXPORT int dhdSetTimeGuard(int period_us, char id) {
  (void)id;
  if (is_gone()) return fail(ERROR_COM);
  if (!is_expert) return fail(ERROR_EXPERT_MODE);
  page->time_guard_us = period_us;
  return 0;
}

#ifndef LACKS_COM_MODE
EXPORT int dhdGetComMode(char id) { return (void)id, page->is_virtual ? 3 : 1; }
#endif

EXPORT void dhdEnableSimulator(bool on) { (void)on; }
