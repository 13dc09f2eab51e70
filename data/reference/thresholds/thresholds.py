"""Writes thresholds.json: fits of yes-no and of same-different answers, and d', with SciPy.

Independent of the C++: likelihoods from SciPy's distributions, minimised by BFGS from many
starts and polished by a simplex; intervals by Brent's method on the profile. Not run by the tests:

    /usr/bin/python3 data/reference/thresholds/thresholds.py > data/reference/thresholds/thresholds.json
"""

import itertools
import json
import sys

import numpy as np
import scipy
from scipy import optimize, special, stats

DROP = stats.chi2.ppf(0.95, 1) / 2


def minimum(cost, starts):
    """Quasi-Newton from every start, then a simplex about the best."""
    found = [optimize.minimize(cost, start, method="BFGS", options={"gtol": 1e-9}) for start in starts]
    best = min(found, key=lambda one: one.fun)
    again = optimize.minimize(
        cost, best.x, method="Nelder-Mead",
        options={"xatol": 1e-10, "fatol": 1e-14, "maxiter": 4000, "maxfev": 4000,
                 "initial_simplex": simplex_about(best.x)},
    )
    best = again if again.fun <= best.fun else best
    return best.x, best.fun


def simplex_about(x):
    return np.vstack([x] + [x + 1e-3 * row for row in np.eye(len(x))])


def interval(cost, at, least, place, starts):
    """Ends of the likelihood-ratio interval of parameter `place`."""
    others = [i for i in range(len(at)) if i != place]

    def end(direction):
        rests = [np.array(start)[others] for start in [at] + starts]

        def excess(distance):
            def held(rest):
                full = np.array(at, float)
                full[others] = rest
                full[place] = at[place] + direction * distance
                return cost(full)

            if not others:
                return held([]) - least - DROP
            return minimum(held, rests)[1] - least - DROP

        inside, step = 0.0, 0.05
        while inside < 12:
            outside = inside + step
            if excess(outside) >= 0:
                return at[place] + direction * optimize.brentq(excess, inside, outside, xtol=1e-11)
            inside, step = outside, 1.6 * step
        return None

    return [end(-1), end(1)]


def log_likelihood(k, n, p, q):
    return float(np.sum(special.xlogy(k, np.maximum(p, 1e-300)) + special.xlogy(n - k, np.maximum(q, 1e-300))))


def detection(name, data):
    has_catch = any(x == 0 for x, _, n in data if n > 0)
    x, k, n = np.array(data, float).T
    with np.errstate(divide="ignore"):
        log_x = np.log(x)

    def cost(theta):
        mean, spread = theta[0], np.exp(theta[1])
        guess = 1 / (1 + np.exp(-theta[2])) if has_catch else 0.0
        z = (log_x - mean) / spread
        p = guess + (1 - guess) * special.ndtr(z)
        return -log_likelihood(k, n, p, (1 - guess) * special.ndtr(-z))

    levels = np.log([x for x, _, _ in data if x > 0])
    starts = [
        [m, np.log(s), g][: 3 if has_catch else 2]
        for m, s, g in itertools.product(
            np.quantile(levels, [0.25, 0.5, 0.75]), [0.15, 0.5], [-3.0, -1.0] if has_catch else [0]
        )
    ]
    at, least = minimum(cost, starts)
    steep = [[m, s, at[-1]][: len(at)] for m in levels for s in (-3.0, -1.0)]
    ends = interval(cost, at, least, 0, steep), interval(cost, at, least, 1, steep)
    exp = lambda pair: [None if end is None else float(np.exp(end)) for end in pair]
    return {
        "name": name, "data": data,
        "expected": {
            "threshold": float(np.exp(at[0])), "threshold_ci95": exp(ends[0]),
            "spread_ln": float(np.exp(at[1])), "spread_ln_ci95": exp(ends[1]),
            "false_alarm_rate": float(1 / (1 + np.exp(-at[2]))) if has_catch else 0.0,
            "log_likelihood": -least,
        },
    }


def same_different(name, reference, data):
    x, yes, n = np.array(data, float).T
    d = np.abs(np.log(x / reference))

    def parts(theta):
        return np.exp(theta[0]), np.exp(theta[1])  # s, k

    def cost(theta):
        s, k = parts(theta)
        p = special.ndtr((-k + d) / s) + special.ndtr((-k - d) / s)
        q = special.ndtr((k - d) / s) - special.ndtr((-k - d) / s)
        return -log_likelihood(yes, n, p, q)

    largest = max(d)
    starts = [
        [np.log(s * largest), np.log(k * largest)]
        for s, k in itertools.product([0.2, 0.6], [0.2, 0.6])
    ]
    at, least = minimum(cost, starts)
    s, k = parts(at)
    spread = interval(cost, at, least, 0, starts)
    criterion = interval(cost, at, least, 1, starts)
    return {
        "name": name, "reference": reference, "data": data,
        "expected": {
            "weber_fraction": float(np.expm1(s)),
            "weber_fraction_ci95":
                [None if e is None else float(np.expm1(np.exp(e))) for e in spread],
            "criterion_ln": float(k),
            "criterion_ln_ci95": [None if e is None else float(np.exp(e)) for e in criterion],
            "false_alarm_rate": float(2 * stats.norm.cdf(-k / s)),
            "log_likelihood": -least,
        },
    }


def by_order(name, reference, free_pse, data):
    """Weber curve with a pse for each order of the intervals; order -0.5: test first."""
    x, order, yes, n = np.array(data, float).T
    u = np.log(x / reference)

    def cost(theta):
        z = np.exp(theta[0]) * (u - theta[1] * order - (theta[2] if free_pse else 0.0))
        return -float(np.sum(yes * special.log_ndtr(z) + (n - yes) * special.log_ndtr(-z)))

    starts = [[np.log(s), q, 0.0][: 3 if free_pse else 2] for s in (1.0, 4.0) for q in (-0.2, 0.2)]
    at, least = minimum(cost, starts)
    slope = interval(cost, at, least, 0, starts)
    place = interval(cost, at, least, 2, starts) if free_pse else None
    return {
        "name": name, "reference": reference, "free_pse": free_pse, "data": data,
        "expected": {
            "weber_fraction": float(np.expm1(np.exp(-at[0]))),
            "weber_fraction_ci95":
                [None if e is None else float(np.expm1(np.exp(-e))) for e in reversed(slope)],
            "order_effect_ln": float(at[1]),
            "pse": float(reference * np.exp(at[2] if free_pse else 0.0)),
            "pse_ci95": None if place is None else [float(reference * np.exp(e)) for e in place],
            "log_likelihood": -least,
        },
    }


def detection_theory(hits, signals, false_alarms, catch):
    h = stats.norm.ppf((hits + 0.5) / (signals + 1))
    f = stats.norm.ppf((false_alarms + 0.5) / (catch + 1))
    return {
        "counts": [hits, signals, false_alarms, catch],
        "d_prime": float(h - f), "criterion": float(-(h + f) / 2),
    }


def geometric(values):
    logs_of = np.log(values)
    n, mean, sd = len(values), np.mean(logs_of), np.std(logs_of, ddof=1)
    reach = stats.t.ppf(0.975, n - 1) * sd / np.sqrt(n)
    return {
        "values": values, "mean": float(np.exp(mean)), "sd_ln": float(sd),
        "ci95": [float(np.exp(mean - reach)), float(np.exp(mean + reach))],
    }


json.dump(
    {
        "scipy": scipy.__version__, "numpy": np.__version__,
        "detection": [
            detection("with false alarms", [
                [0.0, 5, 40], [0.1, 4, 20], [0.2, 6, 20], [0.4, 11, 20], [0.8, 17, 20], [1.6, 20, 20],
            ]),
            detection("no catch trials", [
                [0.1, 0, 12], [0.15, 2, 12], [0.25, 5, 12], [0.4, 9, 12], [0.7, 11, 12],
            ]),
            detection("many false alarms, uneven numbers", [
                [0.0, 14, 48], [0.5, 10, 22], [0.8, 15, 28], [1.2, 23, 34], [2.0, 30, 36], [3.0, 24, 24],
            ]),
        ],
        "same_different": [
            same_different("catch trials and both sides", 8.0, [
                [8.0, 4, 40], [6.0, 9, 20], [7.0, 4, 20], [9.5, 5, 20], [11.0, 12, 20], [14.0, 19, 20],
            ]),
            same_different("above the reference alone", 2.0, [
                [2.0, 6, 30], [2.4, 7, 20], [3.0, 13, 20], [4.0, 18, 20],
            ]),
            same_different("lax criterion", 1.5, [
                [1.5, 17, 30], [1.0, 19, 20], [1.8, 12, 20], [2.4, 18, 20],
            ]),
        ],
        "by_order": [
            by_order("a bias for the first interval", 6.0, True, [
                [4.0, -0.5, 2, 10], [5.0, -0.5, 5, 10], [7.0, -0.5, 8, 10], [9.0, -0.5, 10, 10],
                [4.0, 0.5, 0, 10], [5.0, 0.5, 1, 10], [7.0, 0.5, 5, 10], [9.0, 0.5, 8, 10],
            ]),
            by_order("the same, pse at the reference", 6.0, False, [
                [4.0, -0.5, 2, 10], [5.0, -0.5, 5, 10], [7.0, -0.5, 8, 10], [9.0, -0.5, 10, 10],
                [4.0, 0.5, 0, 10], [5.0, 0.5, 1, 10], [7.0, 0.5, 5, 10], [9.0, 0.5, 8, 10],
            ]),
            by_order("uneven numbers", 1.0, True, [
                [0.7, -0.5, 3, 12], [0.9, -0.5, 4, 9], [1.2, -0.5, 7, 8],
                [0.7, 0.5, 4, 11], [0.9, 0.5, 8, 12], [1.2, 0.5, 9, 10], [1.5, 0.5, 5, 5],
            ]),
        ],
        "signal_detection": [
            detection_theory(37, 50, 4, 20), detection_theory(50, 50, 0, 20),
            detection_theory(0, 30, 7, 10),
        ],
        "geometric_mean": [
            geometric([0.21, 0.34, 0.27, 0.5, 0.19]), geometric([1.2, 0.9]),
        ],
    },
    sys.stdout, indent=1,
)
print()
