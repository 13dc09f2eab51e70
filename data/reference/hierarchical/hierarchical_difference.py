"""Writes hierarchical_difference.json: a simulated group in two conditions, and its hierarchical fit.

Not run by the tests, which read the JSON:

    python3 data/reference/hierarchical/hierarchical_difference.py

P(yes) = l + (1 - 2 l) Phi(e^a (u - p)); a of two conditions is binormal between people, p is the
same for all in a condition, 2 l has the prior Beta(1, 20). The likelihood is integrated on a fine
even grid and maximised, with the prior. The standard error of the difference of the two a is of
the sandwich A^-1 B A^-1: A the observed information with the prior, B the sum over people of
(s - mean s) (s - mean s)^T, s the gradient of a person's own log-likelihood, all derivatives by
differences of fourth order; times sqrt(n / (n - 1)).
"""

import json
import pathlib

import numpy as np
import scipy
from scipy.optimize import minimize
from scipy.special import log_ndtr, logsumexp, ndtr
from scipy.stats import norm

HERE = pathlib.Path(__file__).parent
CONDITIONS = {
    "d": (1.853, np.array([1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883]), 0.7),
    "e": (16.06, np.array([8.0, 10.1, 11.58, 13.83, 17.505, 21.5, 26.0, 33.0]), 0.25),
}
PEOPLE, TRIALS = 9, 12
GRID = np.arange(-7.0, 7.0 + 1e-9, 0.2)
LOG_WEIGHT = norm.logpdf(GRID) + np.log(0.2)
LOG_RATIO = [np.log(levels / reference) for reference, levels, _ in CONDITIONS.values()]


def simulated():
    random = np.random.default_rng(20183)
    people = []
    for _ in range(PEOPLE):
        shared = 0.3 * random.standard_normal()
        yes = []
        for u, (_, _, w) in zip(LOG_RATIO, CONDITIONS.values()):
            slope = np.exp(-np.log(np.log1p(w)) + shared + 0.15 * random.standard_normal())
            yes.append(random.binomial(TRIALS, 0.03 + 0.94 * ndtr(slope * (u - 0.05))))
        people.append(yes)
    return people


def of_answers(a, p, lapse, u, yes):
    """Log-likelihood at each of `a`, a row, of each person, a column."""
    z = np.exp(a)[..., None] * (u - p)
    log_share = np.log1p(-2.0 * lapse)
    log_yes = np.logaddexp(np.log(lapse), log_share + log_ndtr(z))
    log_no = np.logaddexp(np.log(lapse), log_share + log_ndtr(-z))
    return log_yes @ yes.T + log_no @ (TRIALS - yes).T


def of_people(at, people):
    """Each person's log-likelihood: a0, a1, p0, p1, the spreads' root l00, l10, l11, lapse."""
    a0, a1, p0, p1, l00, l10, l11, lapse = at
    yes = np.array(people)
    first = of_answers(a0 + l00 * GRID, p0, lapse, LOG_RATIO[0], yes[:, 0])
    second = of_answers(a1 + l10 * GRID[:, None] + l11 * GRID[None, :], p1, lapse,
                        LOG_RATIO[1], yes[:, 1])
    inner = logsumexp(second + LOG_WEIGHT[None, :, None], axis=1)
    return logsumexp(first + inner + LOG_WEIGHT[:, None], axis=0)


def cost(at, people):
    if not 0.0 < at[-1] < 0.5:
        return np.inf
    return -of_people(at, people).sum() - 19.0 * np.log1p(-2.0 * at[-1])


def gradient(function, at, step):
    """By each parameter, a row."""
    weights = {-2: 1 / 12, -1: -8 / 12, 1: 8 / 12, 2: -1 / 12}
    return np.array([
        sum(w * function(at + k * step[i] * unit) for k, w in weights.items()) / step[i]
        for i, unit in enumerate(np.eye(len(at)))])


def main():
    people = simulated()
    function = lambda at: cost(at, people)
    start = [0.6, 1.5, 0.05, 0.05, 0.3, 0.25, 0.15, 0.03]
    at = minimize(function, start, method="Nelder-Mead",
                  options={"xatol": 1e-7, "fatol": 1e-10, "maxiter": 20000, "maxfev": 20000}).x
    step = np.array([2e-3, 2e-3, 1e-3, 1e-3, 2e-3, 2e-3, 2e-3, 3e-4])
    information = lambda: gradient(lambda x: gradient(function, x, step), at, step)
    for _ in range(20):
        move = -np.linalg.solve(information(), gradient(function, at, step))
        at = at + move
        if np.max(np.abs(move)) < 1e-11:
            break
    covariance = np.linalg.inv(information())
    scores = gradient(lambda x: of_people(x, people), at, step)
    influence = covariance @ (scores - scores.mean(axis=1, keepdims=True))
    contrast = np.array([1.0, -1.0, 0, 0, 0, 0, 0, 0])
    grown = np.sqrt(PEOPLE / (PEOPLE - 1.0))
    document = {
        "generated_by": "data/reference/hierarchical/hierarchical_difference.py",
        "versions": {"numpy": np.__version__, "scipy": scipy.__version__},
        "references": {name: one[0] for name, one in CONDITIONS.items()},
        "rows": [[f"P{person + 1:02d}", name, level, int(num_yes), TRIALS]
                 for person, yes in enumerate(people)
                 for (name, one), counts in zip(CONDITIONS.items(), yes)
                 for level, num_yes in zip(one[1], counts)],
        "expected": {
            "slopes": list(at[:2]), "places": list(at[2:4]),
            "slope_sds": [abs(at[4]), float(np.hypot(at[5], at[6]))], "lapse_rate": at[7],
            "slope_standard_errors": list(np.sqrt(np.diag(covariance))[:2]),
            "difference": at[0] - at[1],
            "difference_standard_error": grown * np.linalg.norm(contrast @ influence),
            "difference_standard_error_of_information":
                grown * np.sqrt(contrast @ covariance @ contrast),
        },
    }
    (HERE / "hierarchical_difference.json").write_text(json.dumps(document, indent=1) + "\n")
    print(document["expected"], np.max(np.abs(move)), scores.sum(axis=1))


main()
