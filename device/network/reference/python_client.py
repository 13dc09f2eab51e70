#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The jnd authors. It may be used, copied, changed and sold by anybody for
# anything, without any warranty, as long as this notice stays in it.
"""Looks at a device that speaks jnd's datagrams: what it says of itself, and its states.

    python3 python_client.py 127.0.0.1:4700               # what it can do, and 10 s of states
    python3 python_client.py 127.0.0.1:4700 --only-ask    # what it can do, no connection
    python3 python_client.py 127.0.0.1:4700 --force-n 0.2,0,0   # arms it and gives force

Without `--force-n` it asks for no arming, so the device passes on no force at all.
"""

import argparse
import secrets
import signal
import socket
import sys
import time

import jnd_datagram as jd


class Client:
    """A program, as the device sees it. It speaks by `tick`, as often as the device's rate."""

    def __init__(self, address, key):
        self._address, self._key = address, key
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.connect(address)  # What comes from elsewhere counts for nothing.
        self._socket.setblocking(False)
        self._token, self._challenge = secrets.randbits(64), 0
        self._stream, self._number, self._next_hello_ns = 0, 0, 0
        self._to_device, self._to_program = None, None
        self.welcome, self.state, self.state_number, self.state_came_ns = None, None, 0, 0
        self.refusal, self.has_ended, self.link = "", False, jd.Link(1000.0)
        self.num_states = 0

    def _send(self, kind, **content):
        self._number = (self._number + 1) & 0xFFFFFFFF
        self._send_bytes(jd.pack(kind, self._stream, self._number, time.monotonic_ns(),
                                 self.link.peer_clock_ns, self._to_device, **content))

    def _send_bytes(self, data):
        try:
            self._socket.send(data)
        except OSError:
            pass  # Nobody listens there (yet).

    def is_connected(self):
        return self._stream != 0

    def say_hello(self, only_asks):
        """Every 50 ms, until it is answered."""
        now_ns = time.monotonic_ns()
        if now_ns < self._next_hello_ns:
            return
        self._next_hello_ns = now_ns + 50_000_000
        self._send_bytes(jd.pack(jd.HELLO, 0, 0, now_ns, 0, self._key, token=self._token,
                                 only_asks=only_asks, challenge=self._challenge,
                                 rate_hz=self.welcome.rate_hz if self.welcome else 1000.0))

    def command(self, arm_number, force_n):
        """The force answers to the newest state. Arming 0 asks for none."""
        self._send(jd.COMMAND, arm_number=arm_number, state_number=self.state_number,
                   force_n=force_n)

    def halt(self):
        self._send(jd.HALT)

    def say_goodbye(self):
        """Twice, for nobody answers it."""
        for _ in range(2 if self._stream else 0):
            self._send(jd.GOODBYE)

    def receive(self):
        while True:
            try:
                data = self._socket.recv(2048)
            except BlockingIOError:
                return
            except OSError:
                return  # Refused by the system: nobody listens there (yet).
            self._take(data, time.monotonic_ns())

    def _take(self, data, now_ns):
        found = jd.unpack(data, self._key is not None)
        if found is None:
            hint = jd.unpack(data, False)  # It only helps to say what is wrong.
            if hint is not None and hint.kind == jd.REFUSAL:
                self.refusal = jd.REFUSALS[hint.reason]
            elif jd.unpack(data, self._key is None) is not None:
                self.refusal = jd.REFUSALS[jd.OTHER_KEY]
            return
        if self._key:
            key = self._key if found.kind <= jd.REFUSAL else self._to_program
            if key is None or not jd.is_sealed(data, key):
                return
        if found.kind == jd.WELCOME and found.token == self._token:
            self._take_welcome(found)
        elif found.kind == jd.REFUSAL:
            is_ours = found.token == self._token
            is_lost = (found.reason == jd.UNKNOWN_STREAM and found.stream == self._stream
                       and not self._key)
            if is_ours or found.reason in (jd.OTHER_VERSION, jd.OTHER_KEY):
                self.refusal = jd.REFUSALS[found.reason]
            elif is_lost:
                self.has_ended = True
        elif found.stream == self._stream != 0:
            if found.kind == jd.GOODBYE:
                self.has_ended = True
            elif found.kind == jd.STATE and self.link.take(found.number, found.clock_ns,
                                                           found.echo_ns, now_ns):
                self.num_states += 1
                self.state, self.state_number = found, found.number
                self.state_came_ns = now_ns

    def _take_welcome(self, found):
        self.welcome, self.refusal = found, ""
        if found.challenge != self._challenge:
            self._challenge, self._next_hello_ns = found.challenge, 0
        if found.stream and not self._stream:
            self._stream, self.link = found.stream, jd.Link(found.rate_hz)
            if self._key:
                self._to_device, self._to_program = jd.stream_keys(self._key, self._token,
                                                                   found.stream)


def measured_besides(welcome):
    names = ("force", "orientation", "torque", "gripper", "buttons")
    found = [name for i, name in enumerate(names) if welcome.channels >> i & 1]
    return ", ".join(found) or "nothing"


def capabilities(welcome):
    name = welcome.name.split(b"\0")[0].decode("ascii", "replace")
    kind = "a simulation" if welcome.simulated else "REAL: it can hurt somebody"
    moves = ", moves by itself" if welcome.moves_by_itself else ""
    return (f"{name}: {kind}{moves}\n"
            f"{welcome.rate_hz:g} Hz, {bin(welcome.points).count('1')} contact points, "
            f"{welcome.num_joints} joints, measures besides: {measured_besides(welcome)}\n"
            f"at most {welcome.most_force_n:g} N at a point and {welcome.most_total_force_n:g} N "
            f"in all; a measurement may stand in for {1000 * welcome.stand_in_s:g} ms")


def shown(state, client, welcome):
    def three(values):
        return " ".join(f"{value:+.3f}" for value in values)
    lines = [f"{state.time_ns / 1e9:10.3f} s  {'armed' if state.armed else 'not armed'} "
             f"({state.armed_number}), fault {jd.FAULTS[state.fault]}, "
             f"{'measured' if state.measured else 'NOT MEASURED'}, "
             f"{'enabled' if state.enabled else 'switch open'}, "
             f"level to it {state.level} and back {client.link.level()}, "
             f"{client.link.num_missing()} missing, round trip "
             f"{(client.link.round_trip_ns or 0) / 1e6:.1f} ms"]
    for point in (i for i in range(jd.NUM_POINTS) if welcome.points >> i & 1):
        here = slice(3 * point, 3 * point + 3)
        held = "held " if state.held >> point & 1 else "loose"
        lines.append(f"  point {point} {held}  at {three(state.position_m[here])} m   "
                     f"{three(state.velocity_m_per_s[here])} m/s   "
                     f"acted {three(state.acted_n[here])} N")
    return "\n".join(lines)


def wait_for(client, is_there, what, only_asks, timeout_s=3.0):
    until_s = time.monotonic() + timeout_s
    while not is_there():
        if time.monotonic() > until_s:
            sys.exit(f"expected {what}, found " + (client.refusal or "that nothing answers"))
        client.say_hello(only_asks)
        client.receive()
        time.sleep(0.001)


def main():
    words = argparse.ArgumentParser(description="Looks at a device that speaks jnd's datagrams.")
    words.add_argument("address", help="HOST:PORT")
    words.add_argument("--key", help="file that `jnd device-key NAME` wrote")
    words.add_argument("--seconds", type=float, default=10.0, help="how long to watch")
    words.add_argument("--every-s", type=float, default=0.5, help="between two states shown")
    words.add_argument("--only-ask", action="store_true", help="what it can do, and nothing else")
    words.add_argument("--force-n", help="X,Y,Z: arms the device and gives this force at point 0")
    given = words.parse_args()
    host, _, port = given.address.rpartition(":")
    point_n = [float(value) for value in given.force_n.split(",")] if given.force_n else []
    if point_n and len(point_n) != 3:
        words.error("--force-n: expected X,Y,Z in newtons")
    client = Client((socket.gethostbyname(host), int(port)), jd.read_key(given.key))
    wait_for(client, lambda: client.welcome is not None, "a device", True)
    print(capabilities(client.welcome), flush=True)
    if given.only_ask:
        return
    wait_for(client, client.is_connected, "a connection", False)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    jd.take_real_time_priority()
    try:
        watch(client, given.seconds, given.every_s, point_n)
    except KeyboardInterrupt:
        pass
    finally:
        client.say_goodbye()
    print(f"{client.num_states} states in {given.seconds:g} s, "
          f"{client.link.num_missing()} of the last 512 missing")


def watch(client, seconds, every_s, point_n):
    """Speaks at the device's rate: without force, or with it for as long as it is armed."""
    none_n, force_n = [0.0] * 15, point_n + [0.0] * 12
    period_s = 1.0 / client.welcome.rate_hz
    begin_s = next_s = time.monotonic()
    next_shown_s = begin_s + every_s
    while time.monotonic() < begin_s + seconds and not client.has_ended:
        client.receive()
        state = client.state
        is_armed = state is not None and state.armed and state.armed_number == 1
        is_fresh = time.monotonic_ns() - client.state_came_ns < 20_000_000
        # One arming alone: after a fault it stays without force until it is started again.
        client.command(1 if point_n else 0,
                       force_n if point_n and is_armed and is_fresh else none_n)
        if state is not None and time.monotonic() >= next_shown_s:
            next_shown_s += every_s
            print(shown(state, client, client.welcome), flush=True)
        next_s = max(next_s + period_s, time.monotonic())
        time.sleep(max(0.0, next_s - time.monotonic()))


if __name__ == "__main__":
    main()
