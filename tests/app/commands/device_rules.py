"""Tries rules of device/network/README.md at a device that nobody uses, and names each broken one.

    python3 device_rules.py HOST:PORT [KEY_FILE]

The names are those of `python_device.py --wrong`. Of a device at home and at rest, which moves when
it is pushed, as those of device/network/reference are.
"""

import math
import os
import socket
import struct
import sys
import time
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                "../../../device/network/reference"))
import jnd_datagram as jd
import python_client

NONE_N = [0.0] * 15


def pushed(force_n):
    return [force_n] + [0.0] * 14


class Watcher(python_client.Client):
    """Remembers every state as it came, whatever its number is, and what was sent."""

    def __init__(self, address, key):
        super().__init__(address, key)
        self.states, self.last_sent, self.sent_clocks_ns = [], b"", {0}
        self.records = False

    def _take(self, data, now_ns):
        found = jd.unpack(data, self._key is not None)
        if found is not None and found.kind == jd.STATE and found.stream == self._stream:
            self.states.append(found)
        super()._take(data, now_ns)

    def _send_bytes(self, data):
        self.last_sent = data
        self.sent_clocks_ns.add(struct.unpack_from("<q", data, 24)[0])
        super()._send_bytes(data)

    def again(self, data):
        super()._send_bytes(data)

    def open(self):
        python_client.wait_for(self, self.is_connected, "a connection", False)

    def talk(self, seconds, arm_number, force_n, also=None):
        """Commands at the device's rate; the states that came meanwhile."""
        self.states = []
        until_s = next_s = time.monotonic()
        until_s += seconds
        while time.monotonic() < until_s:
            self.receive()
            self.command(arm_number, force_n)
            if also:
                also()
            next_s = max(next_s + 1.0 / self.welcome.rate_hz, time.monotonic())
            time.sleep(max(0.0, next_s - time.monotonic()))
        self.receive()
        return self.states

    def listen(self, seconds):
        """Says nothing."""
        self.states = []
        until_s = time.monotonic() + seconds
        while time.monotonic() < until_s:
            self.receive()
            time.sleep(0.001)
        return self.states

    def arm(self, number):
        for _ in range(10):
            if self.talk(0.1, number, NONE_N)[-1].armed and self.states[-1].armed_number == number:
                return True
        return False


def raw_answers(address, data):
    """What an address answers to these bytes, by their kind and reason."""
    asking = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    asking.settimeout(0.3)
    asking.sendto(data, address)
    try:
        answer = asking.recv(2048)
    except OSError:
        return None
    kind = struct.unpack_from("<H", answer, 6)[0]
    return kind, answer[48] if kind == jd.REFUSAL else None


def hello(key, version=jd.VERSION):
    data = jd.pack(jd.HELLO, 0, 0, 1, 0, None, token=5, only_asks=1, challenge=0)
    if version != jd.VERSION:
        data = data[:4] + struct.pack("<H", version) + data[6:-4]
        data += struct.pack("<I", zlib.crc32(data))
    return data + jd.seal(data, key) if key else data


def acts(state):
    return any(state.acted_n)


def flaws(address, key):
    rate_hz = 0.0
    # While nobody is connected.
    if raw_answers(address, hello(key, jd.VERSION + 1)) != (jd.REFUSAL, jd.OTHER_VERSION):
        yield "other_version", "no refusal of another version"
    other_key = bytes(32)
    if raw_answers(address, hello(other_key)) != (jd.REFUSAL, jd.OTHER_KEY):
        yield "bad_key", "no refusal of a hello that is sealed by another key"
    if not key:
        unknown = jd.pack(jd.COMMAND, 99, 1, 1, 0, None, arm_number=1, state_number=1,
                          force_n=NONE_N)
        if raw_answers(address, unknown) != (jd.REFUSAL, jd.UNKNOWN_STREAM):
            yield "unknown_stream", "no refusal of a stream that it does not know"

    program = Watcher(address, key)
    program.open()
    rate_hz = program.welcome.rate_hz
    # An arming is for commands without a force.
    program.talk(0.3, 0, NONE_N)
    if any(state.armed for state in program.talk(0.3, 1, pushed(1.0))):
        yield "arms_with_force", "it armed on a command that has a force"
    if not program.arm(2):
        yield "arming", "it does not arm"

    states = program.talk(1.0, 2, NONE_N)
    if len(states) < 0.65 * rate_hz:
        yield "half_rate", f"{len(states)} states in a second"
    steps = [(b.number - a.number) & 0xFFFFFFFF for a, b in zip(states, states[1:])]
    if sum(step != 1 for step in steps) > 0.2 * len(steps):
        # Two ways to count wrongly, told apart by whether the numbers move at all.
        name = "sequence_step" if steps and min(steps) > 1 else "sequence_wrap"
        yield name, f"numbers of states advance by {sorted(set(steps))[:4]}"
    if any(max(map(abs, state.position_m + state.velocity_m_per_s)) > 20.0 for state in states):
        yield "units_mm", "positions or velocities beyond every hand"
    risen = sum(b.time_ns > a.time_ns for a, b in zip(states, states[1:]))
    if risen < 0.5 * len(states):
        yield "stale", f"the device's time rose {risen} times in {len(states)} states"
    if any(state.echo_ns not in program.sent_clocks_ns for state in states):
        yield "echo", "it echoes a clock that was never sent"

    # A push moves the hand along, at once, and is limited.
    start_m = states[-1].position_m[0]
    states = program.talk(0.15, 2, pushed(2.0))
    acting = [i for i, state in enumerate(states) if acts(state)]
    if acting and (states[-1].position_m[0] - start_m) < 0.0005:
        yield "force_sign", "the hand does not go where the force pushes"
    moving = [i for i, state in enumerate(states) if abs(state.velocity_m_per_s[0]) > 0.005]
    if acting and (not moving or moving[0] - acting[0] > 0.02 * rate_hz):
        yield "told_as_sent", "the hand moves long after the force is told to act"
    program.talk(0.5, 2, NONE_N)
    states = program.talk(0.03, 2, pushed(100.0))
    told_n = [math.hypot(*state.acted_n[:3]) for state in states]
    if max(told_n) > program.welcome.most_force_n + 1e-6 or any(
            b - a > 2000.0 / rate_hz + 1e-6 for a, b in zip(told_n, told_n[1:])):
        yield "no_limits", f"a force of {max(told_n):.1f} N"

    # A command counts once.
    program.talk(0.5, 2, NONE_N)
    program.talk(0.02, 2, pushed(2.0))
    old = program.last_sent
    program.talk(0.1, 2, NONE_N)
    states = program.talk(0.1, 2, NONE_N, lambda: program.again(old))
    if any(map(acts, states)):
        yield "replay", "a command that was said again counted again"

    # Silence ends the force, and nothing but another arming brings it back.
    program.arm(3)
    program.talk(0.02, 3, pushed(2.0))
    told = program.listen(0.3)
    if told[-1].armed or acts(told[-1]):
        yield "silence", "the force stays when commands do not come"
    if any(state.armed or acts(state) for state in program.talk(0.3, 3, pushed(2.0))[5:]):
        yield "rearms", "it armed again by itself"
    program.arm(4)
    program.talk(0.02, 4, pushed(2.0))
    program.halt()
    if any(state.armed or acts(state) for state in program.talk(0.1, 4, pushed(2.0))[5:]):
        yield "halt", "the force stays after a halt"

    # One program at a time.
    second = Watcher(address, key)
    program.talk(0.2, 4, NONE_N, lambda: (second.say_hello(False), second.receive()))
    if second.is_connected() or second.refusal != jd.REFUSALS[jd.BUSY]:
        yield "busy", "no refusal while a program is connected"
    program.say_goodbye()
    time.sleep(0.05)
    second = Watcher(address, key)
    second.open()
    if any(state.armed or acts(state) for state in second.talk(0.1, 0, NONE_N)):
        yield "goodbye", "a force of the program before"
    second.say_goodbye()


def main():
    host, _, port = sys.argv[1].rpartition(":")
    key = jd.read_key(sys.argv[2]) if len(sys.argv) > 2 else None
    jd.take_real_time_priority()
    found = dict(flaws((host, int(port)), key))
    for name, what in found.items():
        print(f"{name}: {what}")
    print("no rule is broken" if not found else f"{len(found)} rules are broken")


if __name__ == "__main__":
    main()
