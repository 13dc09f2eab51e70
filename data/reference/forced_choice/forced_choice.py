"""Writes forced_choice.json: psychometric functions between other ends than 0 and 1, with SciPy.

Independent of the C++: likelihoods of SciPy's distributions in (ln ln(1 + w), pse, lapse), minimised
by Nelder and Mead's simplex from many starts; intervals by Brent's method on the profile; standard
errors by differences of the log-likelihood. Not run by the tests, which read the JSON:

    /usr/bin/python3 data/reference/forced_choice/forced_choice.py > data/reference/forced_choice/forced_choice.json
"""

import itertools
import json
import math

import numpy as np
import scipy
from scipy import optimize, special, stats

DROP = stats.chi2.ppf(0.95, 1) / 2
JND = stats.norm.cdf(1.0)

# The demonstration data of psignifit (Wichmann and Hill 2001): two alternatives.
PSIGNIFIT = [(0.001, 45, 90), (0.0015, 50, 90), (0.002, 44, 90), (0.0025, 44, 90), (0.003, 52, 90),
             (0.0035, 53, 90), (0.004, 62, 90), (0.0045, 64, 90), (0.005, 76, 90), (0.006, 79, 90),
             (0.007, 88, 90), (0.008, 90, 90), (0.01, 90, 90)]


def sigmoid(family, x, w, pse):
    """F: 0.5 at the pse, Phi(1) at pse (1 + w)."""
    with np.errstate(divide="ignore"):
        if family == "gauss":
            return stats.norm.cdf((x - pse) / (w * pse))
        if family == "weibull":
            shape = math.log(-math.log(1 - JND) / math.log(2)) / math.log1p(w)
            return -np.expm1(-math.log(2) * (x / pse) ** shape)
        return stats.norm.cdf(np.log(x / pse) / math.log1p(w))


class Model:
    """Minus the log-likelihood over the free ones of spread, pse and lapse."""

    def __init__(self, case):
        self.case = case
        self.x, self.k, self.n = np.array(case["data"], float).T
        self.names = ["w"] + ["pse"] * case["free_pse"] + ["lapse"] * case["free_lapse"]
        share = 2 if case["symmetric_lapse"] else 1
        self.limit = (1 - case["guess_rate"]) / share

    def full(self, free):
        values = {"pse": self.case["reference"], "lapse": self.case["lapse_rate"], **free}
        return values["w"], values["pse"], values["lapse"]

    def probability(self, w, pse, lapse):
        guess = self.case["guess_rate"]
        low = guess + lapse if self.case["symmetric_lapse"] else guess
        return low + (1 - lapse - low) * sigmoid(self.case["family"], self.x, w, pse)

    def cost(self, w, pse, lapse):
        if not (0 <= lapse < self.limit and w > 0 and pse > 0 and math.isfinite(w)):
            return math.inf
        with np.errstate(all="ignore"):
            p = self.probability(w, pse, lapse)
            value = -(special.xlogy(self.k, p) + special.xlog1py(self.n - self.k, -p)).sum()
        return value if math.isfinite(value) else math.inf

    def minimum(self, held, near=None):
        """Over what is free and not held: (values, cost)."""
        moving = [name for name in self.names if name not in held]
        # Coordinates without bounds, but for the lapse, which an infinite cost keeps within.
        encode = {"w": lambda w: math.log(math.log1p(w)), "pse": math.log, "lapse": lambda v: v}
        decode = {"w": lambda v: math.expm1(math.exp(min(v, 6.0))), "pse": math.exp, "lapse": lambda v: v}

        def cost(at):
            return self.cost(*self.full({**held, **{m: decode[m](v) for m, v in zip(moving, at)}}))

        if not moving:
            return dict(held), cost([])
        positive = self.x[self.x > 0]
        choices = {"w": [0.05, 0.2, 0.6, 2.0], "pse": list(np.quantile(positive, [0.1, 0.35, 0.6, 0.85])),
                   "lapse": [0.005, 0.04]}
        starts = [dict(zip(moving, one)) for one in itertools.product(*(choices[m] for m in moving))]
        if near:
            starts = [near] + starts[:: max(1, len(starts) // 4)]
        options = {"xatol": 1e-11, "fatol": 1e-14, "maxiter": 6000, "maxfev": 6000}
        rough = {"xatol": 1e-3, "fatol": 1e-4, "maxiter": 400, "maxfev": 400}
        found = []
        for start in starts:
            first = np.array([encode[m](start[m]) for m in moving])
            found.append(optimize.minimize(cost, first, method="Nelder-Mead", options=rough))
        best = min(found, key=lambda one: one.fun)
        for _ in range(3):  # A simplex can fold up: unfold it.
            again = optimize.minimize(cost, best.x, method="Nelder-Mead", options=options)
            best = again if again.fun <= best.fun else best
        values = {m: decode[m](v) for m, v in zip(moving, best.x)}
        if "lapse" in moving and held.get("lapse") is None:
            on_bound, there = self.minimum({**held, "lapse": 0.0}, {m: values[m] for m in moving if m != "lapse"})
            if there <= best.fun + 1e-12:
                return on_bound, there
        return {**held, **values}, best.fun

    def interval(self, name, best, least):
        def end(direction):
            log_best, step = math.log(best[name]), 0.02
            near = {m: v for m, v in best.items() if m != name}

            def excess(distance):
                return self.minimum({name: math.exp(log_best + direction * distance)}, near)[1] - least - DROP

            inside = 0.0
            while inside < 4:
                if excess(inside + step) >= 0:
                    return math.exp(log_best + direction * optimize.brentq(excess, inside, inside + step, xtol=1e-10))
                inside, step = inside + step, 1.5 * step
            return None

        return [end(-1), end(1)]

    def standard_error(self, best):
        """Of w: from the second differences of the cost in what is free and not on a bound."""
        names = [m for m in self.names if not (m == "lapse" and best[m] == 0)]
        at = np.array([best[m] for m in names])
        steps = 2e-4 * at

        def cost(point):
            return self.cost(*self.full({**best, **dict(zip(names, point))}))

        size = len(names)
        hessian = np.zeros((size, size))
        for i, j in itertools.product(range(size), repeat=2):
            a, b = np.eye(size)[i] * steps, np.eye(size)[j] * steps
            hessian[i, j] = (cost(at + a + b) - cost(at + a - b) - cost(at - a + b) + cost(at - a - b)) / (
                4 * steps[i] * steps[j])
        return math.sqrt(np.linalg.inv(hessian)[0, 0])


def solved(case):
    model = Model(case)
    best, least = model.minimum({})
    w, pse, lapse = model.full(best)
    saturated = (special.xlogy(model.k, model.k / model.n) + special.xlog1py(model.n - model.k, -model.k / model.n)).sum()
    case["expected"] = {
        "weber_fraction": w, "pse": pse, "lapse_rate": lapse,
        "log_likelihood": -least, "deviance": 2 * (saturated + least),
        "standard_error": model.standard_error(best),
        "weber_fraction_ci95": model.interval("w", best, least),
        "pse_ci95": model.interval("pse", best, least) if case["free_pse"] else None,
    }
    return case


def case(name, data, **how):
    plain = {"family": "weber", "reference": 1.0, "guess_rate": 0.0, "lapse_rate": 0.0, "symmetric_lapse": False,
             "free_pse": True, "free_lapse": False}
    return {"name": name, **plain, **how, "data": [list(row) for row in data]}


def staircase(random, num_trials, guess, start=2.2, step=1.15):
    """Two right answers down, one wrong up: counts by level."""
    level, run, counts = 0, 0, {}
    for _ in range(num_trials):
        x = start * step**level
        right = random.random() < guess + (1 - guess) * sigmoid("weber", np.array([x]), 0.5, 1.0)[0]
        count = counts.setdefault(level, [0, 0])
        count[0] += bool(right)
        count[1] += 1
        run = run + 1 if right else 0
        if not right:
            level += 1
        elif run == 2:
            level, run = level - 1, 0
    return [(round(start * step**at, 4), *counts[at]) for at in sorted(counts)]


def drawn(random, intensities, num_trials, probability):
    return [(x, int(random.binomial(num_trials, probability(x))), num_trials) for x in intensities]


def main():
    random = np.random.default_rng(18)
    stairs = staircase(random, 160, 0.5)
    curve = lambda low, high, w, pse: (lambda x: low + (high - low) * stats.norm.cdf(math.log(x / pse) / math.log1p(w)))
    three = drawn(random, [0.4, 0.6, 0.8, 1.0, 1.3, 1.7, 2.2], 40, curve(1 / 3, 0.97, 0.5, 1.0))
    four = [(0.0, 9, 40)] + drawn(random, [0.5, 0.8, 1.2, 1.8, 2.7], 40, curve(0.25, 0.95, 0.6, 1.1))
    yes_no = drawn(random, [0.5, 0.7, 0.9, 1.1, 1.4, 2.0], 40, curve(0.04, 0.96, 0.3, 1.0))
    cases = [
        case("psignifit's demonstration", PSIGNIFIT, reference=0.004, guess_rate=0.5),
        case("psignifit's demonstration, lapses known", PSIGNIFIT, reference=0.004, guess_rate=0.5, lapse_rate=0.01),
        case("psignifit's demonstration, lapses free", PSIGNIFIT, reference=0.004, guess_rate=0.5, free_lapse=True),
        case("psignifit's demonstration, Weibull", PSIGNIFIT, reference=0.004, guess_rate=0.5, family="weibull"),
        case("psignifit's demonstration, normal", PSIGNIFIT, reference=0.004, guess_rate=0.5, family="gauss",
             free_lapse=True),
        case("psignifit's demonstration as yes and no", PSIGNIFIT, reference=0.004),
        case("staircase of two alternatives", stairs, guess_rate=0.5),
        case("staircase of two alternatives, pse known", stairs, guess_rate=0.5, free_pse=False),
        case("staircase of two alternatives as yes and no", stairs),
        case("three alternatives, lapses known", three, guess_rate=1 / 3, lapse_rate=0.03),
        case("three alternatives, lapses free", three, guess_rate=1 / 3, free_lapse=True),
        case("three alternatives, pse known, lapses free", three, guess_rate=1 / 3, free_lapse=True, free_pse=False),
        case("three alternatives, lapses at both ends", three, guess_rate=1 / 3, free_lapse=True, symmetric_lapse=True),
        case("four alternatives, with intensity 0", four, guess_rate=0.25, free_lapse=True),
        case("yes and no, lapses known at both ends", yes_no, lapse_rate=0.04, symmetric_lapse=True),
        case("yes and no, lapses known at the upper end", yes_no, lapse_rate=0.04),
        case("yes and no, lapses free at the upper end", yes_no, free_lapse=True),
        case("yes and no, pse known, lapses free at the upper end", yes_no, free_lapse=True, free_pse=False),
    ]
    document = {"generated_by": "data/reference/forced_choice/forced_choice.py",
                "versions": {"scipy": scipy.__version__, "numpy": np.__version__},
                "cases": [solved(one) for one in cases]}
    print(json.dumps(document, indent=1))


main()
