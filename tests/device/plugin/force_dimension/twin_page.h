#ifndef JND_TWIN_PAGE_H
#define JND_TWIN_PAGE_H

/* What a test and the twin of Force Dimension's library tell one another: a file of this
 * layout, named by the environment variable FORCE_DIMENSION_TWIN, which both have mapped. It
 * is valid C11 and C++. A test writes the first part before it opens the device, and
 * `trouble` at any time; the twin writes the second part. */

/* The checks of C++ do not know C. NOLINTBEGIN */

enum twin_trouble {
  TWIN_IS_WELL = 0,
  TWIN_UNPLUGGED,       /* Every call fails. */
  TWIN_READS_FAIL,      /* Only positions fail. */
  TWIN_STATUS_FAILS,    /* Only what the device says of itself fails. */
  TWIN_VELOCITIES_FAIL, /* Only velocities fail. */
  TWIN_WRITES_FAIL,     /* Forces other than zero are not taken. */
  TWIN_ZEROS_FAIL,      /* No force is taken, not even zero: the device has to be stopped. */
  TWIN_NAN_POSITION,
  TWIN_NAN_VELOCITY,
  TWIN_BROKEN_ROTATION,
  TWIN_STALE,        /* The same position and velocity come for ever, without an error. */
  TWIN_TIME_GUARD,   /* Every answer is "recent enough". */
  TWIN_SLOW_READ,    /* A position takes `slow_ms`. */
  TWIN_SLOW_WRITE,   /* A force other than zero takes `slow_ms`. */
  TWIN_STUCK_READ,   /* A position never comes, and the library's lock is kept. */
  TWIN_SATURATED,    /* Each force is more than a motor can give. */
  TWIN_BUTTON,       /* A person presses its force button, which takes the force away. */
  TWIN_BUTTON_AGAIN, /* A person presses the button again, which brings the force back. */
  TWIN_TOO_FAST,     /* Its own guard of the velocity takes the force away. */
  TWIN_LOST_CALIBRATION,
  TWIN_CONTROLLER_ERROR
};

/* The phase in which the device's cable is pulled, on the way into the function of the
 * phase. */
enum twin_phase {
  TWIN_NEVER = 0,
  TWIN_IN_OPEN,
  TWIN_IN_CALIBRATION,
  TWIN_IN_PREPARATION, /* While the watchdog is set. */
  TWIN_IN_READ,
  TWIN_IN_WRITE, /* In a write of a force other than zero. */
  TWIN_IN_HALT,  /* In a write by a thread other than the one that opened the device. */
  TWIN_IN_CLOSE
};

enum twin_act {
  TWIN_NOTHING_UNSAFE = 0,
  TWIN_NO_NUMBER,
  TWIN_ABOVE_LIMIT,
  TWIN_BEFORE_ENABLED, /* A force came while the motors were off. */
  TWIN_NOT_CALIBRATED,
  TWIN_NOT_WEIGHTLESS, /* The motors are on, and nobody carries the device's weight. */
  TWIN_AFTER_ERROR,    /* A force came after a call that failed, without zeros in between. */
  /* A force came after zeros of another thread, without zeros in between. */
  TWIN_AFTER_HALT,
  /* A force came together with zeros of another thread, and stood for 5 ms. */
  TWIN_STANDS_AFTER_HALT,
  TWIN_AFTER_CLOSE,
  TWIN_CLOSED_PUSHING, /* The device was closed without zeros and brakes. */
  /* The motors were switched on after a person or a guard had ended them. */
  TWIN_SWITCHED_ON_AGAINST_SOMEBODY,
  /* The motors were switched on, and the old force was back. */
  TWIN_SWITCHED_ON_PUSHING
};

/* Values of `has_watchdog`: the device says that it takes another time, and keeps its own,
 * or none at all. */
enum { TWIN_KEEPS_ITS_WATCHDOG = 2, TWIN_FORGETS_ITS_WATCHDOG = 3 };

struct twin_page {
  /* ---- Written by the test ---- */
  int version[3]; /* Of the library. */
  int num_devices, num_available;
  int type; /* Force Dimension's number of the model. */
  int serial;
  int is_virtual; /* Whether it is the maker's simulation. */
  int has_power, has_watchdog, has_gravity_compensation;
  double watchdog_step_s; /* 125 microseconds; more where a busy machine must not matter. */
  int is_calibrated, calibrates_after_ms; /* Below 0: never. */
  int has_wrist, has_gripper, is_wrist_calibrated;
  double limit_n;   /* The largest force that a driver may set. */
  double held_m[3]; /* Where the hand holds the device, in the device's frame. */
  double stroke_m;  /* How far the hand goes to and fro along the device's y. */
  double rotation[3][3];
  double gap_m;
  unsigned buttons;
  int slow_ms;
  int unplugged_in; /* A value of enum twin_phase. */
  int trouble;      /* A value of enum twin_trouble. */

  /* ---- Written by the twin ---- */
  /* The force that acts now, without the weight, in the device's frame. */
  double force_n[3];
  double most_force_n;  /* The largest magnitude so far. */
  double position_m[3]; /* The device's position, in its own frame. */
  double effector_mass_kg, own_limit_n;
  int watchdog_steps, time_guard_us, velocity_window_ms;
  int is_on, are_brakes_on;
  int num_opened, num_closed;
  int num_forces; /* Forces other than zero. */
  int num_zeros, num_zeros_of_others, num_stops;
  int num_reads;
  int num_unsafe, first_unsafe; /* first_unsafe is of enum twin_act. */
  int num_watchdog_ends;
  int num_without_gripper; /* Forces that were set without setting wrist and gripper. */
};

/* NOLINTEND */

#endif
