#ifndef JND_TWIN_PAGE_H
#define JND_TWIN_PAGE_H

/* What a test and the twin of Force Dimension's library tell one another: a file of this
 * layout, named by the environment variable FORCE_DIMENSION_TWIN, which both have mapped. C11
 * and C++. A test writes the first part before it opens the device, and `trouble` at any time;
 * the twin writes the second. */

/* C, which the checks of C++ do not know. NOLINTBEGIN */

enum twin_trouble {
  TWIN_IS_WELL = 0,
  TWIN_UNPLUGGED,       /* Whatever is asked of it fails. */
  TWIN_READS_FAIL,      /* Positions alone. */
  TWIN_STATUS_FAILS,    /* What it says of itself alone. */
  TWIN_VELOCITIES_FAIL, /* Velocities alone. */
  TWIN_WRITES_FAIL,     /* Forces other than zero are not taken. */
  TWIN_ZEROS_FAIL,      /* No force is taken, zero neither: it has to be stopped. */
  TWIN_NAN_POSITION,
  TWIN_NAN_VELOCITY,
  TWIN_BROKEN_ROTATION,
  TWIN_STALE,        /* The same position and velocity for ever, and no word of it. */
  TWIN_TIME_GUARD,   /* "Recent enough" for ever. */
  TWIN_SLOW_READ,    /* A position takes `slow_ms`. */
  TWIN_SLOW_WRITE,   /* Likewise a force other than zero. */
  TWIN_STUCK_READ,   /* A position never comes, and the library's lock is kept. */
  TWIN_SATURATED,    /* Each force is more than a motor can give. */
  TWIN_BUTTON,       /* A person presses its force button, which takes the force away. */
  TWIN_BUTTON_AGAIN, /* And brings it back. */
  TWIN_TOO_FAST,     /* Its own guard of the velocity takes the force away. */
  TWIN_LOST_CALIBRATION,
  TWIN_CONTROLLER_ERROR
};

/* The phase in which its cable is pulled: on the way into the function that it is about. */
enum twin_phase {
  TWIN_NEVER = 0,
  TWIN_IN_OPEN,
  TWIN_IN_CALIBRATION,
  TWIN_IN_PREPARATION, /* As the watchdog is set. */
  TWIN_IN_READ,
  TWIN_IN_WRITE, /* Of a force other than zero. */
  TWIN_IN_HALT,  /* A force that another thread sets than the one that opened it. */
  TWIN_IN_CLOSE
};

enum twin_act {
  TWIN_NOTHING_UNSAFE = 0,
  TWIN_NO_NUMBER,
  TWIN_ABOVE_LIMIT,
  TWIN_BEFORE_ENABLED, /* A force while its motors are off. */
  TWIN_NOT_CALIBRATED,
  TWIN_NOT_WEIGHTLESS,    /* Motors on, and nobody carries its weight. */
  TWIN_AFTER_ERROR,       /* A force after a call that failed, without zeros in between. */
  TWIN_AFTER_HALT,        /* A force after zeros of another thread, likewise. */
  TWIN_STANDS_AFTER_HALT, /* One that came together with those, and stood for 5 ms. */
  TWIN_AFTER_CLOSE,
  TWIN_CLOSED_PUSHING,               /* Closed without zeros and brakes. */
  TWIN_SWITCHED_ON_AGAINST_SOMEBODY, /* Motors on after a person or a guard has ended them. */
  TWIN_SWITCHED_ON_PUSHING           /* Motors on, and the force of before is back. */
};

/* Of `has_watchdog`: it says that it takes another time, and keeps its own, or none at all. */
enum { TWIN_KEEPS_ITS_WATCHDOG = 2, TWIN_FORGETS_ITS_WATCHDOG = 3 };

struct twin_page {
  /* ---- By the test ---- */
  int version[3]; /* Of the library. */
  int num_devices, num_available;
  int type; /* As Force Dimension numbers its models. */
  int serial;
  int is_virtual; /* A simulation of the maker's. */
  int has_power, has_watchdog, has_gravity_compensation;
  double watchdog_step_s; /* 125 microseconds; more where a busy machine is no matter. */
  int is_calibrated, calibrates_after_ms; /* Below 0: never. */
  int has_wrist, has_gripper, is_wrist_calibrated;
  double limit_n;   /* The largest force that a driver may set. */
  double held_m[3]; /* Where the hand holds it, in the device's frame. */
  double stroke_m;  /* How far the hand goes to and fro along its y. */
  double rotation[3][3];
  double gap_m;
  unsigned buttons;
  int slow_ms;
  int unplugged_in; /* Of enum twin_phase. */
  int trouble;      /* Of enum twin_trouble. */

  /* ---- By the twin ---- */
  double force_n[3];    /* That acts now, its weight apart, in the device's frame. */
  double most_force_n;  /* The largest magnitude so far. */
  double position_m[3]; /* Where it is, in the device's frame. */
  double effector_mass_kg, own_limit_n;
  int watchdog_steps, time_guard_us, velocity_window_ms;
  int is_on, are_brakes_on;
  int num_opened, num_closed;
  int num_forces; /* Other than zero. */
  int num_zeros, num_zeros_of_others, num_stops;
  int num_reads;
  int num_unsafe, first_unsafe; /* Of enum twin_act. */
  int num_watchdog_ends;
  int num_without_gripper; /* Forces that were set without a word of wrist and gripper. */
};

/* NOLINTEND */

#endif
