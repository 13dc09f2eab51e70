/* A simulated pincer that holds thumb and index finger, and reports everything that a driver
 * can: its own shares, force sensors that show 90 % of the commanded force, orientation,
 * torque, gripper, buttons, and a clock that is off by ppm= parts in a million. It sets the
 * pace at rate= Hz, unless free=1 says that it only has its own clock. The hand strokes
 * along x by itself. With stall= it brings no measurement for this many seconds, once, after
 * a second. With wild= it is this many times faster than it says. */
#include "jnd_device.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct jnd_device {
  int is_paced;
  double rate_hz, ppm, stall_s, wild;
  int64_t begun_ns, next_ns;
  uint64_t number;
  double force_n[JND_DEVICE_MAX_POINTS][3];
};

static double option(const char* options, const char* key, double otherwise) {
  const char* at = strstr(options, key);
  return at == NULL ? otherwise : strtod(at + strlen(key), NULL);
}

static int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000000000ll * now.tv_sec + now.tv_nsec;
}

static void sleep_until(int64_t until_ns) {
  const struct timespec until = {.tv_sec = until_ns / 1000000000,
                                 .tv_nsec = until_ns % 1000000000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) != 0) {
  }
}

uint32_t jnd_device_abi(void) { return JND_DEVICE_ABI; }

int jnd_device_describe(jnd_device* device, const char* options,
                        jnd_device_description* description) {
  snprintf(description->name, sizeof description->name, "pincer");
  if (device != NULL) snprintf(description->serial, sizeof description->serial, "P-7");
  description->flags = JND_DEVICE_IS_SIMULATED | JND_DEVICE_MOVES_BY_ITSELF |
                       JND_DEVICE_HAS_OWN_CLOCK | JND_DEVICE_HAS_DEVICE_TIME |
                       JND_DEVICE_TELLS_ACTED_FORCE | JND_DEVICE_MEASURES_FORCE |
                       JND_DEVICE_HAS_ORIENTATION | JND_DEVICE_HAS_TORQUE |
                       JND_DEVICE_HAS_GRIPPER | JND_DEVICE_HAS_BUTTONS;
  if (option(options, "free=", 0.0) == 0.0) description->flags |= JND_DEVICE_PACES_LOOP;
  description->contact_point_bits = 1u << 2 | 1u << 3;
  description->area_share_ratio[2] = 0.25;
  description->area_share_ratio[3] = 0.75;
  description->rate_hz = option(options, "rate=", 1000.0);
  description->max_force_per_point_n = 10.0;
  description->max_total_force_n = 20.0;
  description->max_slew_n_per_s = 2000.0;
  description->max_speed_m_per_s = 5.0;
  for (int axis = 0; axis < 3; ++axis) description->workspace_half_width_m[axis] = 1.0;
  description->own_mass_kg = 0.3;
  description->own_damping_n_s_per_m = 1.5;
  description->closed_loop_delay_s = 0.001;
  return JND_DEVICE_OK;
}

int jnd_device_open(const char* options, double rate_hz, jnd_device** made) {
  jnd_device* device = calloc(1, sizeof *device);
  (void)rate_hz;
  device->is_paced = option(options, "free=", 0.0) == 0.0;
  device->rate_hz = option(options, "rate=", 1000.0);
  device->ppm = option(options, "ppm=", 0.0);
  device->stall_s = option(options, "stall=", 0.0);
  device->wild = option(options, "wild=", 1.0);
  device->begun_ns = device->next_ns = now_ns();
  *made = device;
  return JND_DEVICE_OK;
}

int jnd_device_read(jnd_device* device, jnd_device_state* state) {
  const double turn_rad = 3.0;
  double period_ns = 1e9 / device->rate_hz / (1.0 + 1e-6 * device->ppm) / device->wild;
  if (device->is_paced) {
    sleep_until(device->next_ns);
    ++device->number;
    if (device->stall_s > 0.0 && device->number == (uint64_t)device->rate_hz) {
      sleep_until(now_ns() + (int64_t)(1e9 * device->stall_s));
    }
    device->next_ns = device->begun_ns + (int64_t)((double)device->number * period_ns);
  } else {
    device->number = (uint64_t)((double)(now_ns() - device->begun_ns) / period_ns) + 1;
  }
  const double time_s = (double)(now_ns() - device->begun_ns) * 1e-9;
  state->sample_number = device->number;
  state->device_time_ns = (int64_t)(1e9 * time_s * (1.0 + 1e-6 * device->ppm)) + 1;
  state->attached_bits = 1u << 2 | 1u << 3;
  state->enabled = 1;
  for (int point = 2; point < 4; ++point) {
    state->position_m[point][0] = 0.1 * sin(turn_rad * time_s) + 0.02 * (point - 2);
    state->position_m[point][2] = -0.15;
    state->velocity_m_per_s[point][0] = 0.1 * turn_rad * cos(turn_rad * time_s);
    for (int axis = 0; axis < 3; ++axis) {
      state->acted_n[point][axis] = device->force_n[point][axis];
      state->measured_force_n[point][axis] = 0.9 * device->force_n[point][axis];
    }
  }
  state->orientation_wxyz[0] = 0.6;
  state->orientation_wxyz[3] = 0.8;
  state->torque_n_m[1] = 0.02;
  state->gripper_m = 0.03;
  state->buttons = 5;
  return JND_DEVICE_OK;
}

int jnd_device_write(jnd_device* device, const jnd_device_command* command) {
  memcpy(device->force_n, command->force_on_hand_n, sizeof device->force_n);
  return JND_DEVICE_OK;
}

void jnd_device_halt(jnd_device* device) {
  memset(device->force_n, 0, sizeof device->force_n);
}

void jnd_device_close(jnd_device* device) { free(device); }

const char* jnd_device_error(jnd_device* device) {
  (void)device;
  return "";
}
