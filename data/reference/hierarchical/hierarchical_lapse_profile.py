"""Writes hierarchical_lapse_profile.json: what answers leave open of a lapse rate, and its effect.

Not run by the tests, which read the JSON:

    python3 data/reference/hierarchical/hierarchical_lapse_profile.py

P(yes) = l + (1 - 2 l) Phi(e^a (u - p)), or of a forced choice with the guess rate g
P(right) = g + (1 - g - l) Phi(e^a (u - p)), a normal between people. The share of random answers,
2 l or l / (1 - g), has the prior Beta(1, 20). The likelihood is integrated on a fine even grid.
An interval of l ends where the log-likelihood, largest over a, p and sd at each l, has fallen by
half the 95 % quantile of chi-squared (1). That of the Weber fraction is the union of
e^-(a +- t sqrt(n / (n - 1)) se) over the lapse rates of the interval with the prior, se of the
observed information in (a, p, sd) at each: its ends are at those of the lapse rate's, or at the
most likely one with se of (a, p, sd, angle), whose l is sin(angle)^2 times its limit.
"""

import json
import pathlib

import numpy as np
import scipy
from scipy.optimize import brentq, minimize, minimize_scalar
from scipy.special import log_ndtr, logsumexp, ndtr
from scipy.stats import chi2, norm, t

HERE = pathlib.Path(__file__).parent
GRID = np.arange(-7.0, 7.0 + 1e-9, 0.1)
LOG_WEIGHT = norm.logpdf(GRID) + np.log(0.1)
FALL = 0.5 * chi2.ppf(0.95, 1)


class Group:
    def __init__(self, seed, reference, levels, trials, people, w, lapse, guess=0.0):
        random = np.random.default_rng(seed)
        self.reference, self.levels, self.trials, self.guess = reference, levels, trials, guess
        self.u = np.log(np.array(levels) / reference)
        self.limit = 1.0 - guess if guess > 0.0 else 0.5
        self.people = []
        for _ in range(people):
            slope = np.exp(-np.log(np.log1p(w)) + 0.3 * random.standard_normal())
            low = guess if guess > 0.0 else lapse
            yes = low + (1.0 - low - lapse) * ndtr(slope * (self.u - 0.05))
            self.people.append(random.binomial(trials, yes))
        self.yes = np.array(self.people).T

    def prior(self, lapse):
        return 19.0 * np.log1p(-lapse / self.limit)

    def log_likelihood(self, a, p, sd, lapse):
        z = np.exp(a + sd * GRID)[:, None] * (self.u - p)[None, :]
        low = self.guess if self.guess > 0.0 else lapse
        log_rise = np.log1p(-low - lapse)
        with np.errstate(divide="ignore"):
            log_yes = np.logaddexp(np.log(low), log_rise + log_ndtr(z))
            log_no = np.logaddexp(np.log(lapse), log_rise + log_ndtr(-z))
        log_density = log_yes @ self.yes + log_no @ (self.trials - self.yes)
        return np.sum(logsumexp(log_density + LOG_WEIGHT[:, None], axis=0))


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


STEP = np.array([2e-3, 1e-3, 2e-3])


def polished(function, start):
    """From people who differ, and who do not: each can be a maximum of its own."""
    starts = [start, [start[0], start[1], 0.3], [start[0], start[1], 0.02]]
    at = min((minimize(function, one, method="Nelder-Mead",
                       options={"xatol": 1e-5, "fatol": 1e-9, "maxiter": 4000})
              for one in starts), key=lambda found: found.fun).x
    for _ in range(6):
        gradient, hessian = derivatives(function, at, STEP)
        move = -np.linalg.solve(hessian, gradient)
        at = at + move
        if np.max(np.abs(move)) < 1e-9:
            break
    return at, hessian


def expected(group):
    known, last = {}, [np.array([-np.log(np.log1p(0.4)), 0.05, 0.3])]

    def at(lapse):
        if lapse not in known:
            place, hessian = polished(lambda x: -group.log_likelihood(*x, lapse), last[0])
            last[0] = place
            known[lapse] = (group.log_likelihood(*place, lapse), place,
                            np.sqrt(np.linalg.inv(hessian)[0, 0]))
        return known[lapse]

    def summit(height):
        best = minimize_scalar(lambda l: -height(l), bounds=(0.0, 0.15), method="bounded",
                               options={"xatol": 1e-9}).x
        return 0.0 if height(0.0) >= height(best) else best

    def interval(height, top):
        fall = lambda l: height(top) - height(l) - FALL
        low = 0.0 if top == 0.0 or fall(0.0) <= 0.0 else brentq(fall, 0.0, top, xtol=1e-10)
        high = top + 0.02
        while fall(high) < 0.0:
            high = top + 1.5 * (high - top)
        return [low, brentq(fall, top, high, xtol=1e-10)]

    alone = lambda l: at(l)[0]
    with_prior = lambda l: at(l)[0] + group.prior(l)
    top_alone, top = summit(alone), summit(with_prior)
    ci, ci_with_prior = interval(alone, top_alone), interval(with_prior, top)
    n = len(group.people)
    reach = t.ppf(0.975, n - 1) * np.sqrt(n / (n - 1))
    ends = []
    for lapse in ci_with_prior:
        _, place, error = at(lapse)
        ends += [place[0] - reach * error, place[0] + reach * error]
    if top > 0.0:
        whole = np.append(at(top)[1], np.arcsin(np.sqrt(top / group.limit)))

        def cost(x):
            lapse = group.limit * np.sin(x[3]) ** 2
            return -group.log_likelihood(*x[:3], lapse) - group.prior(lapse)

        _, hessian = derivatives(cost, whole, np.append(STEP, 2e-3))
        error = np.sqrt(np.linalg.inv(hessian)[0, 0])
        ends += [whole[0] - reach * error, whole[0] + reach * error]
    fraction = lambda a: np.expm1(np.exp(-a))
    return {
        "lapse_rate": top, "weber_fraction": fraction(at(top)[1][0]),
        "lapse_rate_without_prior": top_alone,
        "weber_fraction_without_prior": fraction(at(top_alone)[1][0]),
        "lapse_rate_ci95": ci, "lapse_rate_with_prior_ci95": ci_with_prior,
        "weber_fraction_ci95": [fraction(max(ends)), fraction(min(ends))],
    }


def main():
    hard = [1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883]
    groups = {
        "hard levels": Group(8, 1.853, hard, 5, 13, 0.7, 0.0),
        "forced choice": Group(3, 2.0, [0.6, 1.0, 1.4, 2.0, 2.9, 4.2, 6.0, 9.0], 20, 8, 0.6, 0.02,
                               guess=0.5),
    }
    cases = []
    for name, group in groups.items():
        cases.append({
            "name": name, "reference": group.reference, "guess_rate": group.guess,
            "rows": [[f"P{person + 1:02d}", level, int(num), group.trials]
                     for person, yes in enumerate(group.people)
                     for level, num in zip(group.levels, yes)],
            "expected": expected(group),
        })
        print(name, cases[-1]["expected"], flush=True)
    document = {
        "generated_by": "data/reference/hierarchical/hierarchical_lapse_profile.py",
        "versions": {"numpy": np.__version__, "scipy": scipy.__version__},
        "cases": cases,
    }
    (HERE / "hierarchical_lapse_profile.json").write_text(json.dumps(document, indent=1) + "\n")


main()
