"""Writes quest_plus.json: thirty trials of QUEST+ (Watson 2017) for each of three models.

Independent of the C++: after every trial the posterior is computed anew from the sum of log
likelihoods, and the expected entropies as Watson writes them, from the posterior after each possible
answer. Not run by the tests:

    /usr/bin/python3 data/reference/quest_plus/quest_plus.py > data/reference/quest_plus/quest_plus.json
"""

import itertools
import json
import sys

import numpy as np
import scipy
from scipy.stats import norm

random = np.random.default_rng(20260301)


def weber(x, pse, weber_fraction, lapse_rate):
    return lapse_rate + (1 - 2 * lapse_rate) * norm.cdf(np.log(x / pse) / np.log(1 + weber_fraction))


def gauss(x, threshold, slope, guess_rate, lapse_rate):
    return guess_rate + (1 - guess_rate - lapse_rate) * norm.cdf(slope * np.log(x / threshold))


def weibull(x, threshold, slope, guess_rate, lapse_rate):
    return guess_rate + (1 - guess_rate - lapse_rate) * (1 - np.exp(-((x / threshold) ** slope)))


def entropy(p):
    p = p[p > 0]
    return float(-np.sum(p * np.log2(p)))


def expected_entropy(p, yes):
    total = 0.0
    for likelihood in (yes, 1 - yes):
        joint = p * likelihood
        evidence = joint.sum()
        total += evidence * entropy(joint / evidence)
    return float(total)


def log_weights(parameter):
    values = np.array(parameter["values"])
    if "prior" not in parameter:
        return np.full(len(values), -np.log(len(values)))
    density = norm.pdf(np.log(values), np.log(parameter["prior"]["median"]), parameter["prior"]["sd_ln"])
    return np.log(density / density.sum())


def case(name, function, parameters, intensities, truth):
    names = list(parameters)
    # The first parameter in the outermost loop.
    combinations = np.array(list(itertools.product(*(parameters[n]["values"] for n in names))))
    log_prior = np.array([sum(c) for c in itertools.product(*(log_weights(parameters[n]) for n in names))])
    columns = {n: combinations[:, i] for i, n in enumerate(names)}
    tables = np.array([function(x, **columns) for x in intensities])
    with np.errstate(divide="ignore"):  # Without lapses an answer can be impossible.
        log_yes, log_no = np.log(tables), np.log(1 - tables)
    asked, trials = [], []
    for _ in range(30):
        log_posterior = log_prior + sum(log_yes[i] if yes else log_no[i] for i, yes in asked)
        p = np.exp(log_posterior - log_posterior.max())
        p /= p.sum()
        expected = np.array([expected_entropy(p, t) for t in tables])
        chosen = int(np.flatnonzero(expected <= expected.min() + 1e-10)[0])
        yes = bool(random.uniform() < function(intensities[chosen], **truth))
        marginals = {}
        for n in names:
            scale = columns[n] if n.endswith("_rate") else np.log(columns[n])
            mean = np.sum(p * scale)
            marginals[n] = {
                "mean": float(mean if n.endswith("_rate") else np.exp(mean)),
                "sd": float(np.sqrt(np.sum(p * (scale - mean) ** 2))),
            }
        trials.append({
            "entropy_bits": entropy(p), "expected_entropy_bits": [float(e) for e in expected],
            "marginals": marginals, "intensity": intensities[chosen], "yes": yes,
        })
        asked.append((chosen, yes))
    return {"name": name, "parameters": parameters, "intensities": intensities, "trials": trials}


def ratios(low, high, count):
    return [round(float(v), 6) for v in np.geomspace(low, high, count)]


cases = [
    case("weber", weber,
         {"pse": {"values": ratios(1, 4, 15), "prior": {"median": 1.9, "sd_ln": 0.3}},
          "weber_fraction": {"values": ratios(0.1, 2, 12), "prior": {"median": 0.5, "sd_ln": 0.8}},
          "lapse_rate": {"values": [0.0, 0.02, 0.05]}},
         ratios(0.7, 6, 21), {"pse": 2.1, "weber_fraction": 0.4, "lapse_rate": 0.02}),
    case("gauss", gauss,
         {"threshold": {"values": ratios(0.1, 10, 20)}, "slope": {"values": ratios(0.5, 8, 8)},
          "guess_rate": {"values": [0.5]}, "lapse_rate": {"values": [0.01, 0.03]}},
         ratios(0.1, 10, 17), {"threshold": 1.5, "slope": 2.0, "guess_rate": 0.5, "lapse_rate": 0.02}),
    case("weibull", weibull,
         {"threshold": {"values": ratios(0.1, 10, 20), "prior": {"median": 1.0, "sd_ln": 1.5}},
          "slope": {"values": ratios(0.8, 6, 6)},
          "guess_rate": {"values": [0.0, 0.1, 0.25]}, "lapse_rate": {"values": [0.02]}},
         ratios(0.1, 10, 17), {"threshold": 0.8, "slope": 3.0, "guess_rate": 0.1, "lapse_rate": 0.02}),
]

print("{")
print('"generated_by": "data/reference/quest_plus/quest_plus.py",')
versions = {"python": sys.version.split()[0], "numpy": np.__version__, "scipy": scipy.__version__}
print(f'"versions": {json.dumps(versions)},')
print('"cases": [')
for i, c in enumerate(cases):
    head = {k: v for k, v in c.items() if k != "trials"}
    print(json.dumps(head)[:-1] + ', "trials": [\n  ' + ",\n  ".join(json.dumps(t) for t in c["trials"])
          + "\n]}" + ("," if i + 1 < len(cases) else ""))
print("]}")
