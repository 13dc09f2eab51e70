/* A driver to begin with: a simulated hand of one point. A mass hangs on a spring and a
 * damper whose other end moves to and fro, like the arm of a person who strokes through a
 * fluid. The program's force acts on the mass. There is no hardware behind it.
 *
 *     cc -std=c11 -Wall -shared -fPIC -I . example_device.c -o example_device.so
 *     jnd run short_tour --device plugin:./example_device.so:simulated --headless \
 *         --study tour.study --participant P01
 *
 * Options: mass=KG and amplitude=M, as in plugin:./example_device.so:simulated,mass=0.5. */
#include "jnd_device.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct jnd_device {
  double period_s, mass_kg, amplitude_m, phase_ratio;
  double position_m[3], velocity_m_per_s[3], acted_n[3];
  uint64_t num_steps;
  atomic_int halted; /* Set by the other thread. */
};

static char error_text[128] = "";

static int failed(const char* words) {
  snprintf(error_text, sizeof error_text, "%s", words);
  return JND_DEVICE_FAILED;
}

/* Returns the number after KEY= in the options, or `otherwise` if the key is missing. */
static double option(const char* options, const char* key, double otherwise) {
  const char* at = strstr(options, key);
  return at == NULL ? otherwise : strtod(at + strlen(key), NULL);
}

uint32_t jnd_device_abi(void) { return JND_DEVICE_ABI; }

int jnd_device_describe(jnd_device* device, const char* options,
                        jnd_device_description* description) {
  (void)options;
  snprintf(description->name, sizeof description->name, "example hand");
  snprintf(description->firmware, sizeof description->firmware, "1.0");
  if (device != NULL) snprintf(description->serial, sizeof description->serial, "simulated");
  /* Its time advances with each write, so it has no clock of its own. */
  description->flags = JND_DEVICE_IS_SIMULATED | JND_DEVICE_MOVES_BY_ITSELF |
                       JND_DEVICE_HAS_DEVICE_TIME | JND_DEVICE_TELLS_ACTED_FORCE;
  description->contact_point_bits = 1; /* The inner palm, which stands for the hand. */
  description->area_share_ratio[0] = 1.0;
  description->rate_hz = 1000.0;
  description->max_force_per_point_n = 30.0;
  description->max_total_force_n = 30.0;
  description->max_slew_n_per_s = 2000.0;
  description->max_speed_m_per_s = 5.0;
  for (int axis = 0; axis < 3; ++axis) description->workspace_half_width_m[axis] = 1.0;
  description->own_mass_kg = option(options, "mass=", 1.0);
  description->closed_loop_delay_s = 0.001;
  return JND_DEVICE_OK;
}

int jnd_device_open(const char* options, double rate_hz, jnd_device** device) {
  const double mass_kg = option(options, "mass=", 1.0);
  const double amplitude_m = option(options, "amplitude=", 0.15);
  if (!(mass_kg >= 0.1 && mass_kg <= 10.0)) return failed("expected mass= from 0.1 to 10 kg");
  if (!(amplitude_m > 0.0 && amplitude_m <= 0.5)) {
    return failed("expected amplitude= up to 0.5 m");
  }
  jnd_device* made = calloc(1, sizeof *made);
  if (made == NULL) return failed("expected memory, found none");
  made->period_s = 1.0 / rate_hz;
  made->mass_kg = mass_kg;
  made->amplitude_m = amplitude_m;
  made->position_m[0] = -amplitude_m;
  made->position_m[2] = -0.15; /* The hand begins in the fluid. */
  *device = made;
  return JND_DEVICE_OK;
}

int jnd_device_read(jnd_device* device, jnd_device_state* state) {
  state->attached_bits = 1;
  state->enabled = 1;
  state->sample_number = device->num_steps + 1;
  state->device_time_ns = (int64_t)(1e9 * device->period_s * (double)(device->num_steps + 1));
  memcpy(state->position_m[0], device->position_m, sizeof device->position_m);
  memcpy(state->velocity_m_per_s[0], device->velocity_m_per_s, sizeof device->velocity_m_per_s);
  memcpy(state->acted_n[0], device->acted_n, sizeof device->acted_n);
  return JND_DEVICE_OK;
}

/* The arm's way along x: to and fro in two seconds. Each stroke is a cubic with rest at its
 * ends. */
static double way_m(jnd_device* device, double* velocity_m_per_s) {
  const double stroke_s = 1.0;
  device->phase_ratio += device->period_s / (2.0 * stroke_s);
  if (device->phase_ratio >= 1.0) device->phase_ratio -= 1.0;
  const int is_back = device->phase_ratio >= 0.5;
  const double t = 2.0 * device->phase_ratio - is_back;
  const double sign = is_back ? -1.0 : 1.0;
  *velocity_m_per_s = sign * device->amplitude_m * 12.0 * t * (1.0 - t) / stroke_s;
  return sign * device->amplitude_m * (2.0 * t * t * (3.0 - 2.0 * t) - 1.0);
}

int jnd_device_write(jnd_device* device, const jnd_device_command* command) {
  const double stiffness_n_per_m = 600.0, damping_n_s_per_m = 30.0;
  double anchor_m[3] = {0.0, 0.0, -0.15}, anchor_m_per_s[3] = {0.0, 0.0, 0.0};
  const int is_halted = atomic_exchange(&device->halted, 0);
  anchor_m[0] = way_m(device, &anchor_m_per_s[0]);
  for (int axis = 0; axis < 3; ++axis) {
    const double acted_n = is_halted ? 0.0 : command->force_on_hand_n[0][axis];
    const double force_n =
        acted_n + stiffness_n_per_m * (anchor_m[axis] - device->position_m[axis]) +
        damping_n_s_per_m * (anchor_m_per_s[axis] - device->velocity_m_per_s[axis]);
    device->acted_n[axis] = acted_n;
    device->velocity_m_per_s[axis] += device->period_s / device->mass_kg * force_n;
    device->position_m[axis] += device->period_s * device->velocity_m_per_s[axis];
  }
  ++device->num_steps;
  return JND_DEVICE_OK;
}

/* A real driver stops its motors here. This one gives no force in its next step. */
void jnd_device_halt(jnd_device* device) { atomic_store(&device->halted, 1); }

void jnd_device_close(jnd_device* device) { free(device); }

const char* jnd_device_error(jnd_device* device) {
  (void)device;
  return error_text;
}
