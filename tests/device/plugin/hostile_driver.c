/* A driver of one point at rest that does everything wrong that its options name.
 * trouble=NAME is wrong from the read number after= on. log= is a file into which the driver
 * writes what the motors were told last. flags= sets more flags of the description. Definitions
 * by -D are wrong before that. */
#include "jnd_device.h"

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

struct jnd_device {
  char trouble[32];
  long after;
  int log;
  uint64_t num_reads, num_writes;
  double force_n, max_slew_n;
};

static char word_text[512];

static const char* word(const char* options, const char* key) {
  const char* at = strstr(options, key);
  if (at == NULL) return "";
  snprintf(word_text, sizeof word_text, "%s", at + strlen(key));
  word_text[strcspn(word_text, ",")] = '\0';
  return word_text;
}

static int is(const char* trouble, const char* name) { return strcmp(trouble, name) == 0; }

static void hang(void) {
  for (;;) pause();
}

/* Writes the force that now acts on the hand, and how often the driver was halted. */
static void tell(jnd_device* device, double force_n, int is_halt) {
  double told[2] = {force_n, 0.0};
  if (device->log < 0) return;
  if (pread(device->log, &told[1], sizeof told[1], sizeof told[0]) < 0) return;
  if (is_halt) told[1] += 1.0;
  if (pwrite(device->log, told, sizeof told, 0) < 0) return;
}

#ifdef ABORTS_IN_LOAD
__attribute__((constructor)) static void load(void) { abort(); }
#endif

#ifdef WRONG_ABI
uint32_t jnd_device_abi(void) { return JND_DEVICE_ABI + 41u; }
#else
uint32_t jnd_device_abi(void) { return JND_DEVICE_ABI; }
#endif

int jnd_device_describe(jnd_device* device, const char* options,
                        jnd_device_description* description) {
  char trouble[32];
  snprintf(trouble, sizeof trouble, "%s", word(options, "trouble="));
  if (is(trouble, "crash_in_describe")) abort();
  if (is(trouble, "hang_in_describe")) hang();
  if (is(trouble, "fail_in_describe")) return JND_DEVICE_FAILED;
  snprintf(description->name, sizeof description->name, "hostile");
  description->flags = JND_DEVICE_IS_SIMULATED | JND_DEVICE_HAS_DEVICE_TIME |
                       JND_DEVICE_TELLS_ACTED_FORCE |
                       (uint32_t)strtoul(word(options, "flags="), NULL, 0);
  description->contact_point_bits = is(trouble, "nine_points") ? 0x1ff : 1;
  if (is(trouble, "other_shares")) description->area_share_ratio[0] = 0.5;
  description->rate_hz = 1000.0;
  description->max_force_per_point_n = is(trouble, "no_limit") ? (double)NAN : 10.0;
  if (is(trouble, "changes_its_mind") && device != NULL)
    description->max_force_per_point_n = 99;
  description->max_total_force_n = 10.0;
  description->max_slew_n_per_s = 2000.0;
  description->max_speed_m_per_s = 5.0;
  for (int axis = 0; axis < 3; ++axis) description->workspace_half_width_m[axis] = 1.0;
  /* The time is short if the program waits in vain. A process that crashes may take a while. */
  description->open_timeout_s = is(trouble, "hang_in_open") ? 0.3 : 0.0;
  return JND_DEVICE_OK;
}

int jnd_device_open(const char* options, double rate_hz, jnd_device** made) {
  jnd_device* device = calloc(1, sizeof *device);
  (void)rate_hz;
  snprintf(device->trouble, sizeof device->trouble, "%s", word(options, "trouble="));
  device->after = strtol(word(options, "after="), NULL, 10);
  device->log = open(word(options, "log="), O_RDWR | O_CREAT, 0600);
  if (is(device->trouble, "crash_in_open")) raise(SIGSEGV);
  if (is(device->trouble, "exit_in_open")) exit(7);
  if (is(device->trouble, "hang_in_open")) hang();
  if (is(device->trouble, "fail_in_open")) return JND_DEVICE_FAILED;
  *made = device;
  return JND_DEVICE_OK;
}

int jnd_device_read(jnd_device* device, jnd_device_state* state) {
  const char* trouble = device->trouble;
  struct timespec now;
  const int is_late = (long)++device->num_reads > device->after;
  if (is_late && is(trouble, "crash_in_read")) abort();
  if (is_late && is(trouble, "hang_in_read")) hang();
  if (is_late && is(trouble, "exit_in_read")) exit(0);
  if (is_late && is(trouble, "fail_in_read")) return JND_DEVICE_FAILED;
  if (is_late && is(trouble, "no_sample")) return JND_DEVICE_NO_SAMPLE;
  clock_gettime(CLOCK_MONOTONIC, &now);
  state->sample_number =
      is_late && is(trouble, "half_rate") ? device->num_reads / 2 + 1000000 : device->num_reads;
  state->device_time_ns = 1000000000ll * now.tv_sec + now.tv_nsec;
  if (is_late && is(trouble, "old_number")) state->sample_number = 1;
  if (is_late && is(trouble, "time_back")) state->device_time_ns = 1;
  state->attached_bits = is_late && is(trouble, "sixth_point") ? 1u << 5 : 1u;
  state->enabled = 1;
  state->position_m[0][1] = is_late && is(trouble, "jump") ? 0.3 : 0.0;
  if (is_late && is(trouble, "nan")) state->velocity_m_per_s[0][2] = (double)NAN;
  return JND_DEVICE_OK;
}

int jnd_device_write(jnd_device* device, const jnd_device_command* command) {
  const int is_late = (long)++device->num_writes > device->after;
  if (is_late && is(device->trouble, "fail_in_write")) return JND_DEVICE_FAILED;
  device->force_n = command->force_on_hand_n[0][0];
  tell(device, device->force_n, 0);
  return JND_DEVICE_OK;
}

void jnd_device_halt(jnd_device* device) { tell(device, 0.0, 1); }

#ifdef LACKS_CLOSE
void jnd_device_shut(jnd_device* device) { free(device); }
#else
void jnd_device_close(jnd_device* device) {
  if (is(device->trouble, "hang_in_close")) hang();
  free(device);
}
#endif

const char* jnd_device_error(jnd_device* device) {
  (void)device;
  return "the emergency stop\nof the \"robot\" is pressed.";
}
