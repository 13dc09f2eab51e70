/* A driver that records what its motors were told, for a judge that must know nothing of the
 * program. It has a hand of five points that strokes along x by itself in the fluid, whatever
 * the force. Its time is this machine's.
 *
 * log=PATH: each opening writes a file PATH.PROCESS of records of 128 bytes, one for each write
 * and each halt. A record has the time (CLOCK_MONOTONIC, ns, int64) and the 15 components of
 * the force that stands from then on (N, double). The file PATH.PROCESS.beats gets the time
 * alone, some five hundred times a second, and so shows when this process ran. Nothing is
 * buffered, so a killed process has written everything.
 * plug=PATH: while this file exists, the device is unplugged and calls fail.
 * paces=1: the driver sets the pace of the loop. points=BITS: the points that it has.
 * wrong=NAME: the driver is wrong on purpose. With "halt" it ignores a halt, and forces that
 * become zero. With "limits" the motors give three times the force that they are asked for. */
#include "jnd_device.h"

#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { TEXT_SIZE = 400, POINTS = JND_DEVICE_MAX_POINTS };

struct jnd_device {
  int log, beats, is_paced, ignores_halts;
  double factor;
  uint32_t points;
  char plug[TEXT_SIZE];
  int64_t begun_ns, next_ns;
  uint64_t number;
  double force_n[POINTS][3]; /* The force of the last write. */
  atomic_int is_halted;      /* Set by any thread after that write. */
  atomic_int is_over;
  pthread_t beating;
};

static const double RATE_HZ = 1000.0, AMPLITUDE_M = 0.09, TURN_RAD_PER_S = 10.0;
static char error_text[128] = "";

static int failed(const char* words) {
  snprintf(error_text, sizeof error_text, "%s", words);
  return JND_DEVICE_FAILED;
}

/* Copies what follows KEY= in the options to text, or "" if KEY= is not there. */
static void word(const char* options, const char* key, char* text) {
  const char* at = strstr(options, key);
  snprintf(text, TEXT_SIZE, "%s", at == NULL ? "" : at + strlen(key));
  text[strcspn(text, ",")] = '\0';
}

static long number(const char* options, const char* key, long otherwise) {
  char text[TEXT_SIZE];
  word(options, key, text);
  return text[0] == '\0' ? otherwise : strtol(text, NULL, 10);
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

/* Two threads call this. The system keeps their records whole and separate. */
static void tell(jnd_device* device, double force_n[POINTS][3]) {
  struct {
    int64_t time_ns;
    double force_n[POINTS][3];
  } record = {.time_ns = now_ns()};
  for (int point = 0; point < POINTS; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      record.force_n[point][axis] = device->factor * force_n[point][axis];
    }
  }
  if (write(device->log, &record, sizeof record) < 0) return;
}

static void tell_none(jnd_device* device) {
  double none_n[POINTS][3] = {{0.0}};
  tell(device, none_n);
}

static void* beat(void* of) {
  jnd_device* device = of;
  while (!atomic_load(&device->is_over)) {
    const int64_t time_ns = now_ns();
    if (write(device->beats, &time_ns, sizeof time_ns) < 0) break;
    sleep_until(time_ns + 2000000);
  }
  return NULL;
}

static int is_unplugged(const jnd_device* device) {
  return device->plug[0] != '\0' && access(device->plug, F_OK) == 0;
}

uint32_t jnd_device_abi(void) { return JND_DEVICE_ABI; }

int jnd_device_describe(jnd_device* device, const char* options,
                        jnd_device_description* description) {
  (void)device;
  snprintf(description->name, sizeof description->name, "observing hand");
  description->flags = JND_DEVICE_IS_SIMULATED | JND_DEVICE_MOVES_BY_ITSELF |
                       JND_DEVICE_HAS_OWN_CLOCK | JND_DEVICE_HAS_DEVICE_TIME |
                       JND_DEVICE_TELLS_ACTED_FORCE;
  if (number(options, "paces=", 0) != 0) description->flags |= JND_DEVICE_PACES_LOOP;
  description->contact_point_bits = (uint32_t)number(options, "points=", 31);
  description->rate_hz = RATE_HZ;
  description->max_force_per_point_n = 6.0;
  description->max_total_force_n = 15.0;
  description->max_slew_n_per_s = 2000.0;
  description->max_speed_m_per_s = 5.0;
  for (int axis = 0; axis < 3; ++axis) description->workspace_half_width_m[axis] = 1.0;
  description->own_mass_kg = 0.5;
  description->closed_loop_delay_s = 0.001;
  return JND_DEVICE_OK;
}

static int opened_file(const char* path, const char* end) {
  char name[TEXT_SIZE + 40];
  snprintf(name, sizeof name, "%s.%ld%s", path, (long)getpid(), end);
  return open(name, O_WRONLY | O_CREAT | O_APPEND, 0600);
}

int jnd_device_open(const char* options, double rate_hz, jnd_device** made) {
  char path[TEXT_SIZE], wrong[TEXT_SIZE];
  jnd_device* device = calloc(1, sizeof *device);
  (void)rate_hz;
  if (device == NULL) return failed("expected memory, found none");
  word(options, "log=", path);
  word(options, "wrong=", wrong);
  word(options, "plug=", device->plug);
  if (is_unplugged(device)) {
    free(device);
    return failed("expected a device, found its cable pulled");
  }
  device->ignores_halts = strcmp(wrong, "halt") == 0;
  device->factor = strcmp(wrong, "limits") == 0 ? 3.0 : 1.0;
  device->is_paced = number(options, "paces=", 0) != 0;
  device->points = (uint32_t)number(options, "points=", 31);
  device->log = opened_file(path, "");
  device->beats = opened_file(path, ".beats");
  if (device->log < 0 || device->beats < 0 ||
      pthread_create(&device->beating, NULL, beat, device) != 0) {
    free(device);
    return failed("expected log=PATH in a folder that can be written");
  }
  device->begun_ns = device->next_ns = now_ns();
  tell_none(device);
  *made = device;
  return JND_DEVICE_OK;
}

int jnd_device_read(jnd_device* device, jnd_device_state* state) {
  const int64_t period_ns = (int64_t)(1e9 / RATE_HZ);
  if (is_unplugged(device)) {
    if (device->is_paced) sleep_until(now_ns() + period_ns);
    return failed("the cable is pulled");
  }
  if (device->is_paced) {
    sleep_until(device->next_ns);
    /* Measurements that were due while this process stood still are skipped. */
    const int64_t late_ns = now_ns() - device->next_ns;
    device->next_ns += period_ns * (1 + (late_ns > 0 ? late_ns / period_ns : 0));
  }
  const int64_t time_ns = now_ns();
  const double phase_rad = TURN_RAD_PER_S * 1e-9 * (double)(time_ns - device->begun_ns);
  const int is_halted = atomic_load(&device->is_halted);
  state->sample_number = ++device->number;
  state->device_time_ns = time_ns;
  state->attached_bits = device->points;
  state->enabled = 1;
  for (int point = 0; point < POINTS; ++point) {
    if ((device->points >> point & 1u) == 0) continue;
    state->position_m[point][0] = 0.02 * point - AMPLITUDE_M * cos(phase_rad);
    state->position_m[point][2] = -0.15;
    state->velocity_m_per_s[point][0] = AMPLITUDE_M * TURN_RAD_PER_S * sin(phase_rad);
    for (int axis = 0; axis < 3; ++axis) {
      state->acted_n[point][axis] = is_halted ? 0.0 : device->force_n[point][axis];
    }
  }
  return JND_DEVICE_OK;
}

int jnd_device_write(jnd_device* device, const jnd_device_command* command) {
  double sum_n = 0.0;
  for (int point = 0; point < POINTS; ++point) {
    for (int axis = 0; axis < 3; ++axis) sum_n += fabs(command->force_on_hand_n[point][axis]);
  }
  if (is_unplugged(device)) return failed("the cable is pulled");
  if (device->ignores_halts && sum_n == 0.0) return JND_DEVICE_OK;
  memcpy(device->force_n, command->force_on_hand_n, sizeof device->force_n);
  atomic_store(&device->is_halted, 0);
  tell(device, device->force_n);
  return JND_DEVICE_OK;
}

void jnd_device_halt(jnd_device* device) {
  if (device->ignores_halts) return;
  atomic_store(&device->is_halted, 1);
  tell_none(device);
}

void jnd_device_close(jnd_device* device) {
  atomic_store(&device->is_over, 1);
  pthread_join(device->beating, NULL);
  tell_none(device);
  close(device->log);
  close(device->beats);
  free(device);
}

const char* jnd_device_error(jnd_device* device) {
  (void)device;
  return error_text;
}
