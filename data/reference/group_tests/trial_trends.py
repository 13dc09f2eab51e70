"""Writes trial_trends.json: do people change over the trials of a block, each in their own way?

Independent of the C++: numpy and SciPy; probit curves by scipy.optimize, the bootstrap by arrays.
z of a person: over levels the sum of the covariance of answer and running number, over its standard
deviation were every order within a level as likely. The sum of z^2 over people is compared with
that of answers drawn anew, each trial at its level, from everybody's own curve (level shares (k +
1/2) / (n + 1) for who has none), a redraw without any z being drawn again. `rate` is how often that
finds a change at 5 % in studies without one. Not run by the tests:

    /usr/bin/python3 data/reference/group_tests/trial_trends.py > data/reference/group_tests/trial_trends.json
"""

import json
import sys

import numpy as np
import scipy
from scipy import optimize, stats

random = np.random.default_rng(20261124)
REFERENCE = 10.0
LEVELS = [6.0, 7.0, 8.0, 9.0, 11.0, 13.0, 15.0, 17.0]
REPETITIONS = 5
NUM_REDRAWS = 20000


def studied(num, drifts, learnings=(0.0,), w=0.35):
    """Trials of `num` people: level, answer; drift and learning in z from first to last trial."""
    people = []
    for person in range(num):
        levels = np.concatenate([random.permutation(LEVELS) for _ in range(REPETITIONS)])
        time = np.linspace(-0.5, 0.5, len(levels))
        own = np.log1p(w) * np.exp(random.normal(0, 0.25))
        slope = (1 + learnings[person % len(learnings)] * time) / own
        place = random.normal(0, 0.1)
        z = slope * (np.log(levels / REFERENCE) - place) + drifts[person % len(drifts)] * time
        people.append((levels, (random.uniform(size=len(z)) < stats.norm.cdf(z)).astype(float)))
    return people


def squares(levels, answers):
    """z^2 of drift and of learning of every row of answers; NaN where undefined."""
    time = np.linspace(-0.5, 0.5, len(levels))
    drift = drift_variance = learning = learning_variance = 0.0
    for level in sorted(set(levels)):
        at = levels == level
        n, y, t = at.sum(), answers[:, at], time[at]
        covariance = y @ (t - t.mean())
        k = y.sum(axis=1)
        variance = (k - k**2 / n) * ((t - t.mean()) ** 2).sum() / (n - 1)
        side = np.sign(level - REFERENCE)
        drift, drift_variance = drift + covariance, drift_variance + variance
        learning = learning + side * covariance
        learning_variance = learning_variance + abs(side) * variance
    def square(covariance, variance):
        known = variance > 1e-9
        return np.where(known, covariance**2 / np.where(known, variance, 1.0), np.nan)

    return square(drift, drift_variance), square(learning, learning_variance), np.sign(drift)


def probabilities(levels, answers):
    """Of the own curve with a free pse, or the smoothed shares."""
    x = np.log(levels / REFERENCE)
    yes, no = x[answers > 0.5], x[answers < 0.5]
    overlap = len(yes) and len(no) and yes.min() < no.max() and np.mean(yes) > np.mean(no)
    if overlap:
        def loss(parameters):
            z = parameters[0] + parameters[1] * x
            return -stats.norm.logcdf(np.where(answers > 0.5, z, -z)).sum()

        fit = optimize.minimize(loss, [0.0, 3.0], method="BFGS", options={"gtol": 1e-9})
        if fit.x[1] > 0:
            return stats.norm.cdf(fit.x[0] + fit.x[1] * x)
    shares = {l: (answers[levels == l].sum() + 0.5) / ((levels == l).sum() + 1) for l in levels}
    return np.array([shares[l] for l in levels])


def redrawn(levels, p, num, defined):
    rows = random.uniform(size=(num, len(p))) < p
    found = squares(levels, rows.astype(float))
    for _ in range(1000):
        again = np.isnan(found[0]) | (np.isnan(found[1]) & defined)
        if not again.any():
            break
        rows[again] = random.uniform(size=(again.sum(), len(p))) < p
        found = squares(levels, rows.astype(float))
    return found


def tested(people, num_redraws):
    sums = [0.0, 0.0]
    counts = [0, 0]
    drawn = [np.zeros(num_redraws), np.zeros(num_redraws)]
    z = []
    for levels, answers in people:
        own = [s[0] for s in squares(levels, answers[None, :])]
        if np.isnan(own[0]):
            continue
        z.append(own[2] * np.sqrt(own[0]))
        found = redrawn(levels, probabilities(levels, answers), num_redraws, not np.isnan(own[1]))
        for i in (0, 1):
            if not np.isnan(own[i]):
                sums[i] += own[i]
                counts[i] += 1
                drawn[i] += np.nan_to_num(found[i])
    p = [(1 + np.sum(d >= s * (1 - 1e-12))) / (1 + num_redraws) for d, s in zip(drawn, sums)]
    return {
        "mean_z_p_value": float(stats.ttest_1samp(z, 0).pvalue) if len(z) > 1 else None,
        "drift": {"num_people": counts[0], "sum_squares": float(sums[0]), "p_value": float(p[0])},
        "learning": {
            "num_people": counts[1], "sum_squares": float(sums[1]), "p_value": float(p[1])
        },
    }


cases = []
for name, people in (
    ("nobody changes", studied(13, [0.0])),
    ("half drift up, half down", studied(13, [1.8, -1.8])),
    ("all drift up", studied(13, [1.2])),
    ("half learn, half tire", studied(12, [0.0], [1.9, -1.9])),
    ("steep curves, some separated", studied(13, [0.0], w=0.06)),
    ("one person", studied(1, [2.5])),
):
    cases.append({
        "name": name,
        "people": [
            {"levels": levels.tolist(), "answers": answers.astype(int).tolist()}
            for levels, answers in people
        ],
        "expected": tested(people, NUM_REDRAWS),
    })

rates = {}
for name, w in (("w = 0.35", 0.35), ("w = 0.1", 0.1), ("w = 1", 1.0)):
    found = [tested(studied(13, [0.0], w=w), 199) for _ in range(1500)]
    rates[name] = {
        kind: float(np.mean([f[kind]["p_value"] <= 0.05 for f in found]))
        for kind in ("drift", "learning")
    }

print("{")
print('"generated_by": "data/reference/group_tests/trial_trends.py",')
versions = {
    "python": sys.version.split()[0], "numpy": np.__version__, "scipy": scipy.__version__
}
print(f'"versions": {json.dumps(versions)},')
print(f'"reference": {REFERENCE}, "num_redraws": {NUM_REDRAWS},')
print(f'"rate_at_5_percent_without_a_change": {json.dumps(rates)},')
print('"cases": [\n  ' + ",\n  ".join(json.dumps(c) for c in cases) + "\n]")
print("}")
