#ifndef JND_DEVICE_H
#define JND_DEVICE_H

/* The interface between jnd and the driver of a haptic device, ABI version 1. C11 and C++.
 *
 * A driver is a shared object that defines the eight functions below and needs nothing of jnd
 * but this header:
 *
 *     cc -std=c11 -shared -fPIC -I DIRECTORY_OF_THIS_HEADER my_device.c -o my_device.so
 *     jnd loop --device plugin:./my_device.so:real
 *
 * Units are SI throughout. The frame is the workspace's: +x to the participant's right, +y away
 * from the participant, +z up; the surface of a fluid is the plane z = 0. A device with another
 * frame transforms inside its driver. Forces are those ON THE HAND, not on the device: the drag
 * on a hand that moves to the right is negative in x.
 *
 * Contact points are at most five, always in this order: inner palm, outer palm, thumb, index,
 * middle. A device with fewer says which. A tool that is held like a pen has the first alone.
 *
 * jnd calls a driver in a process of its own, by one thread: describe, open, then once a tick
 * write and read, then close. `jnd_device_halt` alone may be called by a second thread, at any
 * time after open, also while another call is under way or stuck.
 *
 * That thread has real-time priority (SCHED_FIFO 79). Threads of the driver's own have ordinary
 * priority until it gives them a lower one of SCHED_FIFO; measurements of a thread without it
 * come too late on a busy machine.
 *
 * Zero force is none on the hand, not none in the motors: a device that has weight of its own
 * goes on holding it while it is halted. And whatever this program does, the device's own
 * controller sets its force to zero when no command has come for 20 ms.
 */

/* C, which the checks of C++ do not know. NOLINTBEGIN */
#include <stdint.h>

#if defined(__cplusplus)
#define JND_DEVICE_EXPORT extern "C" __attribute__((visibility("default")))
#else
#define JND_DEVICE_EXPORT __attribute__((visibility("default")))
#endif

#define JND_DEVICE_ABI 1u
#define JND_DEVICE_MAX_POINTS 5
#define JND_DEVICE_TEXT_SIZE 64

/* What a function returns. */
enum {
  JND_DEVICE_OK = 0,
  JND_DEVICE_FAILED = 1,   /* `jnd_device_error` says why. */
  JND_DEVICE_NO_SAMPLE = 2 /* Of read alone: nothing new; the measurement before stands in. */
};

/* What a device is and has: `flags` of its description. */
enum {
  /* Nobody can be hurt by it. Believed only where the command line says so, too. */
  JND_DEVICE_IS_SIMULATED = 1u << 0,
  /* Its hand moves without a person: simulated participants may use it. */
  JND_DEVICE_MOVES_BY_ITSELF = 1u << 1,
  /* It lives at its own pace. Without it, a simulation whose time moves on by one period with
   * each write, and which may be run as fast as it goes. A real device has it. */
  JND_DEVICE_HAS_OWN_CLOCK = 1u << 2,
  /* `acted_n` is what acted. A real device without it is never armed. */
  JND_DEVICE_TELLS_ACTED_FORCE = 1u << 3,
  /* `device_time_ns` is the device's own. Without it, jnd stamps what is new. */
  JND_DEVICE_HAS_DEVICE_TIME = 1u << 4,
  /* `enabled` is an enabling switch's. Without it, it counts as closed. */
  JND_DEVICE_HAS_ENABLE_SWITCH = 1u << 5,
  /* The fields of these names are measured. jnd checks and records them. */
  JND_DEVICE_HAS_ORIENTATION = 1u << 6,
  JND_DEVICE_HAS_TORQUE = 1u << 7,
  JND_DEVICE_HAS_GRIPPER = 1u << 8,
  JND_DEVICE_HAS_BUTTONS = 1u << 9,
  /* `measured_force_n` comes from sensors of force. What was delivered is then what they say.
   */
  JND_DEVICE_MEASURES_FORCE = 1u << 10,
  /* It sets the pace: `jnd_device_read` waits for the next measurement, for two periods at
   * most, and jnd answers to each with one write. It has its own clock. */
  JND_DEVICE_PACES_LOOP = 1u << 11
};

/* Every number is finite. jnd clears the whole struct and sets `struct_size` beforehand. */
typedef struct jnd_device_description {
  uint32_t struct_size;                /* Bytes of this struct, as jnd was compiled. */
  uint32_t flags;                      /* JND_DEVICE_IS_SIMULATED and so on. */
  char name[JND_DEVICE_TEXT_SIZE];     /* Printable ASCII and a zero, not empty. */
  char serial[JND_DEVICE_TEXT_SIZE];   /* Likewise, or empty; known once it is open. */
  char firmware[JND_DEVICE_TEXT_SIZE]; /* Likewise. */
  uint32_t contact_point_bits;         /* Bit i: it has point i; at least one. */
  uint32_t reserved;                   /* 0. */
  /* Share of the hand's force that each point carries, ratio: > 0 where it has a point, 0
   * elsewhere, together 1. All zero: by the areas of a hand, which are 0.35, 0.35, 0.10, 0.10,
   * 0.10 over the sum of the points it has. */
  double area_share_ratio[JND_DEVICE_MAX_POINTS];
  double rate_hz; /* Of its control loop, Hz, nominal, at least that of the study. */
  double max_force_per_point_n; /* The largest it renders at one point, N, > 0. */
  double max_total_force_n;     /* Likewise, sum over the points, N, > 0. */
  double max_slew_n_per_s;      /* Change of the force at a point that it follows, N/s, > 0. */
  double max_speed_m_per_s;     /* Of a point, above which something is wrong, m/s, > 0. */
  double
      workspace_half_width_m[3]; /* Box about the origin in which it may give force, m, > 0. */
  double own_mass_kg;            /* That a hand feels in free space, kg, >= 0. */
  double own_damping_n_s_per_m;  /* Likewise, N s/m, >= 0. */
  double closed_loop_delay_s;    /* From a write until a read shows its effect, s, >= 0. */
  double open_timeout_s;         /* For which open may take, s; 0: 10 s; at most 120 s. */
} jnd_device_description;

/* One measurement. jnd clears it and sets `struct_size` beforehand. */
typedef struct jnd_device_state {
  uint32_t struct_size;   /* Bytes of this struct, as jnd was compiled. */
  uint32_t attached_bits; /* Bit i: point i is held to the hand. Others get no force. */
  uint64_t
      sample_number; /* Higher with each new measurement; the same: it is the one before. */
  int64_t device_time_ns; /* Of the measurement, the device's clock, ns, any epoch; rising. */
  double position_m[JND_DEVICE_MAX_POINTS][3];       /* Of each point, m, workspace frame. */
  double velocity_m_per_s[JND_DEVICE_MAX_POINTS][3]; /* Likewise, m/s. */
  /* Force on the hand that acted from the measurement before until this one, N: what the motors
   * were told, after every limit and delay of the device; zeros while it gives none. */
  double acted_n[JND_DEVICE_MAX_POINTS][3];
  double end_effector_position_m[3]; /* Where the arm that carries it ends, m; else zeros. */
  /* Force on the hand that sensors of force measured now, N, workspace frame. */
  double measured_force_n[JND_DEVICE_MAX_POINTS][3];
  double orientation_wxyz[4]; /* Of the end effector, unit quaternion to workspace. */
  double torque_n_m[3];       /* On the hand at the end effector, N m, workspace. */
  double gripper_m;           /* Opening, m. */
  uint32_t buttons;           /* Bit i: button i is pressed. */
  uint32_t enabled;           /* 1: the enabling switch is closed; 0: it is open. */
} jnd_device_state;

/* What to render from now on, until the next write or halt. */
typedef struct jnd_device_command {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t write_number; /* One more than the write's before, from 1 on after open. */
  /* Force on the hand at each point, N, workspace frame; finite, and within the description's
   * limits: it has passed passivity and the force limiter. Zeros at points there are not. */
  double force_on_hand_n[JND_DEVICE_MAX_POINTS][3];
} jnd_device_command;

/* An open device: the driver's own, nobody else looks inside. */
typedef struct jnd_device jnd_device;

/* JND_DEVICE_ABI, as the driver was compiled. Asked first. */
JND_DEVICE_EXPORT uint32_t jnd_device_abi(void);

/* What the device is. `device` is null before open; afterwards it is asked again, and may then
 * tell serial and firmware, but nothing else may differ. `options` is what stands in the
 * device's name as KEY=VALUE, with commas between; "" if nothing. May take its time. */
JND_DEVICE_EXPORT int jnd_device_describe(jnd_device* device, const char* options,
                                          jnd_device_description* description);

/* Makes it ready to be read and to take forces; motors may be on afterwards, at zero force.
 * `rate_hz` is that of the loop. May take `open_timeout_s`. On failure `*device` stays null. */
JND_DEVICE_EXPORT int jnd_device_open(const char* options, double rate_hz, jnd_device** device);

/* The newest measurement, without waiting for one: within 0.2 ms, without a heap or a lock. A
 * device that paces the loop waits for the next one here. */
JND_DEVICE_EXPORT int jnd_device_read(jnd_device* device, jnd_device_state* state);

/* Likewise. Failed: the force was not taken; jnd then halts the device. */
JND_DEVICE_EXPORT int jnd_device_write(jnd_device* device, const jnd_device_command* command);

/* Zero force at once. By any thread, again and again. jnd withholds forces afterwards until it
 * has written zeros once. */
JND_DEVICE_EXPORT void jnd_device_halt(jnd_device* device);

/* Zero force, motors off, memory freed. Within 2 s, or the process is ended. */
JND_DEVICE_EXPORT void jnd_device_close(jnd_device* device);

/* Why the last call failed: one line of text that stays until the next call. `device` is null
 * for a failed open or a describe before it. Never null. */
JND_DEVICE_EXPORT const char* jnd_device_error(jnd_device* device);

/* NOLINTEND */

#endif
