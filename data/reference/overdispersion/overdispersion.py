"""Writes overdispersion.json: psychometric functions of answers that scatter more than independent
ones, and posteriors at the edges of their priors, with SciPy.

Independent of the C++. Scaled: the binomial curve by a simplex, its variances times Pearson's
chi-squared over the degrees of freedom, its profile by F. Beta-binomial: SciPy's distribution, by a
simplex from several starts. Posteriors: sums over a fine grid. Not run by the tests, which read the JSON:

    /usr/bin/python3 data/reference/overdispersion/overdispersion.py > data/reference/overdispersion/overdispersion.json
"""

import json
import math

import numpy as np
import scipy
from scipy import optimize, special, stats

PSIGNIFIT_LIKE = [(0.001, 45, 90), (0.0015, 58, 90), (0.002, 38, 90), (0.003, 52, 90), (0.0035, 66, 90),
                  (0.004, 58, 90), (0.005, 80, 90), (0.006, 71, 90), (0.008, 90, 90), (0.01, 84, 90)]
SCATTERED = [(0.5, 2, 40), (0.65, 15, 40), (0.8, 9, 40), (1.0, 25, 40), (1.25, 19, 40), (1.6, 37, 40), (2.2, 34, 40)]
CALM = [(0.5, 4, 40), (0.7, 9, 40), (0.9, 17, 40), (1.1, 24, 40), (1.5, 31, 40), (2.0, 37, 40)]
# Three sessions a level: the levels' sums lie on a curve, the sessions do not.
SESSIONS = [(0.5, 0, 20), (0.5, 2, 20), (0.5, 7, 20), (0.8, 3, 20), (0.8, 6, 20), (0.8, 14, 20),
            (1.25, 19, 20), (1.25, 14, 20), (1.25, 8, 20), (2.0, 20, 20), (2.0, 18, 20), (2.0, 15, 20)]
OPTIONS = {"xatol": 1e-11, "fatol": 1e-13, "maxiter": 8000, "maxfev": 8000}


def curve(data, guess, w, pse):
    return guess + (1 - guess) * stats.norm.cdf(np.log(data[:, 0] / pse) / math.log1p(w))


def binomial_cost(data, guess, w, pse):
    p = curve(data, guess, w, pse)
    return -(special.xlogy(data[:, 1], p) + special.xlog1py(data[:, 2] - data[:, 1], -p)).sum()


def scattered_cost(data, guess, w, pse, rho):
    """By factors, which do not cancel near rho = 0; without binomial coefficients."""
    p = curve(data, guess, w, pse)
    value = 0.0
    for f, (_, k, n) in zip(p, data):
        k, n = int(k), int(n)
        j = np.arange(n)
        value -= np.log(f * (1 - rho) + j[:k] * rho).sum() + np.log((1 - f) * (1 - rho) + j[: n - k] * rho).sum()
        value += np.log(1 - rho + j * rho).sum()
    return value


def lowest(cost, starts):
    found = [optimize.minimize(cost, start, method="Nelder-Mead", options={**OPTIONS, "xatol": 1e-4, "fatol": 1e-6})
             for start in starts]
    best = min(found, key=lambda one: one.fun)
    for _ in range(3):
        again = optimize.minimize(cost, best.x, method="Nelder-Mead", options=OPTIONS)
        best = again if again.fun <= best.fun else best
    return best.x, best.fun


def ends(profile, at, least, drop):
    """Where the profile over ln of a value crosses."""
    def end(direction):
        inside, step = 0.0, 0.02
        while inside < 4:
            def excess(distance):
                return profile(math.exp(math.log(at) + direction * distance)) - least - drop
            if excess(inside + step) >= 0:
                return math.exp(math.log(at) + direction * optimize.brentq(excess, inside, inside + step, xtol=1e-10))
            inside, step = inside + step, 1.5 * step
        return None
    return [end(-1), end(1)]


def finite(cost):
    def guarded(*arguments):
        with np.errstate(all="ignore"):
            value = cost(*arguments)
        return value if math.isfinite(value) else 1e12
    return guarded


def scaled(name, rows, guess):
    data = np.array(rows, float)
    cost = finite(lambda w, pse: binomial_cost(data, guess, w, pse) if w > 0 and pse > 0 else math.inf)
    middle = float(np.median(data[:, 0]))
    starts = [[math.log(w), math.log(middle * f)] for w in (0.2, 0.8) for f in (0.8, 1.3)]
    at, least = lowest(lambda x: cost(math.exp(x[0]), math.exp(x[1])), starts)
    w, pse = math.exp(at[0]), math.exp(at[1])
    p = curve(data, guess, w, pse)
    degrees = len(data) - 2
    pearson = ((data[:, 1] - data[:, 2] * p) ** 2 / (data[:, 2] * p * (1 - p))).sum()
    factor = max(1.0, pearson / degrees)
    drop = factor * stats.f.ppf(0.95, 1, degrees) / 2
    of_w = lambda held: lowest(lambda x: cost(held, math.exp(x[0])), [[math.log(pse * f)] for f in (0.7, 1, 1.4)])[1]
    of_pse = lambda held: lowest(lambda x: cost(math.exp(x[0]), held), [[math.log(w * f)] for f in (0.4, 1, 2.5)])[1]
    return {"name": name, "model": "scaled", "guess_rate": guess, "data": rows,
            "expected": {"weber_fraction": w, "pse": pse, "factor": factor,
                         "weber_fraction_ci95": ends(of_w, w, least, drop), "pse_ci95": ends(of_pse, pse, least, drop)}}


def beta_binomial(name, rows, guess):
    data = np.array(rows, float)

    def bounded(w, pse, rho):
        return scattered_cost(data, guess, w, pse, rho) if w > 0 and pse > 0 and 0 <= rho < 1 else math.inf

    cost = finite(bounded)
    middle = float(np.median(data[:, 0]))
    starts = [[math.log(v), math.log(middle * f), r] for v in (0.2, 0.8) for f in (0.8, 1.3) for r in (0.01, 0.1)]
    at, least = lowest(lambda x: cost(math.exp(x[0]), math.exp(x[1]), x[2]), starts)
    w, pse, rho = math.exp(at[0]), math.exp(at[1]), at[2]
    on_bound, there = lowest(lambda x: cost(math.exp(x[0]), math.exp(x[1]), 0.0), [at[:2]])
    if there <= least + 1e-9:
        w, pse, rho, least = math.exp(on_bound[0]), math.exp(on_bound[1]), 0.0, there
    # Over the correlation from inside and on its bound.
    def of_w(held):
        inside = lowest(lambda x: cost(held, math.exp(x[0]), x[1]), [[math.log(pse * f), r] for f in (0.8, 1.2) for r in (0.01, 0.1)])[1]
        return min(inside, lowest(lambda x: cost(held, math.exp(x[0]), 0.0), [[math.log(pse)]])[1])

    def of_pse(held):
        inside = lowest(lambda x: cost(math.exp(x[0]), held, x[1]), [[math.log(w * f), r] for f in (0.5, 1, 2) for r in (0.01, 0.1)])[1]
        return min(inside, lowest(lambda x: cost(math.exp(x[0]), held, 0.0), [[math.log(w)]])[1])

    drop = stats.chi2.ppf(0.95, 1) / 2
    return {"name": name, "model": "beta-binomial", "guess_rate": guess, "data": rows,
            "expected": {"weber_fraction": w, "pse": pse, "correlation": rho, "log_likelihood": -least,
                         "weber_fraction_ci95": ends(of_w, w, least, drop), "pse_ci95": ends(of_pse, pse, least, drop)}}


def posterior(name, rows, guess, opens):
    """Weber curve, free pse. Priors: ln spread from a quarter of the smallest step between the logarithms of the
    levels to four times their range, pse within the range and half of it to either side. `opens`: what an end
    of the prior makes; checked here by priors that are half as wide again at every end."""
    data = np.array(rows, float)
    u = np.log(data[:, 0])
    reach = u[-1] - u[0]
    gap = np.diff(u).min()
    low, high = math.log(gap / 4), math.log(4 * reach)

    def quantiles(low, high, place_low, place_high, size=1201):
        spreads, places = np.linspace(low, high, size), np.linspace(place_low, place_high, size)
        log_density = np.zeros((size, size))
        z = (u[:, None] - places[None, :])
        for i, spread in enumerate(spreads):
            f = guess + (1 - guess) * special.ndtr(z / math.exp(spread))
            g = (1 - guess) * special.ndtr(-z / math.exp(spread))
            log_density[i] = (special.xlogy(data[:, 1][:, None], f) + special.xlogy((data[:, 2] - data[:, 1])[:, None], g)).sum(axis=0)
        density = np.exp(log_density - log_density.max())

        def of(marginal, at, decode):
            cells = (marginal[1:] + marginal[:-1]) / 2
            total = np.concatenate([[0], np.cumsum(cells)]) / cells.sum()
            return [float(decode(np.interp(p, total, at))) for p in (0.025, 0.5, 0.975)]

        weights = np.ones(size)
        weights[0] = weights[-1] = 0.5
        return (of(density @ weights, spreads, lambda s: math.expm1(math.exp(s))),
                of(weights @ density, places, math.exp))

    inner = quantiles(low, high, u[0] - reach / 2, u[-1] + reach / 2)
    wide = quantiles(low - (high - low) / 4, high + (high - low) / 4, u[0] - reach, u[-1] + reach)
    return {"name": name, "guess_rate": guess, "data": rows, "weber_fraction": inner[0], "pse": inner[1],
            "with_wider_priors": {"weber_fraction": wide[0], "pse": wide[1]}, "opens": opens}


def main():
    levels = [0.8, 0.9, 1.0, 1.1, 1.25]
    cases = [scaled("two alternatives, scattered", PSIGNIFIT_LIKE, 0.5), scaled("yes and no, scattered", SCATTERED, 0.0),
             scaled("yes and no, calm", CALM, 0.0), scaled("yes and no, three sessions", SESSIONS, 0.0),
             beta_binomial("two alternatives, scattered", PSIGNIFIT_LIKE, 0.5),
             beta_binomial("yes and no, scattered", SCATTERED, 0.0), beta_binomial("yes and no, calm", CALM, 0.0),
             beta_binomial("yes and no, three sessions", SESSIONS, 0.0)]
    posteriors = [posterior("every answer yes", [[x, 5, 5] for x in levels], 0.0, ["weber_fraction", "pse"]),
                  posterior("calm", CALM, 0.0, []),
                  posterior("two alternatives", [[0.5, 20, 40], [0.7, 23, 40], [0.9, 28, 40], [1.1, 33, 40], [1.5, 37, 40], [2.0, 40, 40]], 0.5, []),
                  posterior("pse beyond the levels", [[x, k, 40] for x, k in zip([1.0, 1.2, 1.5, 2.0], [1, 2, 3, 6])], 0.0,
                            ["weber_fraction", "pse"])]
    print(json.dumps({"generated_by": "data/reference/overdispersion/overdispersion.py",
                      "versions": {"scipy": scipy.__version__, "numpy": np.__version__},
                      "cases": cases, "posteriors": posteriors}, indent=1))


main()
