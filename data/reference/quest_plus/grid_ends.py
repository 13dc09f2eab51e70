"""Writes grid_ends.json: which ends of its grids a posterior of QUEST+ reaches.

Independent of the C++. Each case is a set of answers under the curve
p(x) = lapse + (1 - 2 lapse) Phi(ln(x / pse) / ln(1 + w)). Its marginals on the given grids say which ends
are reached: where they are at least as high, seen from their highest, as a normal density is at the end
of its central 95 %, or where the last value alone has 2.5 % of the probability. Beside that stands how much
of the posterior lies beyond each end on grids of the same spacing that go 20 times as far. Not run by the tests:

    /usr/bin/python3 data/reference/quest_plus/grid_ends.py > data/reference/quest_plus/grid_ends.json
"""

import json
import sys

import numpy as np
import scipy
from scipy.stats import norm

LAPSE = 0.02
WIDER = 20.0


def marginals(answers, pse, fraction):
    log_posterior = np.zeros((len(pse), len(fraction)))
    for x, num_yes, num_trials in answers:
        z = np.log(x / pse[:, None]) / np.log1p(fraction[None, :])
        p = LAPSE + (1 - 2 * LAPSE) * norm.cdf(z)
        log_posterior += num_yes * np.log(p) + (num_trials - num_yes) * np.log1p(-p)
    posterior = np.exp(log_posterior - log_posterior.max())
    posterior /= posterior.sum()
    return posterior.sum(axis=1), posterior.sum(axis=0)


def reached(weights):
    relative_height = norm.pdf(norm.ppf(0.975)) / norm.pdf(0.0)
    enough = min(0.025, relative_height * weights.max())
    return [bool(weights[0] >= enough), bool(weights[-1] >= enough)]


def wide(values):
    step = np.log(values[1] / values[0])
    more = int(np.ceil(np.log(WIDER) / step))
    return np.exp(np.log(values[0]) + step * np.arange(-more, len(values) + more)), more


def case(name, answers, pse_ends, fraction_ends, num_values=30):
    grids = [np.geomspace(*pse_ends, num_values), np.geomspace(*fraction_ends, num_values)]
    found = marginals(answers, *grids)
    wider = [wide(grid) for grid in grids]
    far = marginals(answers, *(grid for grid, _ in wider))
    return {
        "name": name, "answers": answers, "grid_values": num_values,
        "pse": list(pse_ends), "weber_fraction": list(fraction_ends),
        "reached": {"pse": reached(found[0]), "weber_fraction": reached(found[1])},
        "beyond": {n: [float(f[:more].sum()), float(f[len(f) - more:].sum())]
                   for n, f, (_, more) in zip(("pse", "weber_fraction"), far, wider)},
    }


# Whoever has the pse 10 and the Weber fraction 0.2.
AROUND_10 = [[7, 0, 10], [8, 1, 10], [9, 3, 10], [10, 5, 10], [11, 7, 10], [12, 8, 10], [14, 10, 10]]
FEW = [[7, 0, 2], [9, 1, 2], [11, 1, 2], [14, 2, 2]]
ALL_YES = [[11, 4, 4], [12, 4, 4], [14, 4, 4]]

cases = [
    case("all within", AROUND_10, (5, 20), (0.02, 2)),
    case("pse beside the grid", AROUND_10, (12, 16), (0.02, 2)),
    case("pse at the grid's end", AROUND_10, (10.6, 16), (0.02, 2)),
    case("fraction above the grid", AROUND_10, (5, 20), (0.01, 0.1)),
    case("fraction below the grid", AROUND_10, (5, 20), (0.5, 4)),
    case("a fine grid of few answers", FEW, (5, 20), (0.02, 1), 200),
    case("a coarse grid of few answers", FEW, (5, 20), (0.02, 1), 5),
    case("every answer yes", ALL_YES, (5, 20), (0.02, 2)),
]

print("{")
print('"generated_by": "data/reference/quest_plus/grid_ends.py",')
versions = {"python": sys.version.split()[0], "numpy": np.__version__, "scipy": scipy.__version__}
print(f'"versions": {json.dumps(versions)},')
print(f'"lapse_rate": {LAPSE},')
print('"cases": [\n  ' + ",\n  ".join(json.dumps(c) for c in cases) + "\n]}")
