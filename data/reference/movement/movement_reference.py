"""Writes movement_reference.json: strokes of a made-up recording, measured with NumPy and SciPy.

Independent of the C++: turning points are peaks of the way along the stroke's axis, found by
their prominence in the whole recording at once; curves come from NumPy's interpolation. The test
makes the same recording from the same formulas. Not run by the tests, which read the JSON:

    /usr/bin/python3 data/reference/movement/movement_reference.py \
        > data/reference/movement/movement_reference.json
"""

import json
import sys

import numpy as np
import scipy
from scipy import signal

PERIOD_S = 0.001
RAMP_TICKS = 50
HYSTERESIS_M = 0.03
REST_M_PER_S, PAUSE_S = 0.02, 0.15
DAMPING_N_S_PER_M = 3.552  # Of 2 Pa s.
POINTS = [0, 13, 25, 50, 77, 100]
UNIT = np.array([0.8, 0.6])


def recording():
    """Every tick of 16 s but a gap; the hand stops for 0.4 s in the middle of a stroke."""
    tick = np.arange(16000)
    t = tick * PERIOD_S
    moving = np.where(t < 4.3, t, np.where(t < 4.7, 4.3, t - 0.4))
    rests = (t >= 4.3) & (t < 4.7)
    phase = 2 * np.pi * (0.55 * moving + 0.02 * np.sin(0.9 * moving))
    way = (0.16 + 0.03 * np.sin(0.7 * moving)) * np.sin(phase)
    way = way + 0.002 * np.sin(2 * np.pi * 8 * t)
    hand = np.stack([0.8 * way + 0.05, 0.6 * way - 0.02, -0.15 + 0.01 * np.cos(phase)], 1)
    along = np.where(rests, 0.0, 0.9 * np.cos(phase) + 0.05)
    velocity = np.stack([0.8 * along, 0.6 * along, np.where(rests, 0, 0.02 * np.sin(3 * t))], 1)
    place = np.arange(5) - 2.0
    tips = hand[:, None, :] + place[:, None] * np.array([0.01, 0.0, -0.005])
    tip_velocity = velocity[:, None, :] * (1 + 0.01 * place)[:, None]
    force = -(3 + 0.2 * np.arange(5))[:, None] * tip_velocity + np.array([0.0, 0.0, 0.1])
    zero = np.zeros_like(phase)
    end = hand + np.stack([-0.135 + 0.01 * np.sin(phase), zero + 0.02, zero], 1)
    joint = np.arange(22)
    angle = (0.1 * joint + 0.2 * np.sin(phase[:, None] + 0.1 * joint)).astype(np.float32)
    torque = (0.05 * joint * np.cos(phase)[:, None]).astype(np.float32)
    there = (tick < 11000) | (tick >= 11100)
    return [a[there] for a in (tick, tips, tip_velocity, force, end, angle, torque)]


def turning_points(way):
    high, _ = signal.find_peaks(way, prominence=HYSTERESIS_M)
    low, _ = signal.find_peaks(-way, prominence=HYSTERESIS_M)
    return np.sort(np.concatenate([high, low]))


def long_rests(speed):
    """Seconds of rest at each tick, of rests that are long enough to be a pause."""
    at_rest = np.concatenate([[0], (speed < REST_M_PER_S).astype(int), [0]])
    edges = np.flatnonzero(np.diff(at_rest))
    counted = np.zeros(len(speed))
    for first, end in zip(edges[::2], edges[1::2]):
        if end - first >= round(PAUSE_S / PERIOD_S):
            counted[first:end] = PERIOD_S
    return counted


def crossing(way, middle, first, last):
    """Fractional place at which way passes the middle, walking from first to last."""
    step = 1 if last > first else -1
    places = np.arange(first, last + step, step)
    off = way[places] - middle
    at = np.flatnonzero(np.diff(np.signbit(off)))[0]
    return places[at] + step * off[at] / (off[at] - off[at + 1])


def main():
    tick, tips, tip_velocity, force, end, angle, torque = recording()
    hand, velocity = tips.mean(1), tip_velocity.mean(1)
    speed = np.linalg.norm(velocity, axis=1)
    opposing = -(force.sum(1) * velocity).sum(1) / np.where(speed > 0, speed, 1)
    power = -(force * tip_velocity).sum((1, 2))
    distance = np.linalg.norm(tips - end[:, None, :], axis=2)
    way = hand[:, :2] @ UNIT
    channels = np.concatenate(
        [(velocity[:, :2] @ UNIT)[:, None], hand[:, 2:], opposing[:, None], distance, angle,
         torque], 1)

    strokes, curves, turns = [], [], []
    used = tick >= RAMP_TICKS
    for stretch in (used & (tick < 11000), used & (tick >= 11100)):
        w, v, p, c = way[stretch], speed[stretch], power[stretch], channels[stretch]
        rest = long_rests(v)
        turn = turning_points(w)
        halves = list(zip(turn[:-1], turn[1:]))
        for (a, b), (_, d) in zip(halves[::2], halves[1::2]):
            # A tick on a turning point belongs to the half that it ends.
            inside = slice(a + 1, d + 1)
            strokes.append([0.5 * (abs(w[b] - w[a]) + abs(w[d] - w[b])), v[inside].max(),
                            v[inside].sum() * PERIOD_S, (d - a) * PERIOD_S, rest[inside].sum(),
                            p[inside].sum() * PERIOD_S])
        for before, forward, after in zip(halves, halves[1:], halves[2:]):
            if w[forward[1]] < w[forward[0]]:
                continue
            if any(rest[x + 1:y + 1].sum() > 0 for x, y in (before, forward, after)):
                continue
            middle = 0.5 * (w[forward[0]] + w[forward[1]])
            first = crossing(w, middle, forward[0], before[0])
            last = crossing(w, middle, forward[1], after[1])
            time = first + (last - first) * np.linspace(0, 1, 101)
            curves.append(np.stack([np.interp(time, np.arange(len(w)), c[:, i])
                                    for i in range(c.shape[1])], 1))
            turns.append(100 * (np.array(forward) - first) / (last - first))
    strokes, curves = np.array(strokes), np.array(curves)
    mean, sd = curves.mean(0), curves.std(0, ddof=1)
    names = ["forward_velocity_m_per_s", "height_m", "opposing_force_n", "tip_distance_m.2",
             "joint_position_rad.0", "joint_position_rad.9", "joint_torque_n_m.21"]
    places = [0, 1, 2, 3 + 2, 8, 8 + 9, 8 + 22 + 21]
    commanded = DAMPING_N_S_PER_M * speed[used]
    json.dump({
        "versions": {"python": sys.version.split()[0], "numpy": np.__version__,
                     "scipy": scipy.__version__},
        "num_strokes": len(strokes),
        "stroke_width_m": strokes[:, 0].mean(),
        "max_speed_m_per_s": strokes[:, 1].mean(),
        "mean_speed_m_per_s": strokes[:, 2].sum() / strokes[:, 3].sum(),
        "stroke_duration_s": strokes[:, 3].mean(),
        "pause_s": strokes[:, 4].mean(),
        "stroke_energy_j": strokes[:, 5].mean(),
        "mean_height_m": hand[used, 2].mean(),
        "delivered_n": opposing[used].mean(),
        "commanded_n": commanded.mean(),
        "delivered_damping_n_s_per_m": opposing[used].sum() / speed[used].sum(),
        "delivered_ratio": opposing[used].sum() / commanded.sum(),
        "num_curves": len(curves),
        "turn_forward_percent": np.mean(turns, 0)[0],
        "turn_back_percent": np.mean(turns, 0)[1],
        "points_percent": POINTS,
        "curves": {name: {"mean": mean[POINTS, i].tolist(), "sd": sd[POINTS, i].tolist()}
                   for name, i in zip(names, places)},
    }, sys.stdout, indent=1)
    print()


main()
