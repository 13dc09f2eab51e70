#ifndef JND_TWIN_PAGE_H
#define JND_TWIN_PAGE_H

/* The page by which a test and the twin of Force Dimension's library exchange values: a file of
 * this layout, which both have mapped. The environment variable FORCE_DIMENSION_TWIN names it.
 * The header is C11 and C++. A test writes the first part before it opens the device, and
 * `trouble` at any time. The twin writes the second part. */

/* This is C, to which the checks of C++ do not apply. NOLINTBEGIN */

enum twin_trouble {
  TWIN_IS_WELL = 0,
  TWIN_UNPLUGGED,       /* Every call fails. */
  TWIN_READS_FAIL,      /* Only reading positions fails. */
  TWIN_STATUS_FAILS,    /* Only reading the status fails. */
  TWIN_VELOCITIES_FAIL, /* Only reading velocities fails. */
  TWIN_WRITES_FAIL,     /* Forces other than zero are refused. */
  TWIN_ZEROS_FAIL,      /* Every force is refused, even zero, so it must be stopped. */
  TWIN_NAN_POSITION,
  TWIN_NAN_VELOCITY,
  TWIN_BROKEN_ROTATION,
  TWIN_STALE,        /* Position and velocity never change, without an error. */
  TWIN_TIME_GUARD,   /* Every position is "recent enough". */
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

/* The phase in which the cable is pulled: as the function of this phase is called. */
enum twin_phase {
  TWIN_NEVER = 0,
  TWIN_IN_OPEN,
  TWIN_IN_CALIBRATION,
  TWIN_IN_PREPARATION, /* The watchdog is being set. */
  TWIN_IN_READ,
  TWIN_IN_WRITE, /* A force other than zero is being set. */
  TWIN_IN_HALT,  /* Another thread than the one that opened the device sets a force. */
  TWIN_IN_CLOSE
};

enum twin_act {
  TWIN_NOTHING_UNSAFE = 0,
  TWIN_NO_NUMBER,
  TWIN_ABOVE_LIMIT,
  TWIN_BEFORE_ENABLED, /* A force is set while the motors are off. */
  TWIN_NOT_CALIBRATED,
  TWIN_NOT_WEIGHTLESS,    /* The motors are on, and nobody carries the weight. */
  TWIN_AFTER_ERROR,       /* A force follows a failed call, without zeros in between. */
  TWIN_AFTER_HALT,        /* A force follows another thread's zeros, without own zeros. */
  TWIN_STANDS_AFTER_HALT, /* A force came together with these zeros and stood for 5 ms. */
  TWIN_AFTER_CLOSE,
  TWIN_CLOSED_PUSHING,               /* It is closed without zeros and brakes. */
  TWIN_SWITCHED_ON_AGAINST_SOMEBODY, /* It is switched on after a person or a guard ended it. */
  TWIN_SWITCHED_ON_PUSHING           /* It is switched on, and the earlier force is back. */
};

/* Values of `has_watchdog`: the device says that it takes another time, and in fact keeps its
 * own time, or none at all. */
enum { TWIN_KEEPS_ITS_WATCHDOG = 2, TWIN_FORGETS_ITS_WATCHDOG = 3 };

struct twin_page {
  /* ---- Written by the test ---- */
  int version[3]; /* The version of the library. */
  int num_devices, num_available;
  int type; /* The model, as Force Dimension numbers it. */
  int serial;
  int is_virtual; /* Whether it is a simulation by the maker. */
  int has_power, has_watchdog, has_gravity_compensation;
  double watchdog_step_s; /* 125 microseconds, or more if a busy machine must not matter. */
  int is_calibrated, calibrates_after_ms; /* Below 0, it never does. */
  int has_wrist, has_gripper, is_wrist_calibrated;
  double limit_n;   /* The largest force that a driver may set. */
  double held_m[3]; /* The place at which the hand holds it, in the device's frame. */
  double stroke_m;  /* The amplitude of the hand's strokes along its y axis. */
  double rotation[3][3];
  double gap_m;
  unsigned buttons;
  int slow_ms;
  int unplugged_in; /* A value of enum twin_phase. */
  int trouble;      /* A value of enum twin_trouble. */

  /* ---- Written by the twin ---- */
  double force_n[3];    /* The acting force without the weight, in the device's frame. */
  double most_force_n;  /* The largest magnitude so far. */
  double position_m[3]; /* The device's place in its own frame. */
  double effector_mass_kg, own_limit_n;
  int watchdog_steps, time_guard_us, velocity_window_ms;
  int is_on, are_brakes_on;
  int num_opened, num_closed;
  int num_forces; /* The number of forces other than zero. */
  int num_zeros, num_zeros_of_others, num_stops;
  int num_reads;
  int num_unsafe, first_unsafe; /* A value of enum twin_act. */
  int num_watchdog_ends;
  int num_without_gripper; /* The number of forces that did not mention wrist and gripper. */
};

/* NOLINTEND */

#endif
