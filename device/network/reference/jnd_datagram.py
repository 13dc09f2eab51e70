# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The jnd authors. It may be used, copied, changed and sold by anybody for
# anything, without any warranty, as long as this notice stays in it.
"""The datagrams of jnd, version 3: bytes to values and back, seals, and how good a connection is.

Python 3.8 or later, standard library alone. The tables of device/network/README.md, SI units.
"""

import hashlib
import hmac
import ipaddress
import math
import os
import socket
import struct
import zlib

VERSION = 3
HELLO, WELCOME, REFUSAL, STATE, COMMAND, ORDER, HALT, GOODBYE = range(1, 9)
BUSY, UNKNOWN_STREAM, OTHER_VERSION, OTHER_KEY = range(1, 5)
REFUSALS = {BUSY: "another program is connected", UNKNOWN_STREAM: "the stream is unknown",
            OTHER_VERSION: "it speaks another version", OTHER_KEY: "it has another key"}
FAULTS = {0: "none", 1: "emergency_stop", 2: "non_finite_state", 3: "non_finite_force",
          4: "device_read_failed", 5: "device_write_failed", 6: "stale_sample",
          7: "position_jump", 8: "over_velocity", 9: "heartbeat_lost", 10: "outside_workspace",
          11: "watchdog", 12: "link_lost", 13: "simulation_invalid", 14: "not_armed",
          15: "suspended", 16: "host_too_slow", 17: "energy_given", 18: "force_oscillates",
          19: "velocity_contradicts", 20: "acting_force_unknown", 21: "not_enabled",
          22: "position_frozen"}
NUM_POINTS = 5
# Bits of what a device measures besides.
MEASURED_FORCE, ORIENTATION, TORQUE, GRIPPER, BUTTONS = 1, 2, 4, 8, 16
# By the areas of a hand; of a device with fewer points, over the sum of those it has.
AREA_SHARE_RATIO = (0.35, 0.35, 0.10, 0.10, 0.10)
SEAL_BYTES = 16

_HEADER = struct.Struct("<4sHHQIIqq")
# Each name with how many values it holds; the letters are those of Python's `struct`.
_FIELDS = {
    HELLO: "token:Q only_asks:B challenge:Q rate_hz:d",
    WELCOME: "token:Q rate_hz:d most_force_n:d most_total_force_n:d stand_in_s:d points:I "
             "num_joints:I simulated:B moves_by_itself:B name:32s challenge:Q share_ratio:5d "
             "most_slew_n_per_s:d most_speed_m_per_s:d half_width_m:3d own_mass_kg:d "
             "own_damping_n_s_per_m:d loop_delay_s:d channels:B has_switch:B serial:32s "
             "firmware:32s",
    REFUSAL: "token:Q reason:B",
    STATE: "time_ns:q position_m:15d velocity_m_per_s:15d end_effector_m:3d joint_rad:22d "
           "joint_torque_n_m:22d num_summed:q opposing_n:d rendered_opposing_n:d "
           "speed_m_per_s:d num_strokes:q armed_number:I order_number:I held:B armed:B "
           "measured:B home:B fault:B level:B acted_n:15d enabled:B "
           "measured_force_n:15d orientation_wxyz:4d torque_n_m:3d gripper_m:d buttons:I",
    COMMAND: "arm_number:I state_number:I force_n:15d",
    ORDER: "order_number:I movement:I num_put_back:I strokes:B half_width_m:d speed_m_per_s:d "
           "height_m:d lift_m:d width_spread:d speed_spread:d height_spread_m:d "
           "sideways_spread_m:d num_strokes:q random_state:Q",
    HALT: "", GOODBYE: "",
}
# Least and most of what is not free.
_RANGES = {
    HELLO: {"only_asks": (0, 1), "rate_hz": (1e-9, math.inf)},
    WELCOME: {"rate_hz": (1e-9, math.inf), "most_force_n": (1e-9, math.inf),
              "most_total_force_n": (1e-9, math.inf), "stand_in_s": (0, 0.1),
              "points": (1, 31), "simulated": (0, 1), "moves_by_itself": (0, 2),
              "most_slew_n_per_s": (0, math.inf), "most_speed_m_per_s": (0, math.inf),
              "own_mass_kg": (0, math.inf), "own_damping_n_s_per_m": (0, math.inf),
              "loop_delay_s": (0, math.inf), "channels": (0, 31), "has_switch": (0, 1)},
    REFUSAL: {"reason": (1, 4)},
    STATE: {"num_summed": (0, math.inf), "num_strokes": (0, math.inf), "held": (0, 31),
            "armed": (0, 1), "measured": (0, 1), "home": (0, 1),
            "fault": (0, 22), "level": (0, 3), "enabled": (0, 1)},
    COMMAND: {},
    ORDER: {"order_number": (1, 2**32 - 1), "strokes": (0, 1), "half_width_m": (0.001, 2),
            "speed_m_per_s": (0.001, 5), "height_m": (-5, 5), "lift_m": (-1, 1),
            "width_spread": (0, 0.3), "speed_spread": (0, 0.3), "height_spread_m": (0, 0.5),
            "sideways_spread_m": (0, 0.5), "num_strokes": (0, 1000000)},
    HALT: {}, GOODBYE: {},
}


def _compiled(words):
    """The layout of a content, and which of its values belong to which name."""
    layout, places, first = "<", [], 0
    for word in words.split():
        name, letters = word.split(":")
        count = int(letters[:-1] or 1) if letters[-1] != "s" else 1
        layout += letters
        places.append((name, first, count))
        first += count
    return struct.Struct(layout), places


_CONTENT = {kind: _compiled(words) for kind, words in _FIELDS.items()}


class Datagram:
    """One that was received: header and content by name, groups of numbers as tuples."""

    def __init__(self, header):
        (_, _, self.kind, self.stream, self.number, self.size, self.clock_ns,
         self.echo_ns) = header


def pack(kind, stream, number, clock_ns, echo_ns, key, **content):
    """The bytes to send; sealed where there is a key. Every name of the kind is to be there."""
    layout, places = _CONTENT[kind]
    values = []
    for name, _, count in places:
        if count == 1:
            values.append(content[name])
        else:
            values.extend(content[name])
    size = _HEADER.size + layout.size + 4
    data = _HEADER.pack(b"JDLK", VERSION, kind, stream, number & 0xFFFFFFFF, size, clock_ns,
                        echo_ns) + layout.pack(*values)
    data += struct.pack("<I", zlib.crc32(data))
    return data + seal(data, key) if key else data


def unpack(data, has_seal):
    """The datagram in these bytes, or none where anything is wrong; the seal is not looked at."""
    end = len(data) - (SEAL_BYTES if has_seal else 0)
    if end < _HEADER.size + 4:
        return None
    header = _HEADER.unpack_from(data)
    magic, version, kind, size = header[0], header[1], header[2], header[5]
    if magic != b"JDLK" or version != VERSION or kind not in _CONTENT or size != end:
        return None
    layout, places = _CONTENT[kind]
    if size != _HEADER.size + layout.size + 4:
        return None
    if struct.unpack_from("<I", data, end - 4)[0] != zlib.crc32(data[:end - 4]):
        return None
    values = layout.unpack_from(data, _HEADER.size)
    if not all(map(math.isfinite, (v for v in values if isinstance(v, float)))):
        return None
    found = Datagram(header)
    for name, first, count in places:
        setattr(found, name, values[first] if count == 1 else values[first:first + count])
    for name, (least, most) in _RANGES[kind].items():
        if not least <= getattr(found, name) <= most:
            return None
    return None if kind == WELCOME and not _is_sound_welcome(found) else found


def _is_sound_welcome(found):
    texts = (found.name, found.serial, found.firmware)
    are_texts = all(32 <= byte < 127 for text in texts for byte in text.rstrip(b"\0"))
    fit = all((share > 0) == bool(found.points >> i & 1) for i, share in
              enumerate(found.share_ratio))
    return (found.num_joints in (0, 22) and are_texts and fit and min(found.share_ratio) >= 0
            and abs(sum(found.share_ratio) - 1) <= 1e-3 and min(found.half_width_m) >= 0)


def area_shares(points):
    """Of a device with these points, a bit each."""
    there = [share if points >> i & 1 else 0.0 for i, share in enumerate(AREA_SHARE_RATIO)]
    return [share / sum(there) for share in there]


def seal(data, key):
    """The last 16 bytes of a sealed datagram."""
    return hmac.new(key, data, hashlib.sha256).digest()[:SEAL_BYTES]


def is_sealed(data, key):
    return hmac.compare_digest(data[-SEAL_BYTES:], seal(data[:-SEAL_BYTES], key))


def stream_keys(key, token, stream):
    """The keys of a stream: of what goes to the device, and of what goes to the program."""
    ids = struct.pack("<QQ", token, stream)
    return (hmac.new(key, b"to device" + ids, hashlib.sha256).digest(),
            hmac.new(key, b"to program" + ids, hashlib.sha256).digest())


def read_key(path):
    """The 32 bytes of a file that `jnd device-key` wrote; none without a path."""
    if not path:
        return None
    try:
        if os.name == "posix" and os.stat(path).st_mode & 0o077:
            raise SystemExit(f"{path}: others may read this key; chmod 600 it, or draw a new one")
        with open(path, encoding="ascii") as file:
            text = file.read().strip()
        key = bytes.fromhex(text)
    except OSError as error:
        raise SystemExit(f"{path}: {error.strerror}; draw it with `jnd device-key NAME`")
    except ValueError:
        text, key = "", b""
    if len(text) != 64 or len(key) != 32:
        raise SystemExit(f"{path}: expected 64 hexadecimal digits, as `jnd device-key` writes")
    return key


def opened_socket(host, port, key):
    """A bound socket that does not wait. An address that others reach needs a key."""
    if not key and not ipaddress.ip_address(socket.gethostbyname(host)).is_loopback:
        raise SystemExit(f"{host} can be reached by others: name a key of `jnd device-key`")
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        opened.bind((host, port))
    except OSError as error:
        raise SystemExit(f"{host}:{port}: expected an address and a port that are free here, found: "
                         f"{error.strerror}; end what uses it, or name another one")
    opened.setblocking(False)
    return opened


class Link:
    """How good a connection is, by what came on a stream in one direction, of which so many
    datagrams are sent a second."""

    def __init__(self, rate_hz):
        rate_hz = min(max(rate_hz, 100.0), 16000.0)
        self._window, self._fewest = round(0.512 * rate_hz), round(0.05 * rate_hz)
        self._most_in_a_row, self._long_good = round(0.02 * rate_hz), round(0.1 * rate_hz)
        self._newest = None     # highest number that came
        self.peer_clock_ns = 0  # of the newest datagram, to be echoed
        self._newest_echo_ns = 0
        self.judge_anew()

    def judge_anew(self):
        """Forgets what was lost; numbers that were seen stay seen."""
        self._came = 1              # bit i: the number i below the newest came
        self._num_expected = 1      # so many numbers are judged, up to the window
        self.num_good = 0           # datagrams in a row that found the level good
        self.lost_in_a_row = False  # those of 20 ms at once
        self.round_trip_ns = None

    def take(self, number, clock_ns, echo_ns, now_ns):
        """Counts a datagram; False where its number came before: then it counts for nothing."""
        if self._newest is None:
            self._newest = number - 1 & 0xFFFFFFFF
            self._came = self._num_expected = 0
        ahead = (number - self._newest) & 0xFFFFFFFF
        if 0 < ahead < 1 << 31:
            shift = min(ahead, self._window)
            self._came = (self._came << shift | 1) & (1 << self._window) - 1
            self._num_expected = min(self._num_expected + shift, self._window)
            self.lost_in_a_row |= ahead > self._most_in_a_row
            self._newest, self.peer_clock_ns = number, clock_ns
            self._take_echo(echo_ns, now_ns)
        else:
            behind = -ahead & 0xFFFFFFFF
            if behind >= self._num_expected or self._came >> behind & 1:
                return False
            self._came |= 1 << behind
        self.num_good = self.num_good + 1 if self.level() >= 2 else 0
        return True

    def _take_echo(self, echo_ns, now_ns):
        if not self._newest_echo_ns < echo_ns <= now_ns:
            return
        self._newest_echo_ns = echo_ns
        trip_ns = now_ns - echo_ns
        last_ns = trip_ns if self.round_trip_ns is None else self.round_trip_ns
        self.round_trip_ns = last_ns + (trip_ns - last_ns) / 16

    def is_settled(self):
        """Good for 100 ms, by a round trip that was measured."""
        return self.num_good >= self._long_good and self.round_trip_ns is not None

    def num_missing(self):
        return self._num_expected - bin(self._came).count("1")

    def level(self):
        """3 excellent, 2 good, 1 poor, 0 unacceptable."""
        if bin(self._came).count("1") < self._fewest:
            return 0
        missing, trip_ns = self.num_missing(), self.round_trip_ns
        for level, most, most_ns in ((3, 1, 4e6), (2, 10, 8e6), (1, 51, 16e6)):
            most = max(1, most * self._window // 512)
            if missing <= most and (level == 1 if trip_ns is None else trip_ns <= most_ns):
                return level
        return 0


def take_real_time_priority():
    """Before other programs of a busy machine, where the system allows it; True if so."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(50))
        return True
    except (AttributeError, OSError):
        return False
