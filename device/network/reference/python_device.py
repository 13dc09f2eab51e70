#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The jnd authors. It may be used, copied, changed and sold by anybody for
# anything, without any warranty, as long as this notice stays in it.
"""A device that jnd uses as `--device network:HOST:PORT,simulated`: a template for an own robot.

    python3 python_device.py --port 4700

Behind it is a hand without a robot, a damped mass that strokes when a session orders it. Put an own
robot into `Robot.read_robot` and `Robot.write_robot`, and into nothing else. Not tried on hardware.
Python has no real-time guarantee: a robot that can hurt somebody needs a watchdog of its own below
this program, and limits of force of its own.
"""

import argparse
import math
import os
import secrets
import signal
import struct
import sys
import time
from operator import add, mul

import jnd_datagram as jd

MOST_FORCE_N, MOST_TOTAL_FORCE_N = 8.0, 20.0
MOST_SLEW_N_PER_S, MOST_SPEED_M_PER_S = 2000.0, 5.0
MOST_DATAGRAMS_A_TICK, MOST_ANSWERS_A_TICK = 256, 8

# What `--wrong NAME` does, for a check of devices to find. Never use one with a robot.
WRONG = {
    "units_mm": "tells positions and velocities in mm and mm/s",
    "force_sign": "pushes the hand the other way and tells the force as it was asked for",
    "silence": "keeps the last force when commands stop, come too late or after its own pause",
    "halt": "takes no notice of a halt",
    "bad_key": "believes what is sealed by any key",
    "replay": "takes a command again whose number came before",
    "stale": "measures five times a second and repeats the last measurement in between",
    "sequence_wrap": "begins 1000 numbers before the last one of 32 bits, and stays at that one",
    "sequence_step": "counts its datagrams by two",
    "half_rate": "ticks half as often as its welcome says",
    "rearms": "arms again after a fault, without a new number of an arming",
    "arms_with_force": "arms on a command that has a force",
    "arming": "arms at the number 0 as well, which asks for none",
    "no_limits": "has no limit of force and none of its change",
    "echo": "echoes a clock that nobody sent, a second ahead",
    "told_as_sent": "gives every force 30 ms late and tells it as if it acted at once",
    "acted": "tells half of each force",
    "points": "moves the next point instead of the one that is pushed",
    "force_size": "pushes the hand seven times as hard as it was asked",
    "slow_velocity": "filters velocities by a low-pass of first order that lags by 40 ms",
    "other_version": "does not answer a hello of another version",
    "unknown_stream": "does not answer a command on a stream that it does not know (without a key)",
    "datagrams": "sends four bytes that are no datagram after every hundredth state",
    "jitter": "stands still for 150 ms at every fiftieth tick",
    "time": "tells the device time in us",
    "velocity": "tells velocities with the other sign",
    "busy": "leaves its program for any other one that says hello",
    "goodbye": "takes no notice of a goodbye and of silence, and lets nobody else in",
    "gone": "waits for ever for a program that died",
    "description": "tells the half widths of its workspace in mm",
    # What only a person finds, with --follow.
    "still": "tells a velocity of 5 cm/s when the hand is at rest",
    "moves": "does not tell what happens along y",
    "distance": "tells positions in inches",
    "swapped_axes": "tells y for x and x for y",
    "mirrored_axes": "tells x with the other sign, as a left-handed frame does",
    "points_order": "tells the index finger for the thumb and the thumb for the index finger",
    "buttons": "tells of buttons that never change",
    "gripper": "tells a gripper that is larger when it is closed",
    "workspace": "tells a workspace of 5 cm to either side, although the hand goes 20 cm",
}


class Robot:
    """A hand that strokes by itself: one mass, pulled along by a spring and a damper, with all
    points fixed to it. `simulated` False is for what can hurt somebody."""

    name = "python reference"
    simulated = True
    # A person's hand moves by itself and takes no orders; a simulated one does both.
    moves_by_itself = True
    _HOME_M = (0.0, 0.0, 0.1)
    _OFFSET_M = ((0.0, 0.0, 0.0), (0.02, 0.0, 0.0), (-0.03, 0.05, 0.0), (0.0, 0.08, 0.0),
                 (0.02, 0.09, 0.0))
    _MASS_KG, _STIFFNESS_N_PER_M, _DAMPING_N_S_PER_M = 1.0, 400.0, 35.0
    _DEVICE_DAMPING_N_S_PER_M = 4.83  # The hand feels it besides the force of the program.

    # What it says of itself; 0 and "" where it does not say. One that counts its points
    # otherwise tells shares of its own: each part of the hand's force, together 1.
    serial, firmware = "simulated", "1.0"
    own_mass_kg, own_damping_n_s_per_m, loop_delay_s = 1.0, 4.83, 0.001
    half_width_m = (1.0, 1.0, 1.0)

    def __init__(self, rate_hz, points, channels=0):
        self.points, self.share_ratio = points, jd.area_shares(points)
        self.channels = channels  # jd.MEASURED_FORCE and so on, for read_more
        self._dt_s = 1.0 / rate_hz
        self.reset()

    # ===== Put your robot here: begin =====================================================
    def read_robot(self):
        """Measures: time_ns (device's own, rising), 15 positions in m and 15 velocities in m/s
        (x, y, z of palm inner, palm outer, thumb, index, middle), bits of the points held to the
        hand, whether the robot's own switch enables it. Raise OSError where that fails."""
        self._move()
        position_m = [self._at_m[i] + offset_m[i] for offset_m in self._OFFSET_M for i in range(3)]
        return (self._time_ns, position_m, list(self._velocity_m_per_s) * jd.NUM_POINTS,
                self.points, True)

    def read_more(self):
        """What else it measured at that time, of which `channels` tells: 15 forces on the hand by
        sensors, N; the end effector's orientation as a unit quaternion w, x, y, z; 3 torques on
        the hand there, N m; the gripper's opening, m; bits of the buttons that are pressed."""
        if not self.channels:
            return [0.0] * 15, (1.0, 0.0, 0.0, 0.0), [0.0] * 3, 0.0, 0
        turn_rad = self._at_m[0]  # Made up, of where the hand is.
        return (self._force_n, (math.cos(turn_rad / 2), 0.0, 0.0, math.sin(turn_rad / 2)),
                [0.0, 0.0, 0.01 * self._at_m[0]], 0.05 + 0.01 * self._at_m[1],
                self._at_m[0] > 0.0)

    def write_robot(self, force_n):
        """Gives 15 forces on the hand, N, in the order of the positions, until the next call.
        Raise OSError where that fails, after the motors were made free of force."""
        self._force_n = force_n

    # ===== Put your robot here: end =======================================================

    def reset(self):
        """As at the start, for the next program."""
        self._time_ns, self._at_m, self._velocity_m_per_s = 0, list(self._HOME_M), [0.0] * 3
        self._middle_m = list(self._HOME_M)
        self._force_n = [0.0] * 15
        self._order, self._phase_rad, self.num_strokes, self.home = None, 0.0, 0, True
        # What a simulated participant feels, summed over ticks: how many, force against the
        # motion in N, the same of the program's force alone, speed in m/s. A robot has zeros.
        self.sums = [0, 0.0, 0.0, 0.0]

    def obey(self, order):
        """An order of the program to a simulated hand: stroke, or go home, as None means."""
        if order is None or self._order is None or order.movement > self._order.movement:
            self._phase_rad, self.num_strokes, self.home = 0.0, 0, False
            self._middle_m = list(self._at_m)
            self._order = order

    def _wanted_m(self):
        """Where the spring pulls to: to the height at 0.5 m/s, then left and right."""
        order, goal_m = self._order, self._HOME_M
        does_stroke = (order is not None and order.strokes
                       and not 0 < order.num_strokes <= self.num_strokes)
        if does_stroke:
            goal_m = (0.0, 0.0, order.height_m)
        way_m = math.dist(goal_m, self._middle_m)
        step_m = 0.5 * self._dt_s
        part = min(1.0, step_m / way_m) if way_m else 1.0
        self._middle_m = [at + part * (goal - at) for at, goal in zip(self._middle_m, goal_m)]
        self.home = self.home or not does_stroke and math.dist(self._at_m, self._HOME_M) < 0.01
        if not does_stroke or way_m > step_m:
            return self._middle_m
        self._phase_rad += order.speed_m_per_s / order.half_width_m * self._dt_s
        self.num_strokes = int(self._phase_rad / (2.0 * math.pi))  # there and back
        return [order.half_width_m * math.sin(self._phase_rad), *self._middle_m[1:]]

    def _move(self):
        """One tick of simulated time, however late the real one is."""
        self._time_ns += round(self._dt_s * 1e9)
        wanted_m, velocity_m_per_s = self._wanted_m(), self._velocity_m_per_s
        total_n = [sum(self._force_n[i::3]) for i in range(3)]
        speed_m_per_s = math.hypot(*velocity_m_per_s)
        if speed_m_per_s:
            against_n = -sum(map(mul, total_n, velocity_m_per_s)) / speed_m_per_s
            felt_n = against_n + self._DEVICE_DAMPING_N_S_PER_M * speed_m_per_s
            self.sums = list(map(add, self.sums, (1, felt_n, against_n, speed_m_per_s)))
        damping_n_s_per_m = self._DAMPING_N_S_PER_M + self._DEVICE_DAMPING_N_S_PER_M
        for i in range(3):
            force_n = (self._STIFFNESS_N_PER_M * (wanted_m[i] - self._at_m[i])
                       - damping_n_s_per_m * velocity_m_per_s[i] + total_n[i])
            velocity_m_per_s[i] += force_n / self._MASS_KG * self._dt_s
            self._at_m[i] += velocity_m_per_s[i] * self._dt_s


class FollowedRobot(Robot):
    """A hand without a robot that does what `jnd device-check --by-hand` asks a person to do: it
    reads the prompts from the file that its standard error goes to."""

    name, moves_by_itself = "python person", False
    half_width_m = (0.25, 0.25, 0.25)
    _PLACES_M = {"right": (0.1, 0.0, 0.1), "away": (0.0, 0.1, 0.1), "up": (0.0, 0.0, 0.2)}
    _ENDS_M = ((0.2, 0.0, 0.1), (-0.2, 0.0, 0.1), (0.0, 0.12, 0.1), (0.0, -0.2, 0.1),
               (0.0, 0.0, 0.2), (0.0, 0.0, -0.2))
    _QUICKNESS_PER_S = 25.0  # Of a mass on a spring that just does not swing.

    def __init__(self, rate_hz, points, file_name, wrong):
        self._file_name, self._wrong = file_name, wrong
        self._step, self._began_ns, self._line = "", 0, ""
        super().__init__(rate_hz, points, 24)  # gripper and buttons
        if wrong == "workspace":
            self.half_width_m = (0.05, 0.05, 0.05)
        self._finger_m = [0.0] * jd.NUM_POINTS

    def reset(self):
        super().reset()
        self._began_ns = 0

    def _read_prompts(self):
        """Which step is asked for, 40 times a second."""
        if self._time_ns % 25_000_000 >= self._dt_s * 1e9:
            return
        try:
            with open(self._file_name, encoding="utf-8", errors="replace") as prompts:
                lines = [line for line in prompts if line.startswith("PROMPT ")]
        except OSError:
            return
        step = lines[-1].split()[1].rstrip(":") if lines else ""
        if step != self._step:
            self._step, self._began_ns = step, self._time_ns

    def _wanted_m(self):
        since_s = (self._time_ns - self._began_ns) / 1e9
        if self._step == "workspace":
            return self._ENDS_M[int(since_s / 0.3) % len(self._ENDS_M)]
        return self._PLACES_M.get(self._step, self._HOME_M)

    def _move(self):
        self._time_ns += round(self._dt_s * 1e9)
        self._read_prompts()
        wanted_m, quick = self._wanted_m(), self._QUICKNESS_PER_S
        for i in range(3):
            velocity = self._velocity_m_per_s[i]
            velocity += self._dt_s * quick * (
                quick * (wanted_m[i] - self._at_m[i]) - 2.0 * velocity)
            self._velocity_m_per_s[i] = velocity
            self._at_m[i] += velocity * self._dt_s
        since_s = (self._time_ns - self._began_ns) / 1e9
        fingers = ("thumb", "index", "middle")
        self._finger_m = [0.0] * jd.NUM_POINTS
        if self._step in fingers:
            self._finger_m[2 + fingers.index(self._step)] = 0.01 * math.sin(12.0 * since_s)

    def read_robot(self):
        time_ns, position_m, velocity_m_per_s, held, enabled = super().read_robot()
        for point, way_m in enumerate(self._finger_m):
            position_m[3 * point + 1] += way_m
        for vectors in (position_m, velocity_m_per_s):
            self._spoil(vectors)
        if self._wrong == "still":
            velocity_m_per_s[0::3] = [value + 0.05 for value in velocity_m_per_s[0::3]]
        return time_ns, position_m, velocity_m_per_s, held, enabled

    def _spoil(self, vectors):
        if self._wrong == "moves":
            vectors[1::3] = [0.0] * jd.NUM_POINTS
        elif self._wrong == "distance":
            vectors[:] = [value / 0.0254 for value in vectors]
        elif self._wrong == "swapped_axes":
            vectors[0::3], vectors[1::3] = vectors[1::3], vectors[0::3]
        elif self._wrong == "mirrored_axes":
            vectors[0::3] = [-value for value in vectors[0::3]]
        elif self._wrong == "points_order":
            vectors[6:9], vectors[9:12] = vectors[9:12], vectors[6:9]

    def read_more(self):
        since_s = (self._time_ns - self._began_ns) / 1e9
        buttons, gripper_m = 0, 0.02
        if self._step == "buttons" and self._wrong != "buttons":
            buttons = 1 << int(since_s / 0.2) % 2
        if self._step == "gripper":
            gripper_m = 0.08 if since_s < 0.4 else 0.0
            if self._wrong == "gripper":
                gripper_m = 0.08 - gripper_m
        return [0.0] * 15, (1.0, 0.0, 0.0, 0.0), [0.0] * 3, gripper_m, buttons


class Server:
    """The protocol, one `tick` after the other."""

    def __init__(self, socket, robot, rate_hz, key, wrong="", log=None):
        self._socket, self._robot, self._rate_hz, self._key = socket, robot, rate_hz, key
        self._wrong, self._log = wrong, log
        # Of what can hurt nobody a busy machine may be slower.
        self._patience_ns = 100_000_000 if robot.simulated else 20_000_000
        self._answer_age_ns = 120_000_000 if robot.simulated else 40_000_000
        self._challenge = self._drawn()
        self._last_tick_ns = time.monotonic_ns()
        self._was_enabled = False
        self._acted_n = [0.0] * 15  # what the motors were told last
        self._waiting_n = []        # only for the wrong device that is late
        self._slow_m_per_s = [0.0] * 15  # likewise, of the one with a slow filter
        self._measured = None
        self.num_ticks, self.num_missed, self.num_clients, self.num_armings = 0, 0, 0, 0
        self._forget()

    @staticmethod
    def _drawn():
        return secrets.randbits(63) + 1

    def _forget(self, address=None, token=0, stream=0, client_rate_hz=1000.0):
        """No client, or a new one: nothing of the last one counts."""
        self._address, self._token, self._stream = address, token, stream
        self._to_device, self._to_program = None, None
        if self._key and stream:
            self._to_device, self._to_program = jd.stream_keys(self._key, token, stream)
        self._link = jd.Link(client_rate_hz)
        self._number = 2**32 - 1000 if self._wrong == "sequence_wrap" else 0
        self._sent_at_ns = {}  # when the last states were sent, by their number
        self._command, self._command_number, self._came_at_ns, self._recent = None, None, 0, False
        self._armed, self._armed_number, self._fault, self._order_number = False, 0, 0, 0
        self._last_heard_ns = time.monotonic_ns()

    def _disarm(self, fault):
        if self._armed:
            self._armed, self._fault = False, fault

    # ----- What comes -----

    def _receive(self, now_ns):
        self._num_answers = 0
        for _ in range(MOST_DATAGRAMS_A_TICK):
            try:
                data, address = self._socket.recvfrom(2048)
            except (BlockingIOError, InterruptedError):
                return
            except OSError:
                continue  # A client that is gone; its silence ends the connection.
            self._take(data, address, now_ns)

    def _take(self, data, address, now_ns):
        found = jd.unpack(data, self._key is not None)
        if found is None:
            self._say_what_is_wrong(data, address, now_ns)
            return
        is_of_client = address == self._address and found.stream == self._stream != 0
        if self._key and self._wrong != "bad_key":
            key = self._key if found.kind <= jd.REFUSAL else self._to_device
            if key is None or found.kind > jd.REFUSAL and not is_of_client:
                return  # Nobody can tell who sealed what is of another stream.
            if not jd.is_sealed(data, key):
                if found.kind == jd.HELLO:
                    self._refuse(jd.OTHER_KEY, address, now_ns, token=found.token)
                return
        if found.kind == jd.HELLO:
            self._answer(found, address, now_ns)
        elif not is_of_client:
            if (found.kind == jd.COMMAND and not self._key
                    and self._wrong != "unknown_stream"):
                self._refuse(jd.UNKNOWN_STREAM, address, now_ns, stream=found.stream)
        elif found.kind >= jd.COMMAND:
            is_new = self._link.take(found.number, found.clock_ns, found.echo_ns, now_ns)
            if is_new or self._wrong == "replay":
                self._take_of_client(found, now_ns)

    def _say_what_is_wrong(self, data, address, now_ns):
        """A hello of another version or key: its sender is told so, and nothing else."""
        if len(data) < 53 or data[:4] != b"JDLK" or data[6:8] != b"\x01\x00":
            return
        token = struct.unpack_from("<Q", data, 40)[0]
        if struct.unpack_from("<H", data, 4)[0] != jd.VERSION:
            if self._wrong == "other_version":
                return
            self._refuse(jd.OTHER_VERSION, address, now_ns, token=token)
        elif jd.unpack(data, self._key is None) is not None:  # One side alone has a key.
            self._refuse(jd.OTHER_KEY, address, now_ns, token=token)

    def _take_of_client(self, found, now_ns):
        self._last_heard_ns = now_ns
        if found.kind == jd.COMMAND:
            last = self._command_number
            is_later = last is None or 0 < (found.number - last) & 0xFFFFFFFF < 1 << 31
            if is_later or self._wrong == "replay":
                self._command, self._command_number = found, found.number
                self._came_at_ns, self._recent = now_ns, True
        elif found.kind == jd.ORDER and self._robot.moves_by_itself:
            if found.order_number > self._order_number:
                self._order_number = found.order_number
                self._robot.obey(found)
        elif found.kind == jd.HALT and self._wrong != "halt":
            self._disarm(11)
        elif found.kind == jd.GOODBYE and self._wrong != "goodbye":
            self._end()

    def _end(self):
        self._forget()
        if self._robot.simulated:
            self._robot.reset()

    def _answer(self, hello, address, now_ns):
        is_of_client = address == self._address
        if (self._address is not None and not is_of_client and not hello.only_asks
                and self._wrong != "busy"):
            if hello.challenge == self._challenge:
                self._challenge = self._drawn()  # Refused, it is worth nothing later.
            self._refuse(jd.BUSY, address, now_ns, token=hello.token, key=self._key)
            return
        stream = 0
        if not hello.only_asks:
            if is_of_client and hello.token == self._token:
                stream = self._stream  # The welcome was lost.
            elif hello.challenge == self._challenge:
                stream = self._drawn()
                self._challenge = self._drawn()
                if is_of_client and self._robot.simulated:
                    self._robot.obey(None)  # It said hello anew: the hand goes on from here.
                self._forget(address, hello.token, stream, hello.rate_hz)
                self.num_clients += 1
                self._num_answers = 0
        self._reply(jd.pack(
            jd.WELCOME, stream, 0, now_ns, hello.clock_ns, self._key, token=hello.token,
            rate_hz=self._rate_hz, most_force_n=MOST_FORCE_N,
            most_total_force_n=MOST_TOTAL_FORCE_N, stand_in_s=self._patience_ns / 1e9,
            points=self._robot.points, num_joints=0, simulated=self._robot.simulated,
            moves_by_itself=self._robot.moves_by_itself,
            name=self._robot.name.encode("ascii"), challenge=self._challenge,
            share_ratio=self._robot.share_ratio, most_slew_n_per_s=MOST_SLEW_N_PER_S,
            most_speed_m_per_s=MOST_SPEED_M_PER_S, half_width_m=self._robot.half_width_m,
            own_mass_kg=self._robot.own_mass_kg,
            own_damping_n_s_per_m=self._robot.own_damping_n_s_per_m,
            loop_delay_s=self._robot.loop_delay_s, channels=self._robot.channels,
            has_switch=0, serial=self._robot.serial.encode("ascii"),
            firmware=self._robot.firmware.encode("ascii")), address)

    def _refuse(self, reason, address, now_ns, token=0, stream=0, key=None):
        self._reply(jd.pack(jd.REFUSAL, stream, 0, now_ns, 0, key, token=token, reason=reason),
                    address)

    def _reply(self, data, address):
        self._num_answers += 1
        if self._num_answers <= MOST_ANSWERS_A_TICK:
            self._send(data, address)

    def _send(self, data, address):
        try:
            self._socket.sendto(data, address)
        except OSError:
            pass  # As if it had been lost on the way.

    # ----- Who may give force -----

    def _answer_is_older(self, now_ns, age_ns):
        sent_at_ns = self._sent_at_ns.get(self._command.state_number)
        return sent_at_ns is None or now_ns - sent_at_ns >= age_ns

    def _arm_or_disarm(self, now_ns):
        command, link = self._command, self._link
        if self._recent and command.arm_number != self._armed_number:
            self._armed = False
            if link.lost_in_a_row:
                link.judge_anew()
            last_states = range(
                self._number + 1 - round(0.04 * self._rate_hz), self._number + 1)
            if ((command.arm_number > 0 or self._wrong == "arming") and link.is_settled()
                    and (not any(command.force_n) or self._wrong == "arms_with_force")
                    and command.state_number in (n & 0xFFFFFFFF for n in last_states)
                    and self._measured is not None):
                self._armed, self._armed_number, self._fault = True, command.arm_number, 0
                self._acted_n = [0.0] * 15
                self.num_armings += 1
        if self._armed and self._wrong != "silence":
            if (now_ns - self._came_at_ns >= self._patience_ns
                    or self._answer_is_older(now_ns, self._answer_age_ns)
                    or link.lost_in_a_row or link.level() == 0):
                self._disarm(12)
        if (self._wrong == "rearms" and not self._armed and self._armed_number
                and self._recent and now_ns - self._came_at_ns < self._patience_ns):
            self._armed = True

    def _limited(self, force_n, velocity_m_per_s, held):
        """What the hand gets of a command; None where it disarms."""
        if not all(map(math.isfinite, force_n)):
            self._disarm(3)
            return None
        for point in range(5):
            here = slice(3 * point, 3 * point + 3)
            if held >> point & 1 and math.hypot(*velocity_m_per_s[here]) > MOST_SPEED_M_PER_S:
                self._disarm(8)
                return None
        if not any(force_n):
            return [0.0] * 15  # No slew: at once.
        points = [list(force_n[3 * point:3 * point + 3]) if held >> point & 1 else [0.0] * 3
                  for point in range(5)]
        if self._wrong != "no_limits":
            for vector in points:
                size_n = math.hypot(*vector)
                if size_n > MOST_FORCE_N:
                    vector[:] = [value * MOST_FORCE_N / size_n for value in vector]
            total_n = sum(math.hypot(*vector) for vector in points)
            scale = min(1.0, MOST_TOTAL_FORCE_N / total_n) if total_n else 1.0
            most_change_n = MOST_SLEW_N_PER_S / self._rate_hz
            for point, vector in enumerate(points):
                if not held >> point & 1:
                    continue
                last_n = self._acted_n[3 * point:3 * point + 3]
                change_n = [value * scale - last for value, last in zip(vector, last_n)]
                size_n = math.hypot(*change_n)
                part = min(1.0, most_change_n / size_n) if size_n else 1.0
                vector[:] = [last + change * part for last, change in zip(last_n, change_n)]
        return [value for vector in points for value in vector]

    # ----- One tick -----

    def _measure(self):
        if self._wrong == "stale" and self.num_ticks % round(self._rate_hz / 5):
            return
        try:
            measured = self._robot.read_robot()
        except OSError:
            self._measured = None
            self._disarm(4)
            self._fault = 4
            return
        if not all(map(math.isfinite, measured[1] + measured[2])):
            self._measured = None
            self._disarm(2)
            self._fault = 2
            return
        if self._wrong == "slow_velocity":
            part = 1.0 / (1.0 + 0.04 * self._rate_hz)
            self._slow_m_per_s = [slow + part * (now - slow) for slow, now
                                  in zip(self._slow_m_per_s, measured[2])]
            measured = (*measured[:2], list(self._slow_m_per_s), *measured[3:])
        if self._wrong == "points":
            for i in range(15):
                measured[1][(i + 3) % 15] += 0.01 * self._acted_n[i]
        self._measured = measured

    def _give(self, force_n):
        if self._wrong == "told_as_sent":
            self._waiting_n.append(force_n)
            late = self._waiting_n.pop(0) if len(self._waiting_n) > 0.03 * self._rate_hz else None
            given_n = late or [0.0] * 15
        else:
            times = {"force_sign": -1.0, "force_size": 7.0}.get(self._wrong, 1.0)
            given_n = [times * value for value in force_n]
        try:
            self._robot.write_robot(given_n)
            self._acted_n = [0.5 * value for value in force_n] if self._wrong == "acted" else force_n
        except OSError:
            self._disarm(5)
            self._acted_n = given_n = [0.0] * 15
        if self._log is not None:  # At once: whoever is killed has told everything.
            os.write(self._log, struct.pack("<q15d", time.monotonic_ns(), *given_n))

    def tick(self):
        now_ns = time.monotonic_ns()
        self.num_ticks += 1
        self._receive(now_ns)
        if now_ns - self._last_tick_ns >= self._patience_ns and self._wrong != "silence":
            self._disarm(11)  # Nobody can tell how old it is what waited.
            self._recent = False
        self._last_tick_ns = now_ns
        if (self._address is not None and now_ns - self._last_heard_ns >= 1_000_000_000
                and self._wrong not in ("goodbye", "gone")):
            self._end()
        self._arm_or_disarm(now_ns)
        acted_n = self._acted_n  # until now: it goes into the state
        self._measure()
        time_ns, position_m, velocity_m_per_s, held, enabled = (
            self._measured or (0, [0.0] * 15, [0.0] * 15, 0, False))
        wanted_n = self._command.force_n if self._command else [0.0] * 15
        if self._was_enabled and not enabled or enabled and not self._was_enabled and any(wanted_n):
            self._disarm(21)
        self._was_enabled = enabled
        force_n = None
        if self._armed and enabled:
            force_n = self._limited(wanted_n, velocity_m_per_s, held)
        self._give(force_n if force_n is not None else [0.0] * 15)
        if self._address is not None:
            self._send_state(time_ns, position_m, velocity_m_per_s, held, enabled, acted_n)

    def _send_state(self, time_ns, position_m, velocity_m_per_s, held, enabled, acted_n):
        if self._wrong == "sequence_wrap":
            self._number = min(self._number + 1, 2**32 - 1)
        else:
            step = 2 if self._wrong == "sequence_step" else 1
            self._number = (self._number + step) & 0xFFFFFFFF
        if self._wrong == "units_mm":
            position_m = [1000.0 * value for value in position_m]
            velocity_m_per_s = [1000.0 * value for value in velocity_m_per_s]
        if self._wrong == "velocity":
            velocity_m_per_s = [-value for value in velocity_m_per_s]
        if self._wrong == "time":
            time_ns //= 1000
        now_ns = time.monotonic_ns()
        self._sent_at_ns[self._number] = now_ns
        if len(self._sent_at_ns) > 0.2 * self._rate_hz:
            del self._sent_at_ns[next(iter(self._sent_at_ns))]
        summed = self._robot.sums
        measured_force_n, orientation_wxyz, torque_n_m, gripper_m, buttons = (
            self._robot.read_more())
        echo_ns = self._link.peer_clock_ns + (10**9 if self._wrong == "echo" else 0)
        self._send(jd.pack(
            jd.STATE, self._stream, self._number, now_ns, echo_ns, self._to_program,
            time_ns=time_ns, position_m=position_m, velocity_m_per_s=velocity_m_per_s,
            end_effector_m=position_m[:3], joint_rad=[0.0] * 22, joint_torque_n_m=[0.0] * 22,
            num_summed=summed[0], opposing_n=summed[1], rendered_opposing_n=summed[2],
            speed_m_per_s=summed[3],
            num_strokes=self._robot.num_strokes, armed_number=self._armed_number,
            order_number=self._order_number, held=held, armed=self._armed,
            measured=self._measured is not None, home=self._robot.home, fault=self._fault,
            level=self._link.level(), acted_n=acted_n, enabled=enabled,
            measured_force_n=measured_force_n, orientation_wxyz=orientation_wxyz,
            torque_n_m=torque_n_m, gripper_m=gripper_m, buttons=buttons), self._address)
        if self._wrong == "datagrams" and self._number % 100 == 0:
            self._send(b"JDLK", self._address)

    def run(self, until_ns):
        """Ticks at the rate until then; what cannot be made up for counts as missed."""
        half = 2 if self._wrong == "half_rate" else 1
        period_ns = round(1e9 * half / self._rate_hz)
        next_ns = time.monotonic_ns()
        while time.monotonic_ns() < until_ns:
            self.tick()
            if self._wrong == "jitter" and self.num_ticks % 50 == 0:
                time.sleep(0.15)
            next_ns += period_ns
            late_ns = time.monotonic_ns() - next_ns
            if late_ns > 0:
                self.num_missed += late_ns // period_ns
                next_ns += late_ns // period_ns * period_ns
            else:
                time.sleep(-late_ns / 1e9)

    def stop(self):
        """No force, and a word to the program that it ends."""
        self._give([0.0] * 15)
        if self._address is not None:
            self._number = (self._number + 1) & 0xFFFFFFFF
            self._send(jd.pack(jd.GOODBYE, self._stream, self._number, time.monotonic_ns(),
                               self._link.peer_clock_ns, self._to_program), self._address)


def main():
    words = argparse.ArgumentParser(
        description="A device for jnd: a simulated hand, to be replaced by an own robot.",
        epilog="Wrong devices: " + "; ".join(f"{name} {what}" for name, what in WRONG.items()))
    words.add_argument("--listen", default="127.0.0.1", help="address to be reached at")
    words.add_argument("--port", type=int, default=4700, help="0: any that is free")
    words.add_argument("--key", help="file that `jnd device-key NAME` wrote")
    words.add_argument("--rate-hz", type=float, default=1000.0, help="ticks a second, the study's")
    words.add_argument("--points", type=int, default=5, choices=range(1, 6),
                       help="how many points of a hand it holds, the first ones")
    words.add_argument("--measures", action="store_true",
                       help="tell force, orientation, torque, gripper and buttons as well")
    words.add_argument("--seconds", type=float, default=math.inf, help="how long; until stopped")
    words.add_argument("--log", help="file to which each tick adds a record of 128 bytes: time "
                       "(monotonic, ns, int64) and the 15 forces that the robot is given")
    words.add_argument("--follow", metavar="FILE",
                       help="move as the prompts in it say: where `jnd device-check --by-hand` "
                       "writes its standard error")
    words.add_argument("--wrong", default="", choices=["", *WRONG], metavar="NAME",
                       help="behave wrongly, to try a check of devices")
    given = words.parse_args()
    key = jd.read_key(given.key)
    socket = jd.opened_socket(given.listen, given.port, key)
    points = (1 << given.points) - 1
    robot = Robot(given.rate_hz, points, 31 if given.measures else 0)
    if given.follow:
        robot = FollowedRobot(given.rate_hz, points, given.follow, given.wrong)
    log = None
    if given.log:
        log = os.open(given.log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
    if given.wrong == "description":
        robot.half_width_m = tuple(1000.0 * value for value in robot.half_width_m)
    server = Server(socket, robot, given.rate_hz, key, given.wrong, log)
    print("listening on {}:{}".format(*socket.getsockname()), flush=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    jd.take_real_time_priority()
    begin_ns = time.monotonic_ns()
    try:
        server.run(begin_ns + given.seconds * 1e9)
    except (KeyboardInterrupt, SystemExit):
        pass
    finally:
        server.stop()
    seconds = (time.monotonic_ns() - begin_ns) / 1e9
    print(f"{server.num_ticks} ticks in {seconds:.1f} s, {server.num_missed} missed; "
          f"{server.num_clients} programs connected, {server.num_armings} armings")


if __name__ == "__main__":
    main()
