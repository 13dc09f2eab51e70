"""Writes hierarchical_lapses.json: a simulated group with lapses and its hierarchical fit.

Not run by the tests, which read the JSON:

    python3 data/reference/hierarchical/hierarchical_lapses.py

P(yes) = l + (1 - 2 l) Phi(e^a (u - p)), a normal between people; 2 l has the prior Beta(1, 20).
The likelihood is integrated on a fine even grid and maximised, with the prior, over (a, p, sd, l)
themselves; standard errors are of the observed information by fourth-order differences.
"""

import json
import pathlib

import numpy as np
import scipy
from scipy.optimize import minimize
from scipy.special import log_ndtr, logsumexp, ndtr
from scipy.stats import norm

HERE = pathlib.Path(__file__).parent
REFERENCE = 16.06
LEVELS = np.array([8.0, 10.1, 11.58, 13.83, 17.505, 21.5, 26.0, 33.0])
TRIALS = 20
GRID = np.arange(-7.0, 7.0 + 1e-9, 0.1)
LOG_WEIGHT = norm.logpdf(GRID) + np.log(0.1)


def simulated():
    random = np.random.default_rng(20182)
    u = np.log(LEVELS / REFERENCE)
    people = []
    for _ in range(9):
        slope = np.exp(-np.log(np.log1p(0.25)) + 0.35 * random.standard_normal())
        yes = 0.04 + 0.92 * ndtr(slope * (u - 0.05))
        people.append(random.binomial(TRIALS, yes))
    return u, people


def cost(at, u, people):
    a, p, sd, lapse = at
    if not 0.0 < lapse < 0.5:
        return np.inf
    z = np.exp(a + sd * GRID)[:, None] * (u - p)[None, :]
    log_share = np.log1p(-2.0 * lapse)
    log_yes = np.logaddexp(np.log(lapse), log_share + log_ndtr(z))
    log_no = np.logaddexp(np.log(lapse), log_share + log_ndtr(-z))
    log_likelihood = sum(
        logsumexp(log_yes @ yes + log_no @ (TRIALS - yes) + LOG_WEIGHT) for yes in people)
    return -log_likelihood - 19.0 * log_share


def derivatives(function, at, step):
    """Gradient and Hessian by central differences of fourth order."""
    weights = {-2: 1 / 12, -1: -8 / 12, 1: 8 / 12, 2: -1 / 12}
    unit = np.diag(step)

    def gradient(x):
        return np.array([
            sum(w * function(x + k * unit[i]) for k, w in weights.items()) / step[i]
            for i in range(len(x))])

    hessian = np.array([
        sum(w * gradient(at + k * unit[i]) for k, w in weights.items()) / step[i]
        for i in range(len(at))])
    return gradient(at), 0.5 * (hessian + hessian.T)


def main():
    u, people = simulated()
    function = lambda at: cost(at, u, people)
    at = minimize(function, [1.4, 0.05, 0.3, 0.03], method="Nelder-Mead",
                  options={"xatol": 1e-9, "fatol": 1e-12, "maxiter": 20000}).x
    step = np.array([2e-3, 1e-3, 2e-3, 3e-4])
    for _ in range(20):
        gradient, hessian = derivatives(function, at, step)
        move = -np.linalg.solve(hessian, gradient)
        at = at + move
        if np.max(np.abs(move)) < 1e-11:
            break
    error = np.sqrt(np.diag(np.linalg.inv(derivatives(function, at, step)[1])))
    document = {
        "generated_by": "data/reference/hierarchical/hierarchical_lapses.py",
        "versions": {"numpy": np.__version__, "scipy": scipy.__version__},
        "reference": REFERENCE,
        "rows": [[f"P{person + 1:02d}", level, int(num_yes), TRIALS]
                 for person, yes in enumerate(people) for level, num_yes in zip(LEVELS, yes)],
        "expected": {
            "slope": at[0], "slope_standard_error": error[0],
            "place": at[1], "place_standard_error": error[1],
            "slope_sd": abs(at[2]), "lapse_rate": at[3],
            "log_likelihood": -function(at) - 19.0 * np.log1p(-2.0 * at[3]),
        },
    }
    (HERE / "hierarchical_lapses.json").write_text(json.dumps(document, indent=1) + "\n")
    print(document["expected"])


main()
