#ifndef JND_DEVICE_H
#define JND_DEVICE_H

/* The interface between jnd and the driver of a haptic device, ABI version 1. C11 and C++.
 *
 * A driver is a shared object that defines the eight functions below. It needs nothing of
 * jnd but this header:
 *
 *     cc -std=c11 -shared -fPIC -I DIRECTORY_OF_THIS_HEADER my_device.c -o my_device.so
 *     jnd loop --device plugin:./my_device.so:real
 *
 * Units are SI throughout. The frame is the workspace's: +x points to the participant's
 * right, +y away from the participant, +z up; the surface of a fluid is the plane z = 0. A
 * device with another frame transforms inside its driver. Forces are those ON THE HAND, not
 * on the device: the drag on a hand that moves to the right is negative in x.
 *
 * There are at most five contact points, always in this order: inner palm, outer palm,
 * thumb, index, middle. A device with fewer says which it has. A tool that is held like a
 * pen has only the first.
 *
 * jnd calls a driver in a process of its own, by one thread: describe, open, then write and
 * read once in each tick, then close. Only `jnd_device_halt` may be called by a second
 * thread. It may be called at any time after open, even while another call is under way or
 * stuck.
 *
 * The calling thread has real-time priority (SCHED_FIFO 79). The driver's own threads have
 * ordinary priority until the driver gives them a lower priority of SCHED_FIFO. Without it,
 * measurements of such a thread come too late on a busy machine.
 *
 * Zero force means no force on the hand, not no torque in the motors: a device with a weight
 * of its own continues to hold it while it is halted. Whatever this program does, the
 * device's own controller sets its force to zero if no command has come for 20 ms. */

/* The following is C, which the checks of C++ do not know. NOLINTBEGIN */
#include <stdint.h>

#if defined(__cplusplus)
#define JND_DEVICE_EXPORT extern "C" __attribute__((visibility("default")))
#else
#define JND_DEVICE_EXPORT __attribute__((visibility("default")))
#endif

#define JND_DEVICE_ABI 1u
#define JND_DEVICE_MAX_POINTS 5
#define JND_DEVICE_TEXT_SIZE 64

/* Results of the functions. */
enum {
  JND_DEVICE_OK = 0,
  JND_DEVICE_FAILED = 1, /* `jnd_device_error` says why. */
  /* Only from read: nothing new; the measurement before is reused. The first read after open
   * has none before, and has to bring a measurement. */
  JND_DEVICE_NO_SAMPLE = 2
};

/* What a device is and has, as `flags` of its description. */
enum {
  /* Nobody can be hurt by it. jnd believes this only if the command line says so, too. */
  JND_DEVICE_IS_SIMULATED = 1u << 0,
  /* Its hand moves without a person, so simulated participants may use it. */
  JND_DEVICE_MOVES_BY_ITSELF = 1u << 1,
  /* It runs at its own pace. A device without this flag is a simulation whose time advances
   * by one period with each write, and which may run as fast as it can. A real device has
   * it. */
  JND_DEVICE_HAS_OWN_CLOCK = 1u << 2,
  /* `acted_n` is the force that acted. A real device without it is never armed. */
  JND_DEVICE_TELLS_ACTED_FORCE = 1u << 3,
  /* `device_time_ns` is the device's own clock. Without it, jnd stamps new measurements. */
  JND_DEVICE_HAS_DEVICE_TIME = 1u << 4,
  /* `enabled` is the state of an enabling switch. Without it, the switch counts as closed. */
  JND_DEVICE_HAS_ENABLE_SWITCH = 1u << 5,
  /* The fields of these names are measured. jnd checks and records them. */
  JND_DEVICE_HAS_ORIENTATION = 1u << 6,
  JND_DEVICE_HAS_TORQUE = 1u << 7,
  JND_DEVICE_HAS_GRIPPER = 1u << 8,
  JND_DEVICE_HAS_BUTTONS = 1u << 9,
  /* `measured_force_n` comes from force sensors. It then counts as the delivered force. */
  JND_DEVICE_MEASURES_FORCE = 1u << 10,
  /* It sets the pace: `jnd_device_read` waits for the next measurement, for two periods at
   * most, and jnd responds to each with one write. It has its own clock. */
  JND_DEVICE_PACES_LOOP = 1u << 11
};

/* Every number must be finite. jnd clears the whole struct and sets `struct_size`
 * beforehand. */
typedef struct jnd_device_description {
  uint32_t struct_size;                /* Bytes of this struct as jnd was compiled. */
  uint32_t flags;                      /* JND_DEVICE_IS_SIMULATED and so on. */
  char name[JND_DEVICE_TEXT_SIZE];     /* Printable ASCII and a zero, not empty. */
  char serial[JND_DEVICE_TEXT_SIZE];   /* The same, or empty; known once it is open. */
  char firmware[JND_DEVICE_TEXT_SIZE]; /* The same, or empty; known once it is open. */
  uint32_t contact_point_bits;         /* Bit i: it has point i; at least one. */
  uint32_t reserved;                   /* 0. */
  /* Share of the hand's force at each point, as a ratio: > 0 where it has a point, 0
   * elsewhere, 1 in total. All zero means the areas of a hand: 0.35, 0.35, 0.10, 0.10, 0.10,
   * divided by their sum over its points. */
  double area_share_ratio[JND_DEVICE_MAX_POINTS];
  double rate_hz; /* Nominal rate of its control loop, Hz, at least that of the study. */
  double max_force_per_point_n; /* Largest force that it renders at one point, N, > 0. */
  double max_total_force_n;     /* Largest sum of its forces over the points, N, > 0. */
  /* Largest change of a point's force that it can follow, N/s, > 0. */
  double max_slew_n_per_s;
  double max_speed_m_per_s; /* Largest valid speed of a point, m/s, > 0. */
  double
      workspace_half_width_m[3]; /* Box about the origin in which it may give force, m, > 0. */
  double own_mass_kg;            /* Mass that a hand feels in free space, kg, >= 0. */
  double own_damping_n_s_per_m;  /* Damping that a hand feels in free space, N s/m, >= 0. */
  double closed_loop_delay_s;    /* Time from a write until a read shows its effect, s, >= 0. */
  double open_timeout_s;         /* Time that open may take, s, at most 120 s; 0 means 10 s. */
} jnd_device_description;

/* One measurement. jnd clears it and sets `struct_size` beforehand. */
typedef struct jnd_device_state {
  uint32_t struct_size;   /* Bytes of this struct as jnd was compiled. */
  uint32_t attached_bits; /* Bit i: point i is attached to the hand. Others get no force. */
  uint64_t
      /* Increases with each new measurement. The same number means the measurement before. */
      sample_number;
  /* Time of the measurement by the device's clock, ns, any epoch; increasing. */
  int64_t device_time_ns;
  /* Position of each point, m, workspace frame. */
  double position_m[JND_DEVICE_MAX_POINTS][3];
  /* Velocity of each point, m/s, workspace frame. */
  double velocity_m_per_s[JND_DEVICE_MAX_POINTS][3];
  /* Force on the hand that acted between the measurement before and this one, N: the motor
   * commands after every limit and delay of the device, and zeros while it gives none. */
  double acted_n[JND_DEVICE_MAX_POINTS][3];
  /* End of the arm that carries the device, m; zeros without an arm. */
  double end_effector_position_m[3];
  /* Force on the hand that force sensors measured now, N, workspace frame. */
  double measured_force_n[JND_DEVICE_MAX_POINTS][3];
  double orientation_wxyz[4]; /* Of the end effector, a unit quaternion to the workspace. */
  double torque_n_m[3];       /* On the hand at the end effector, N m, workspace frame. */
  double gripper_m;           /* Opening, m. */
  uint32_t buttons;           /* Bit i: button i is pressed. */
  uint32_t enabled;           /* 1: the enabling switch is closed; 0: it is open. */
} jnd_device_state;

/* What to render from now on, until the next write or halt. */
typedef struct jnd_device_command {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t write_number; /* One more than in the write before; 1 after open. */
  /* Force on the hand at each point, N, workspace frame. It is finite and within the
   * description's limits, because it has passed passivity and the force limiter. Zeros at
   * points that the device does not have. */
  double force_on_hand_n[JND_DEVICE_MAX_POINTS][3];
} jnd_device_command;

/* An open device. It belongs to the driver, and nobody else looks inside. */
typedef struct jnd_device jnd_device;

/* Returns JND_DEVICE_ABI as the driver was compiled. jnd calls it first. */
JND_DEVICE_EXPORT uint32_t jnd_device_abi(void);

/* Describes the device. `device` is null before open. After open jnd asks again; then serial
 * and firmware may be filled in, but nothing else may differ. `options` is the part
 * KEY=VALUE,... of the device's name, or "". It may take its time. */
JND_DEVICE_EXPORT int jnd_device_describe(jnd_device* device, const char* options,
                                          jnd_device_description* description);

/* Makes the device ready to be read and to take forces. Motors may be on afterwards, at zero
 * force. `rate_hz` is the rate of the loop. It may take `open_timeout_s`. On failure
 * `*device` stays null. */
JND_DEVICE_EXPORT int jnd_device_open(const char* options, double rate_hz, jnd_device** device);

/* Reads the newest measurement within 0.2 ms, without waiting for one, and without heap or
 * lock. The first read after open has to bring one, so open waits for it. A device that paces
 * the loop waits for the next measurement here. */
JND_DEVICE_EXPORT int jnd_device_read(jnd_device* device, jnd_device_state* state);

/* Renders the command, under the same conditions. If it fails, the force was not taken, and
 * jnd halts the device. */
JND_DEVICE_EXPORT int jnd_device_write(jnd_device* device, const jnd_device_command* command);

/* Sets zero force at once. Any thread may call it, repeatedly. jnd then withholds forces
 * until it has written zeros once. */
JND_DEVICE_EXPORT void jnd_device_halt(jnd_device* device);

/* Sets zero force, switches the motors off and frees memory. It has 2 s before the process
 * is ended. */
JND_DEVICE_EXPORT void jnd_device_close(jnd_device* device);

/* Returns why the last call failed, as one line of text that stays until the next call.
 * `device` is null for a failed open or a describe before it. Never returns null. */
JND_DEVICE_EXPORT const char* jnd_device_error(jnd_device* device);

/* NOLINTEND */

#endif
