// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The jnd authors. It may be used, copied, changed and sold by anybody for
// anything, without any warranty, as long as this notice stays in it.
//
// A device that jnd uses as `--device network:HOST:PORT,simulated`, in one file of C11 and
// POSIX:
//
//   cc -std=c11 -O2 -Wall -Wextra c_device.c -o c_device && ./c_device --port 4700
//
// It contains a hand without a robot: a damped mass that strokes by itself. Put your robot into
// `read_robot` and `write_robot`, and describe it in `kRobot`. device/network/README.md has the
// tables and the rules; the offsets below are those of its tables. It has not been tried on
// hardware. A robot that can hurt somebody needs a watchdog of its own below this program,
// which takes the force away when a tick overruns, and force limits of its own.

#define _POSIX_C_SOURCE 200809L
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <netinet/in.h>
#include <sched.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { kHello = 1, kWelcome, kRefusal, kState, kCommand, kOrder, kHalt, kGoodbye };
enum { kBusy = 1, kUnknownStream, kOtherVersion, kOtherKey };
enum {
  kFaultState = 2, kFaultForce = 3, kFaultRead = 4, kFaultWrite = 5, kFaultSpeed = 8,
  kFaultWatchdog = 11, kFaultLink = 12, kFaultNotEnabled = 21
};
enum { kVersion = 3, kPoints = 5, kHeaderBytes = 40, kSealBytes = 16, kKeyBytes = 32,
       kMostBytes = 1100, kRing = 8192, kMostTaken = 256, kMostAnswers = 8 };
// Sizes of the contents by kind.
static const size_t kSize[] = {0, 69, 304, 53, 1031, 172, 137, 44, 44};
static const double kSlewNPerS = 2000.0, kMostSpeedMPerS = 5.0;

static const struct {
  const char *name;
  double most_force_n, most_total_force_n;
  bool simulated;        // Nobody can be hurt by it.
  bool moves_by_itself;  // It takes orders, which a person's hand does not.
  // Share of the hand's force at each point, 1 in total. All zero means the areas of a hand.
  double share_ratio[kPoints];
  double half_width_m[3];  // Box about the origin in which it may give force.
  double own_mass_kg, own_damping_n_s_per_m, loop_delay_s;  // 0 if unknown.
  const char *serial, *firmware;                            // "" if unknown.
} kRobot = {"c reference", 8.0, 20.0, true,  true,        {0},
            {1, 1, 1},     1.0, 4.83, 0.001, "simulated", "1.0"};
// Shares by the areas of a hand. A device with fewer points divides them by the sum over its
// points.
static const double kAreaShareRatio[kPoints] = {0.35, 0.35, 0.10, 0.10, 0.10};

// ----- Bytes, least first -----

static void put(uint8_t *to, uint64_t value, int num_bytes) {
  for (int i = 0; i < num_bytes; ++i) to[i] = (uint8_t)(value >> 8 * i);
}
static uint64_t get(const uint8_t *from, int num_bytes) {
  uint64_t value = 0;
  for (int i = 0; i < num_bytes; ++i) value |= (uint64_t)from[i] << 8 * i;
  return value;
}
static void put_f64(uint8_t *to, double value) {
  uint64_t bits;
  memcpy(&bits, &value, 8);
  put(to, bits, 8);
}
static double get_f64(const uint8_t *from) {
  const uint64_t bits = get(from, 8);
  double value;
  memcpy(&value, &bits, 8);
  return value;
}
static void put_text(uint8_t *to, const char *text) {  // 32 bytes, filled up with zeros.
  memcpy(to, text, strlen(text) < 32 ? strlen(text) : 32);
}

static void put_f64s(uint8_t *to, const double *values, int num) {
  for (int i = 0; i < num; ++i) put_f64(to + 8 * i, values[i]);
}

// ----- CRC-32 of Ethernet, SHA-256 (FIPS 180-4), HMAC (RFC 2104) -----

static uint32_t crc32(const uint8_t *bytes, size_t size) {
  static uint32_t table[256];
  for (uint32_t i = 0; table[255] == 0 && i < 256; ++i) {
    table[i] = i;
    for (int bit = 0; bit < 8; ++bit) table[i] = table[i] >> 1 ^ (table[i] & 1) * 0xEDB88320u;
  }
  uint32_t crc = ~0u;
  while (size-- > 0) crc = crc >> 8 ^ table[(crc ^ *bytes++) & 255];
  return ~crc;
}

static uint32_t turned(uint32_t word, int by) { return word >> by | word << (32 - by); }

static void sha256_block(uint32_t hash[8], const uint8_t *block) {
  static const uint32_t k[64] = {
      0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4,
      0xab1c5ed5, 0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe,
      0x9bdc06a7, 0xc19bf174, 0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f,
      0x4a7484aa, 0x5cb0a9dc, 0x76f988da, 0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7,
      0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967, 0x27b70a85, 0x2e1b2138, 0x4d2c6dfc,
      0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85, 0xa2bfe8a1, 0xa81a664b,
      0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070, 0x19a4c116,
      0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
      0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7,
      0xc67178f2};
  uint32_t w[64], h[8];
  for (int i = 0; i < 16; ++i) {
    const uint8_t *at = block + 4 * i;
    w[i] = (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
  }
  for (int i = 16; i < 64; ++i) {
    const uint32_t a = w[i - 15], b = w[i - 2];
    w[i] = w[i - 16] + (turned(a, 7) ^ turned(a, 18) ^ a >> 3) + w[i - 7] +
           (turned(b, 17) ^ turned(b, 19) ^ b >> 10);
  }
  memcpy(h, hash, sizeof h);
  for (int i = 0; i < 64; ++i) {
    const uint32_t e = h[4], a = h[0];
    const uint32_t one = h[7] + (turned(e, 6) ^ turned(e, 11) ^ turned(e, 25)) +
                         ((e & h[5]) ^ (~e & h[6])) + k[i] + w[i];
    const uint32_t two = (turned(a, 2) ^ turned(a, 13) ^ turned(a, 22)) +
                         ((a & h[1]) ^ (a & h[2]) ^ (h[1] & h[2]));
    memmove(h + 1, h, 7 * sizeof *h);
    h[4] += one;
    h[0] = one + two;
  }
  for (int i = 0; i < 8; ++i) hash[i] += h[i];
}

// Hashes a first part of 64 bytes and a second part, as HMAC needs.
static void sha256(const uint8_t first[64], const uint8_t *second, size_t size, uint8_t out[32]) {
  uint32_t hash[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  uint8_t last[128] = {0};
  const uint64_t num_bits = 8 * (64 + (uint64_t)size);
  sha256_block(hash, first);
  for (; size >= 64; size -= 64, second += 64) sha256_block(hash, second);
  memcpy(last, second, size);
  last[size] = 0x80;
  const size_t end = size < 56 ? 64 : 128;
  for (size_t i = 0; i < 8; ++i) last[end - 1 - i] = (uint8_t)(num_bits >> 8 * i);
  for (size_t at = 0; at < end; at += 64) sha256_block(hash, last + at);
  for (int i = 0; i < 32; ++i) out[i] = (uint8_t)(hash[i / 4] >> (24 - 8 * (i % 4)));
}

static void hmac(const uint8_t key[kKeyBytes], const uint8_t *bytes, size_t size, uint8_t out[32]) {
  uint8_t pad[64], inner[32];
  for (int i = 0; i < 64; ++i) pad[i] = (i < kKeyBytes ? key[i] : 0) ^ 0x36;
  sha256(pad, bytes, size, inner);
  for (int i = 0; i < 64; ++i) pad[i] ^= 0x36 ^ 0x5c;
  sha256(pad, inner, sizeof inner, out);
}

static bool is_sealed(const uint8_t key[kKeyBytes], const uint8_t *bytes, size_t size) {
  uint8_t code[32], differs = 0;
  hmac(key, bytes, size, code);
  for (int i = 0; i < kSealBytes; ++i) differs |= code[i] ^ bytes[size + (size_t)i];
  return differs == 0;
}

// ----- The hand -----

typedef struct {
  int64_t time_ns;  // The device's own clock, which increases with each measurement.
  double position_m[3 * kPoints], velocity_m_per_s[3 * kPoints];
  uint8_t held;  // One bit for each point; the lowest is the inner palm.
  bool enabled;  // The robot's own enabling switch.
  // The device fills in only what it measures, see `hand.channels`: forces on the hand from
  // force sensors, orientation of the end effector (unit quaternion w, x, y, z), and torque on
  // the hand there.
  double force_n[3 * kPoints], orientation_wxyz[4], torque_n_m[3], gripper_m;
  uint32_t buttons;
} Measurement;

typedef struct {
  uint32_t movement;
  bool strokes;
  double half_width_m, speed_m_per_s, height_m;
  int64_t num_strokes;
} Order;

static const double kHomeM[3] = {0.0, 0.0, 0.1};
static struct {
  int num_points;
  uint8_t channels;  // One bit each: force, orientation, torque, gripper, buttons.
  double dt_s;
  int64_t time_ns, num_strokes;
  // The spring pulls to `middle_m`, about which a stroke swings.
  double at_m[3], velocity_m_per_s[3], middle_m[3];
  double sine, cosine;  // Of the phase of a stroke.
  double force_n[3 * kPoints];
  // What a simulated participant feels, summed over ticks: force against the motion in N, the
  // same for the program's force alone, and speed in m/s. A robot leaves zeros.
  int64_t num_summed;
  double summed[3];
  bool is_home;
  Order order;
} hand;

// With a square root of our own, only libc has to be linked.
static double root(double square) {
  double guess = square > 1.0 ? square : 1.0;
  if (!(square > 0.0)) return 0.0;
  for (int i = 0; i < 1100; ++i) {
    const double better = 0.5 * (guess + square / guess);
    if (!(better < guess)) break;
    guess = better;
  }
  return guess;
}
static double length(const double v[3]) { return root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static void reset_hand(void) {  // Resets to the initial state for the next program.
  const double dt_s = hand.dt_s;
  const int num_points = hand.num_points;
  const uint8_t channels = hand.channels;
  memset(&hand, 0, sizeof hand);
  hand.channels = channels;
  hand.dt_s = dt_s;
  hand.num_points = num_points;
  hand.cosine = 1.0;
  hand.is_home = true;
  for (int i = 0; i < 3; ++i) hand.at_m[i] = hand.middle_m[i] = kHomeM[i];
}

static void order_hand(const Order *order) {
  if (order->movement <= hand.order.movement && order->movement != 0) return;
  hand.order = *order;
  hand.sine = 0.0;
  hand.cosine = 1.0;
  hand.num_strokes = 0;
  hand.is_home = false;
  memcpy(hand.middle_m, hand.at_m, sizeof hand.middle_m);
}

static void move_hand(void) {  // Simulates one tick, however late the real one is.
  const double mass_kg = 1.0, stiffness_n_per_m = 400.0, damping_n_s_per_m = 35.0;
  const double device_damping_n_s_per_m = 4.83;  // Felt in addition to the program's force.
  const Order *order = &hand.order;
  const bool strokes =
      order->strokes && (order->num_strokes == 0 || hand.num_strokes < order->num_strokes);
  const double goal_m[3] = {0.0, 0.0, strokes ? order->height_m : kHomeM[2]};
  double way_m[3], wanted_m[3];
  for (int i = 0; i < 3; ++i) way_m[i] = goal_m[i] - hand.middle_m[i];
  const double far_m = length(way_m), step_m = 0.5 * hand.dt_s;
  for (int i = 0; i < 3; ++i) {
    hand.middle_m[i] += far_m > step_m ? way_m[i] * step_m / far_m : way_m[i];
    wanted_m[i] = hand.middle_m[i];
  }
  if (strokes && far_m <= step_m) {
    const double turn_rad = order->speed_m_per_s / order->half_width_m * hand.dt_s;
    const double last = hand.sine;
    hand.sine += turn_rad * hand.cosine;
    hand.cosine -= turn_rad * hand.sine;
    if (last < 0.0 && hand.sine >= 0.0) ++hand.num_strokes;  // There and back.
    wanted_m[0] += order->half_width_m * hand.sine;
  }
  double from_home_m[3], total_n[3] = {0}, power_w = 0.0;
  const double speed_m_per_s = length(hand.velocity_m_per_s);
  for (int i = 0; i < 3 * kPoints; ++i) {
    total_n[i % 3] += hand.force_n[i];
    power_w += hand.force_n[i] * hand.velocity_m_per_s[i % 3];
  }
  if (speed_m_per_s > 0.0) {
    ++hand.num_summed;
    hand.summed[0] += device_damping_n_s_per_m * speed_m_per_s - power_w / speed_m_per_s;
    hand.summed[1] -= power_w / speed_m_per_s;
    hand.summed[2] += speed_m_per_s;
  }
  for (int i = 0; i < 3; ++i) {
    const double force_n =
        stiffness_n_per_m * (wanted_m[i] - hand.at_m[i]) + total_n[i] -
        (damping_n_s_per_m + device_damping_n_s_per_m) * hand.velocity_m_per_s[i];
    hand.velocity_m_per_s[i] += force_n / mass_kg * hand.dt_s;
    hand.at_m[i] += hand.velocity_m_per_s[i] * hand.dt_s;
    from_home_m[i] = hand.at_m[i] - kHomeM[i];
  }
  hand.is_home = hand.is_home || (!strokes && length(from_home_m) < 0.01);
  hand.time_ns += (int64_t)(1e9 * hand.dt_s + 0.5);
}

// ===== Put your robot here: begin ==============================================================

// Measures. Returns false on failure.
static bool read_robot(Measurement *measured) {
  static const double offset_m[3 * kPoints] = {0, 0, 0, 0.02, 0, 0, -0.03, 0.05, 0, 0, 0.08, 0,
                                               0.02, 0.09, 0};
  move_hand();
  measured->time_ns = hand.time_ns;
  for (int i = 0; i < 3 * kPoints; ++i) {
    measured->position_m[i] = hand.at_m[i % 3] + offset_m[i];
    measured->velocity_m_per_s[i] = hand.velocity_m_per_s[i % 3];
  }
  measured->held = (uint8_t)((1 << hand.num_points) - 1);
  measured->enabled = true;
  if (hand.channels == 0) return true;
  // An invented value that depends on where the hand is.
  const double half_turn = 0.5 * hand.at_m[0];
  memcpy(measured->force_n, hand.force_n, sizeof measured->force_n);
  measured->orientation_wxyz[0] = root(1.0 - half_turn * half_turn);
  measured->orientation_wxyz[3] = half_turn;
  measured->torque_n_m[2] = 0.01 * hand.at_m[0];
  measured->gripper_m = 0.05 + 0.01 * hand.at_m[1];
  measured->buttons = hand.at_m[0] > 0.0;
  return true;
}

// Gives these forces on the hand, N, until the next call. Returns false on failure, after the
// motors were freed of force in another way.
static bool write_robot(const double force_n[3 * kPoints]) {
  memcpy(hand.force_n, force_n, sizeof hand.force_n);
  return true;
}

// ===== Put your robot here: end ================================================================

// ----- How good the connection is -----

typedef struct {
  bool has_newest, lost_in_a_row, has_round_trip;
  uint32_t newest;
  int window, fewest, most_in_a_row, long_good;  // These depend on the sender's rate.
  int num_expected, num_came, num_good;
  bool came[kRing];  // Indexed by the number modulo the ring; false outside of the window.
  int64_t newest_echo_ns, peer_clock_ns;
  double round_trip_ns;
} Link;

static void mark(Link *link, uint32_t number, bool came) {
  link->num_came += came - link->came[number % kRing];
  link->came[number % kRing] = came;
}

static void judge_anew(Link *link) {  // Numbers that were seen stay known.
  memset(link->came, 0, sizeof link->came);
  link->num_came = link->num_good = 0;
  link->num_expected = 1;
  link->lost_in_a_row = link->has_round_trip = false;
  if (link->has_newest) mark(link, link->newest, true);
}

static void begin_link(Link *link, double rate_hz) {
  const double rate = rate_hz < 100.0 ? 100.0 : rate_hz > 16000.0 ? 16000.0 : rate_hz;
  link->window = (int)(0.512 * rate + 0.5);
  link->fewest = (int)(0.050 * rate + 0.5);
  link->most_in_a_row = (int)(0.020 * rate + 0.5);
  link->long_good = (int)(0.100 * rate + 0.5);
  judge_anew(link);
}

static int level_of(const Link *link) {
  static const int kMissing[] = {1, 10, 51};
  static const double kTripNs[] = {4e6, 8e6, 16e6};
  if (link->num_came < link->fewest) return 0;
  for (int i = link->has_round_trip ? 0 : 2; i < 3; ++i) {
    const int most = kMissing[i] * link->window / 512;
    if (link->num_expected - link->num_came <= (most > 1 ? most : 1) &&
        (!link->has_round_trip || link->round_trip_ns <= kTripNs[i])) {
      return 3 - i;
    }
  }
  return 0;
}

// Returns false if this number came before and does not count.
static bool take_number(Link *link, uint32_t number, int64_t clock_ns, int64_t echo_ns,
                        int64_t now_ns) {
  if (!link->has_newest) {
    link->has_newest = true;
    link->newest = number - 1;
    link->num_expected = 0;
  }
  const uint32_t ahead = number - link->newest;  // It wraps as intended.
  if (ahead - 1 < 0x7fffffffu) {
    const int window = link->window;
    const int shift = ahead < (uint32_t)window ? (int)ahead : window;
    for (int i = 1; i <= shift; ++i) {
      mark(link, link->newest + (uint32_t)i - (uint32_t)window, false);
    }
    link->num_expected =
        link->num_expected + shift < window ? link->num_expected + shift : window;
    if (ahead > (uint32_t)link->most_in_a_row) link->lost_in_a_row = true;
    link->newest = number;
    link->peer_clock_ns = clock_ns;
    if (link->newest_echo_ns < echo_ns && echo_ns <= now_ns) {
      const double trip_ns = (double)(now_ns - echo_ns);
      if (!link->has_round_trip) link->round_trip_ns = trip_ns;
      link->has_round_trip = true;
      link->round_trip_ns += (trip_ns - link->round_trip_ns) / 16.0;
      link->newest_echo_ns = echo_ns;
    }
  } else if (0u - ahead >= (uint32_t)link->num_expected || link->came[number % kRing]) {
    return false;
  }
  mark(link, number, true);
  link->num_good = level_of(link) >= 2 ? link->num_good + 1 : 0;
  return true;
}

// ----- The device as the program sees it -----

static struct {
  // The log is -1, or a file to which each tick writes what the robot is given.
  int socket, log;
  double rate_hz;
  bool has_key;
  uint8_t key[kKeyBytes], to_device[kKeyBytes], to_program[kKeyBytes];
  int64_t patience_ns, answer_age_ns, last_tick_ns;
  uint64_t challenge;
  int num_answers;  // In this tick.
  bool is_measured, was_enabled;
  Measurement measured;
  double acted_n[3 * kPoints];  // The last command to the motors.
  long num_ticks, num_missed, num_clients, num_armings;
} device;

static struct {  // The one connected program. Nothing of it carries over to the next one.
  bool is_there;
  struct sockaddr_in address;
  uint64_t token, stream;
  int64_t last_heard_ns, came_at_ns;
  Link link;
  uint32_t number;  // Number of the last datagram to it.
  struct {
    uint32_t number;
    int64_t at_ns;
  } sent[kRing];  // The last states.
  bool has_command, is_recent, armed;
  uint32_t command_number, arm_number, answers, armed_number, order_number;
  double force_n[3 * kPoints];
  uint8_t fault;
} client;

static int64_t now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

static uint64_t drawn(void) {
  uint64_t number = 0;
  const int file = open("/dev/urandom", O_RDONLY);
  if (file < 0 || read(file, &number, sizeof number) != (ssize_t)sizeof number) {
    fputs("c_device: expected random numbers of the system, found none\n", stderr);
    exit(3);
  }
  close(file);
  return number | 1;
}

static void disarm(int fault) {
  if (client.armed) client.fault = (uint8_t)fault;
  client.armed = false;
}

static bool is_without_force(void) {
  for (int i = 0; i < 3 * kPoints; ++i) {
    if (client.force_n[i] != 0.0) return false;
  }
  return true;
}

// Adds header, checksum and seal to a content that begins at offset 40.
static void finish_and_send(uint8_t *bytes, int kind, uint64_t stream, uint32_t number,
                            int64_t echo_ns, const uint8_t *key, const struct sockaddr_in *to) {
  size_t size = kSize[kind];
  memcpy(bytes, "JDLK", 4);
  put(bytes + 4, kVersion, 2);
  put(bytes + 6, (uint64_t)kind, 2);
  put(bytes + 8, stream, 8);
  put(bytes + 16, number, 4);
  put(bytes + 20, size, 4);
  put(bytes + 24, (uint64_t)now(), 8);
  put(bytes + 32, (uint64_t)echo_ns, 8);
  put(bytes + size - 4, crc32(bytes, size - 4), 4);
  if (key != NULL) {
    uint8_t code[32];
    hmac(key, bytes, size, code);
    memcpy(bytes + size, code, kSealBytes);
    size += kSealBytes;
  }
  // A datagram that the system does not take counts as lost on the way.
  (void)sendto(device.socket, bytes, size, 0, (const struct sockaddr *)to, sizeof *to);
}

static void refuse(int reason, uint64_t token, uint64_t stream, bool sealed,
                   const struct sockaddr_in *to) {
  uint8_t bytes[kMostBytes] = {0};
  if (++device.num_answers > kMostAnswers) return;
  put(bytes + 40, token, 8);
  put(bytes + 48, (uint64_t)reason, 1);
  finish_and_send(bytes, kRefusal, stream, 0, 0, sealed && device.has_key ? device.key : NULL, to);
}

static void end_connection(void) {
  memset(&client, 0, sizeof client);
  if (kRobot.simulated) reset_hand();
}

static bool is_client(const struct sockaddr_in *from) {
  return client.is_there && from->sin_port == client.address.sin_port &&
         from->sin_addr.s_addr == client.address.sin_addr.s_addr;
}

static void begin_stream(uint64_t token, double rate_hz, const struct sockaddr_in *from,
                         int64_t now_ns) {
  if (client.is_there && kRobot.simulated) {
    // The program said hello again, so the hand continues from where it is.
    const Order home = {0};
    order_hand(&home);
  }
  memset(&client, 0, sizeof client);
  client.is_there = true;
  client.address = *from;
  client.token = token;
  client.stream = drawn();
  client.last_heard_ns = now_ns;
  begin_link(&client.link, rate_hz);
  device.challenge = drawn();
  ++device.num_clients;
  const char *const direction[] = {"to device", "to program"};
  for (int i = 0; i < 2; ++i) {
    uint8_t words[32];
    const size_t end = strlen(direction[i]);
    memcpy(words, direction[i], end);
    put(words + end, token, 8);
    put(words + end + 8, client.stream, 8);
    hmac(device.key, words, end + 16, i == 0 ? device.to_device : device.to_program);
  }
}

static void answer_hello(const uint8_t *bytes, const struct sockaddr_in *from, int64_t now_ns) {
  const uint64_t token = get(bytes + 40, 8), challenge = get(bytes + 49, 8);
  const bool only_asks = bytes[48] != 0;
  uint64_t stream = 0;
  if (client.is_there && !is_client(from) && !only_asks) {
    // It must not be valid later.
    if (challenge == device.challenge) device.challenge = drawn();
    refuse(kBusy, token, 0, true, from);
    return;
  }
  if (!only_asks && is_client(from) && token == client.token) {
    stream = client.stream;  // The welcome was lost.
  } else if (!only_asks && challenge == device.challenge) {
    begin_stream(token, get_f64(bytes + 57), from, now_ns);
    stream = client.stream;
    device.num_answers = 0;
  }
  if (++device.num_answers > kMostAnswers) return;
  uint8_t welcome[kMostBytes] = {0};
  put(welcome + 40, token, 8);
  put_f64(welcome + 48, device.rate_hz);
  put_f64(welcome + 56, kRobot.most_force_n);
  put_f64(welcome + 64, kRobot.most_total_force_n);
  put_f64(welcome + 72, 1e-9 * (double)device.patience_ns);
  put(welcome + 80, (1u << hand.num_points) - 1, 4);
  welcome[88] = kRobot.simulated;
  welcome[89] = kRobot.moves_by_itself;
  put_text(welcome + 90, kRobot.name);
  put(welcome + 122, device.challenge, 8);
  double shares[kPoints], sum = 0.0;
  for (int i = 0; i < hand.num_points; ++i) {
    shares[i] = kRobot.share_ratio[0] > 0.0 ? kRobot.share_ratio[i] : kAreaShareRatio[i];
    sum += shares[i];
  }
  for (int i = 0; i < hand.num_points; ++i) put_f64(welcome + 130 + 8 * i, shares[i] / sum);
  put_f64(welcome + 170, kSlewNPerS);
  put_f64(welcome + 178, kMostSpeedMPerS);
  put_f64s(welcome + 186, kRobot.half_width_m, 3);
  put_f64(welcome + 210, kRobot.own_mass_kg);
  put_f64(welcome + 218, kRobot.own_damping_n_s_per_m);
  put_f64(welcome + 226, kRobot.loop_delay_s);
  welcome[234] = hand.channels;
  put_text(welcome + 236, kRobot.serial);
  put_text(welcome + 268, kRobot.firmware);
  finish_and_send(welcome, kWelcome, stream, 0, (int64_t)get(bytes + 24, 8),
                  device.has_key ? device.key : NULL, from);
}

static void take_command(const uint8_t *bytes, uint32_t number, int64_t now_ns) {
  if (client.has_command && number - client.command_number - 1 >= 0x7fffffffu) return;
  client.has_command = client.is_recent = true;
  client.command_number = number;
  client.came_at_ns = now_ns;
  client.arm_number = (uint32_t)get(bytes + 40, 4);
  client.answers = (uint32_t)get(bytes + 44, 4);
  for (int i = 0; i < 3 * kPoints; ++i) client.force_n[i] = get_f64(bytes + 48 + 8 * i);
}

static void take_order(const uint8_t *bytes) {
  const uint32_t number = (uint32_t)get(bytes + 40, 4);
  if (!kRobot.moves_by_itself || number <= client.order_number) return;
  client.order_number = number;
  const Order order = {(uint32_t)get(bytes + 44, 4), bytes[52] != 0,
                       get_f64(bytes + 53),          get_f64(bytes + 61),
                       get_f64(bytes + 69),          (int64_t)get(bytes + 117, 8)};
  if (order.movement != 0) order_hand(&order);
}

// Whether the doubles from here on are finite and within a range.
static bool within(const uint8_t *bytes, int num, double least, double most) {
  for (int i = 0; i < num; ++i) {
    const double value = get_f64(bytes + 8 * i);
    if (!isfinite(value) || value < least || value > most) return false;
  }
  return true;
}

static bool is_in_range(int kind, const uint8_t *bytes) {
  if (kind == kHello) return bytes[48] <= 1 && within(bytes + 57, 1, 1e-9, INFINITY);
  if (kind == kCommand) return within(bytes + 48, 15, -INFINITY, INFINITY);
  if (kind != kOrder) return kind == kHalt || kind == kGoodbye;
  return bytes[52] <= 1 && within(bytes + 53, 1, 0.001, 2) && within(bytes + 61, 1, 0.001, 5) &&
         within(bytes + 69, 1, -5, 5) && within(bytes + 77, 1, -1, 1) &&
         within(bytes + 85, 2, 0, 0.3) && within(bytes + 101, 2, 0, 0.5) &&
         get(bytes + 117, 8) <= 1000000;
}

static void take_datagram(const uint8_t *bytes, size_t received, const struct sockaddr_in *from,
                          int64_t now_ns) {
  if (received < kHeaderBytes + 4 || memcmp(bytes, "JDLK", 4) != 0) return;
  const int kind = (int)get(bytes + 6, 2);
  if (get(bytes + 4, 2) != kVersion) {  // It is told so, and nothing else happens.
    if (kind == kHello && received >= 48) refuse(kOtherVersion, get(bytes + 40, 8), 0, false, from);
    return;
  }
  if (kind < kHello || kind > kGoodbye) return;
  const size_t size = kSize[kind], seal = device.has_key ? kSealBytes : 0;
  if (get(bytes + 20, 4) != size || received < size ||
      get(bytes + size - 4, 4) != crc32(bytes, size - 4) || !is_in_range(kind, bytes)) {
    return;
  }
  const uint64_t stream = get(bytes + 8, 8);
  const bool is_of_stream = is_client(from) && stream == client.stream;
  if (kind == kHello) {
    if (received != size + seal || (device.has_key && !is_sealed(device.key, bytes, size))) {
      refuse(kOtherKey, get(bytes + 40, 8), 0, false, from);
    } else {
      answer_hello(bytes, from, now_ns);
    }
    return;
  }
  if (received != size + seal) return;
  if (!is_of_stream) {
    if (kind == kCommand && !device.has_key) refuse(kUnknownStream, 0, stream, false, from);
    return;
  }
  if (device.has_key && !is_sealed(device.to_device, bytes, size)) return;
  const uint32_t number = (uint32_t)get(bytes + 16, 4);
  if (!take_number(&client.link, number, (int64_t)get(bytes + 24, 8), (int64_t)get(bytes + 32, 8),
                   now_ns)) {
    return;
  }
  client.last_heard_ns = now_ns;
  if (kind == kCommand) take_command(bytes, number, now_ns);
  if (kind == kOrder) take_order(bytes);
  if (kind == kHalt) disarm(kFaultWatchdog);
  if (kind == kGoodbye) end_connection();
}

static void receive(int64_t now_ns) {
  device.num_answers = 0;
  for (int i = 0; i < kMostTaken; ++i) {
    uint8_t bytes[2048];
    struct sockaddr_in from;
    socklen_t from_size = sizeof from;
    const ssize_t received = recvfrom(device.socket, bytes, sizeof bytes, 0,
                                      (struct sockaddr *)&from, &from_size);
    if (received < 0) {
      if (errno == EAGAIN || errno == EWOULDBLOCK) return;
      continue;  // The program is gone. Its silence ends the connection.
    }
    take_datagram(bytes, (size_t)received, &from, now_ns);
  }
}

// Returns how long ago the state was sent to which the command responds, or a very long time if
// we do not know it.
static int64_t answer_age_ns(int64_t now_ns) {
  const int place = (int)(client.answers % kRing);
  if (client.answers != client.sent[place].number || client.sent[place].at_ns == 0) {
    return INT64_MAX;
  }
  return now_ns - client.sent[place].at_ns;
}

static void arm_or_disarm(int64_t now_ns) {
  if (client.is_recent && client.arm_number != client.armed_number) {
    client.armed = false;
    if (client.link.lost_in_a_row) judge_anew(&client.link);
    if (client.arm_number != 0 && is_without_force() &&
        client.link.num_good >= client.link.long_good && client.link.has_round_trip &&
        answer_age_ns(now_ns) < device.answer_age_ns && device.is_measured) {
      client.armed = true;
      client.armed_number = client.arm_number;
      client.fault = 0;
      memset(device.acted_n, 0, sizeof device.acted_n);
      ++device.num_armings;
    }
  }
  if (client.armed &&
      (now_ns - client.came_at_ns >= device.patience_ns ||
       answer_age_ns(now_ns) >= device.answer_age_ns || client.link.lost_in_a_row ||
       level_of(&client.link) == 0)) {
    disarm(kFaultLink);
  }
}

static void measure(void) {
  Measurement measured = {0};
  device.is_measured = read_robot(&measured);
  int fault = kFaultRead;
  for (int i = 0; device.is_measured && i < 3 * kPoints; ++i) {
    if (isfinite(measured.position_m[i]) && isfinite(measured.velocity_m_per_s[i])) continue;
    device.is_measured = false;
    fault = kFaultState;
  }
  if (device.is_measured) {
    device.measured = measured;
  } else {
    disarm(fault);
    client.fault = (uint8_t)fault;
  }
}

// Turns the commanded force into what the hand gets, after every limit.
static void limit(double force_n[3 * kPoints]) {
  const Measurement *at = &device.measured;
  for (int point = 0; point < kPoints; ++point) {
    const double *velocity_m_per_s = at->velocity_m_per_s + 3 * point;
    if ((at->held >> point & 1) != 0 && length(velocity_m_per_s) > kMostSpeedMPerS) {
      disarm(kFaultSpeed);
      return;
    }
  }
  if (is_without_force()) return;  // Zero force takes effect at once, without the slew.
  double total_n = 0.0;
  for (int point = 0; point < kPoints; ++point) {
    if ((at->held >> point & 1) == 0) continue;
    double *force = force_n + 3 * point;
    memcpy(force, client.force_n + 3 * point, 3 * sizeof *force);
    const double size_n = length(force);
    if (!isfinite(size_n)) {
      disarm(kFaultForce);
      memset(force_n, 0, 3 * kPoints * sizeof *force_n);
      return;
    }
    const double scale = size_n > kRobot.most_force_n ? kRobot.most_force_n / size_n : 1.0;
    for (int i = 0; i < 3; ++i) force[i] *= scale;
    total_n += scale * size_n;
  }
  const double scale =
      total_n > kRobot.most_total_force_n ? kRobot.most_total_force_n / total_n : 1.0;
  const double most_change_n = kSlewNPerS / device.rate_hz;
  for (int point = 0; point < kPoints; ++point) {
    if ((at->held >> point & 1) == 0) continue;
    double *force = force_n + 3 * point, change_n[3];
    const double *last_n = device.acted_n + 3 * point;
    for (int i = 0; i < 3; ++i) change_n[i] = scale * force[i] - last_n[i];
    const double size_n = length(change_n);
    const double part = size_n > most_change_n ? most_change_n / size_n : 1.0;
    for (int i = 0; i < 3; ++i) force[i] = last_n[i] + part * change_n[i];
  }
}

static void send_state(const double acted_n[3 * kPoints]) {
  uint8_t state[kMostBytes] = {0};
  const Measurement *at = &device.measured;
  put(state + 40, (uint64_t)at->time_ns, 8);
  put_f64s(state + 48, at->position_m, 15);
  put_f64s(state + 168, at->velocity_m_per_s, 15);
  put_f64s(state + 288, at->position_m, 3);
  // Without joints, there are zeros from 312 on.
  put(state + 664, (uint64_t)hand.num_summed, 8);
  put_f64s(state + 672, hand.summed, 3);
  put(state + 696, (uint64_t)hand.num_strokes, 8);
  put(state + 704, client.armed_number, 4);
  put(state + 708, client.order_number, 4);
  state[712] = at->held;
  state[713] = client.armed;
  state[714] = device.is_measured;
  state[715] = hand.is_home;
  state[716] = client.fault;
  state[717] = (uint8_t)level_of(&client.link);
  put_f64s(state + 718, acted_n, 15);
  state[838] = at->enabled;
  put_f64s(state + 839, at->force_n, 15);
  put_f64s(state + 959, at->orientation_wxyz, 4);
  put_f64s(state + 991, at->torque_n_m, 3);
  put_f64(state + 1015, at->gripper_m);
  put(state + 1023, at->buttons, 4);
  ++client.number;
  client.sent[client.number % kRing].number = client.number;
  client.sent[client.number % kRing].at_ns = now();
  finish_and_send(state, kState, client.stream, client.number, client.link.peer_clock_ns,
                  device.has_key ? device.to_program : NULL, &client.address);
}

static void give(const double force_n[3 * kPoints]) {
  memcpy(device.acted_n, force_n, sizeof device.acted_n);
  if (!write_robot(force_n)) {
    disarm(kFaultWrite);
    memset(device.acted_n, 0, sizeof device.acted_n);
  }
  if (device.log < 0) return;
  uint8_t record[8 + 8 * 3 * kPoints];
  put(record, (uint64_t)now(), 8);
  put_f64s(record + 8, device.acted_n, 3 * kPoints);
  // Each record is written at once, so that a killed program has told everything.
  if (write(device.log, record, sizeof record) < 0) device.log = -1;
}

static void tick(void) {
  const int64_t now_ns = now();
  double acted_n[3 * kPoints], force_n[3 * kPoints] = {0};
  ++device.num_ticks;
  receive(now_ns);
  if (now_ns - device.last_tick_ns >= device.patience_ns) {
    disarm(kFaultWatchdog);  // The age of what waited is unknown.
    client.is_recent = false;
  }
  device.last_tick_ns = now_ns;
  if (client.is_there && now_ns - client.last_heard_ns >= 1000000000) end_connection();
  if (client.is_there) arm_or_disarm(now_ns);
  measure();
  memcpy(acted_n, device.acted_n, sizeof acted_n);  // Until this measurement.
  const bool enabled = device.measured.enabled;
  if (device.was_enabled != enabled && (!enabled || !is_without_force())) disarm(kFaultNotEnabled);
  device.was_enabled = enabled;
  if (client.armed && enabled) limit(force_n);
  give(force_n);
  if (client.is_there) send_state(acted_n);
}

// ----- Begin and end -----

static volatile sig_atomic_t is_stopped;
static void stop(int number) {
  (void)number;
  is_stopped = 1;
}

static void fail(const char *what, const char *why) {
  fprintf(stderr, "c_device: %s: %s\n", what, why);
  exit(2);
}

static void read_key(const char *path) {
  struct stat status;
  char digits[2 * kKeyBytes + 1] = "";
  FILE *file = fopen(path, "r");
  if (file == NULL || fstat(fileno(file), &status) != 0) fail(path, strerror(errno));
  if ((status.st_mode & 077) != 0) fail(path, "others may read this key; chmod 600 it");
  if (fread(digits, 1, 2 * kKeyBytes, file) != 2 * kKeyBytes ||
      strspn(digits, "0123456789abcdefABCDEF") != 2 * kKeyBytes) {
    fail(path, "expected 64 hexadecimal digits, as `jnd device-key` writes");
  }
  fclose(file);
  for (int i = 0; i < kKeyBytes; ++i) {
    const char pair[3] = {digits[2 * i], digits[2 * i + 1], '\0'};
    device.key[i] = (uint8_t)strtoul(pair, NULL, 16);
  }
  device.has_key = true;
}

int main(int num_words, char **words) {
  const char *host = "127.0.0.1";
  double port = 4700, seconds = 1e9, num_points = kPoints, channels = 0;
  device.rate_hz = 1000.0;
  device.log = -1;
  for (int i = 1; i < num_words; i += 2) {
    const char *word = words[i], *value = i + 1 < num_words ? words[i + 1] : NULL;
    char *end = NULL;
    double *number = strcmp(word, "--port") == 0       ? &port
                     : strcmp(word, "--seconds") == 0  ? &seconds
                     : strcmp(word, "--points") == 0   ? &num_points
                     : strcmp(word, "--channels") == 0 ? &channels
                     : strcmp(word, "--rate-hz") == 0  ? &device.rate_hz
                                                       : NULL;
    if (value != NULL && strcmp(word, "--listen") == 0) {
      host = value;
    } else if (value != NULL && strcmp(word, "--key") == 0) {
      read_key(value);
    } else if (value != NULL && strcmp(word, "--log") == 0) {
      device.log = open(value, O_WRONLY | O_CREAT | O_APPEND, 0600);
      if (device.log < 0) fail(value, strerror(errno));
    } else if (value == NULL || number == NULL || (*number = strtod(value, &end), *end != '\0')) {
      fail(word, "expected --listen ADDRESS, --port N (0: any that is free), --key FILE, "
                 "--rate-hz N, --points 1 to 5, --channels 0 to 31, --log FILE or --seconds N");
    }
  }
  if (!(device.rate_hz > 250.0 && device.rate_hz <= 10000.0)) {
    fail("--rate-hz", "expected more than 250, at most 10000");
  }
  if (!(num_points >= 1 && num_points <= kPoints)) fail("--points", "expected 1 to 5");
  if (!(port >= 0 && port <= 65535)) fail("--port", "expected 0 to 65535");
  if (!(channels >= 0 && channels <= 31)) fail("--channels", "expected 0 to 31");
  hand.num_points = (int)num_points;
  hand.channels = (uint8_t)channels;
  hand.dt_s = 1.0 / device.rate_hz;
  reset_hand();
  // A simulation may take longer.
  device.patience_ns = kRobot.simulated ? 100000000 : 20000000;
  device.answer_age_ns = device.patience_ns + 20000000;
  device.challenge = drawn();

  struct sockaddr_in own = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
  socklen_t own_size = sizeof own;
  if (inet_pton(AF_INET, host, &own.sin_addr) != 1) fail(host, "expected an IPv4 address");
  if (!device.has_key && ntohl(own.sin_addr.s_addr) >> 24 != 127) {
    fail(host, "others can reach it: name a key of `jnd device-key`");
  }
  device.socket = socket(AF_INET, SOCK_DGRAM, 0);
  if (device.socket < 0 || fcntl(device.socket, F_SETFL, O_NONBLOCK) != 0 ||
      bind(device.socket, (struct sockaddr *)&own, sizeof own) != 0 ||
      getsockname(device.socket, (struct sockaddr *)&own, &own_size) != 0) {
    fail(host, errno == EADDRINUSE
                   ? "the port is used already; end what uses it, or name another --port"
                   : strerror(errno));
  }
  printf("listening on %s:%d\n", host, ntohs(own.sin_port));
  fflush(stdout);
  signal(SIGTERM, stop);
  signal(SIGINT, stop);

  // Goes before other programs of a busy machine, if the system allows it.
  (void)sched_setscheduler(0, SCHED_FIFO, &(struct sched_param){.sched_priority = 50});
  (void)mlockall(MCL_CURRENT | MCL_FUTURE);

  const int64_t period_ns = (int64_t)(1e9 / device.rate_hz + 0.5), begin_ns = now();
  int64_t next_ns = begin_ns;
  device.last_tick_ns = begin_ns;
  while (!is_stopped && (double)(now() - begin_ns) < 1e9 * seconds) {
    tick();
    next_ns += period_ns;
    const int64_t late_ns = now() - next_ns;
    if (late_ns > 0) {  // Missed ticks that cannot be made up for are left out.
      device.num_missed += (long)(late_ns / period_ns);
      next_ns += late_ns / period_ns * period_ns;
    } else {
      const struct timespec until = {.tv_sec = (time_t)(next_ns / 1000000000),
                                     .tv_nsec = (long)(next_ns % 1000000000)};
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL);
    }
  }
  const double none_n[3 * kPoints] = {0};
  give(none_n);
  if (client.is_there) {
    uint8_t goodbye[kMostBytes] = {0};
    finish_and_send(goodbye, kGoodbye, client.stream, ++client.number, client.link.peer_clock_ns,
                    device.has_key ? device.to_program : NULL, &client.address);
  }
  printf("%ld ticks in %.1f s, %ld missed; %ld programs connected, %ld armings\n", device.num_ticks,
         1e-9 * (double)(now() - begin_ns), device.num_missed, device.num_clients,
         device.num_armings);
  return 0;
}
