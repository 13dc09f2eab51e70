"""Writes fits_reference.json: data sets with their fits and tests, computed with SciPy.

Independent of the C++: fits run in (ln w, ln pse, lapse) by simplex and quasi-Newton from many
starts and are polished on the analytic score; intervals by Brent's method on the profile;
standard errors from a numerical Hessian in w itself. Not run by the tests, which read the JSON:

    /usr/bin/python3 data/reference/fits_reference.py > data/reference/fits_reference.json
"""

import itertools
import json
import math
import sys

import numpy as np
import scipy
from scipy import optimize, stats

DROP = stats.chi2.ppf(0.95, 1) / 2
D = [1.093, 1.237, 1.646, 1.7495, 1.853, 2.203, 2.553, 3.185, 3.883]
E = [10.100, 11.580, 13.830, 14.945, 16.060, 17.505, 18.950, 23.200, 29.335]


# --- psychometric function ---------------------------------------------------------------------


class Model:
    """Cost of theta = (ln w, ln pse, lapse), of which some are free."""

    def __init__(self, data, reference, method, free_pse, free_lapse):
        pooled = {}
        for x, k, n in data:
            if n > 0:
                old = pooled.get(x, (0, 0))
                pooled[x] = (old[0] + k, old[1] + n)
        self.x = np.array(sorted(pooled), float)
        self.k = np.array([pooled[x][0] for x in sorted(pooled)], float)
        self.n = np.array([pooled[x][1] for x in sorted(pooled)], float)
        self.reference, self.method = reference, method
        self.free = [True, free_pse, free_lapse]

    def expand(self, free_values):
        theta = [0.0, math.log(self.reference), 0.0]
        for place, value in zip(np.flatnonzero(self.free), free_values):
            theta[place] = value
        return theta

    def z(self, theta):
        with np.errstate(divide="ignore"):
            return (np.log(self.x) - theta[1]) / np.log1p(np.exp(theta[0]))

    def log_likelihood(self, theta):
        z, lapse = self.z(theta), theta[2]
        if lapse == 0.0:
            log_f, log_g = stats.norm.logcdf(z), stats.norm.logsf(z)
        else:
            log_f = np.log(lapse + (1 - 2 * lapse) * stats.norm.cdf(z))
            log_g = np.log(lapse + (1 - 2 * lapse) * stats.norm.sf(z))
        no = self.n - self.k
        return float(
            np.sum(np.where(self.k > 0, self.k * np.where(self.k > 0, log_f, 0), 0))
            + np.sum(np.where(no > 0, no * np.where(no > 0, log_g, 0), 0))
        )

    def sse(self, theta):
        f = theta[2] + (1 - 2 * theta[2]) * stats.norm.cdf(self.z(theta))
        return float(np.sum((self.k / self.n - f) ** 2))

    def cost(self, theta):
        if not 0.0 <= theta[2] < 0.5:
            return 1e9
        return -self.log_likelihood(theta) if self.method == "ml" else self.sse(theta)

    def gradient(self, theta):
        """By (ln w, ln pse, lapse), from f's own derivatives."""
        z, lapse = self.z(theta), theta[2]
        share = 1 - 2 * lapse
        density = stats.norm.pdf(z)
        finite_z = np.where(np.isfinite(z), z, 0.0)
        w = math.exp(theta[0])
        spread = math.log1p(w)
        columns = np.array([
            -share * density * finite_z / spread * w / (1 + w),
            -share * density / spread,
            1 - 2 * stats.norm.cdf(z),
        ])
        f = lapse + share * stats.norm.cdf(z)
        g = lapse + share * stats.norm.sf(z)
        if self.method == "lsq":
            return columns @ (2 * (f - self.k / self.n))
        no = self.n - self.k
        factor = np.where(self.k > 0, self.k / np.where(f > 0, f, 1), 0)
        factor = factor - np.where(no > 0, no / np.where(g > 0, g, 1), 0)
        return -(columns @ factor)

    def best(self, held, starts):
        """Minimum over the free parameters not in `held` {place: value}."""
        places = [p for p in np.flatnonzero(self.free) if p not in held]
        base = self.expand([0.0] * sum(self.free))
        base[1] = math.log(self.reference)
        for place, value in held.items():
            base[place] = value

        def full(values):
            theta = list(base)
            for place, value in zip(places, values):
                theta[place] = value
            return theta

        if not places:
            return self.cost(base), base
        found = []
        for start in starts:
            values = [start[p] for p in places]
            simplex = optimize.minimize(
                lambda v: self.cost(full(v)), values, method="Nelder-Mead",
                options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 4000, "maxfev": 8000},
            )
            found.append((simplex.fun, full(simplex.x)))
        value, theta = min(found, key=lambda pair: pair[0])
        # Polish on the score; a lapse on its bound stays there.
        moving = [p for p in places if not (p == 2 and theta[2] < 1e-7)]
        if 2 in places and 2 not in moving:
            theta = theta[:2] + [0.0]
        if moving:
            def score(values):
                at = list(theta)
                for place, v in zip(moving, values):
                    at[place] = v
                return self.gradient(at)[moving]

            solved = optimize.root(score, [theta[p] for p in moving], tol=1e-14)
            polished = list(theta)
            for place, v in zip(moving, solved.x):
                polished[place] = float(v)
            if self.cost(polished) <= value + 1e-9:
                theta = polished
        return self.cost(theta), theta

    def starts(self):
        positive = self.x[self.x > 0]
        pses = [math.log(self.reference), *np.log(np.quantile(positive, [0.2, 0.5, 0.8]))]
        widths = np.log([0.05, 0.2, 0.6, 2.0])
        lapses = [0.005, 0.05, 0.2] if self.free[2] else [0.0]
        pses = pses if self.free[1] else pses[:1]
        return [list(s) for s in itertools.product(widths, pses, lapses)]


def profile_end(model, theta, best, place, direction, drop):
    """Where the profile of one parameter rises by `drop`, or None."""
    last = list(theta)

    def excess(value):
        nonlocal last
        starts = [last]
        if model.free[2]:
            starts.append([last[0], last[1], 0.03])
        cost, at = model.best({place: value}, starts)
        last = at
        return cost - best - drop

    inside, step = theta[place], 0.02
    while abs(inside) < 650:
        outside = max(-650.0, min(650.0, inside + direction * step))
        if excess(outside) > 0:
            low, high = sorted([inside, outside])
            return math.exp(optimize.brentq(excess, low, high, xtol=1e-13, rtol=1e-13))
        inside, step = outside, step * 1.6
    return None  # Not within the range of numbers.


def hessian_in_w(model, theta):
    """Standard error of w by a fourth-order numerical Hessian in (w, pse, lapse)."""
    places = [p for p in np.flatnonzero(model.free) if not (p == 2 and theta[2] == 0.0)]
    centre = np.array([math.exp(theta[0]), math.exp(theta[1]), theta[2]])

    def cost(values):
        at = centre.copy()
        at[places] = values
        return model.cost([math.log(at[0]), math.log(at[1]), at[2]])

    start = centre[places]
    step = 2e-3 * start
    size = len(places)
    matrix = np.zeros((size, size))
    weights = {-2: 1 / 12, -1: -8 / 12, 1: 8 / 12, 2: -1 / 12}
    for i in range(size):
        for j in range(size):
            if i == j:
                second = {-3: 1 / 90, -2: -3 / 20, -1: 1.5, 0: -49 / 18, 1: 1.5, 2: -3 / 20,
                          3: 1 / 90}
                for shift, weight in second.items():
                    at = start.copy()
                    at[i] += shift * step[i]
                    matrix[i, i] += weight * cost(at) / step[i] ** 2
            else:
                for (a, wa), (b, wb) in itertools.product(weights.items(), weights.items()):
                    at = start.copy()
                    at[i] += a * step[i]
                    at[j] += b * step[j]
                    matrix[i, j] += wa * wb * cost(at) / (step[i] * step[j])
    return math.sqrt(np.linalg.inv(matrix)[0, 0])


def fit(data, reference, method="ml", free_pse=False, free_lapse=False):
    model = Model(data, reference, method, free_pse, free_lapse)
    cost, theta = model.best({}, model.starts())
    out = {"status": "ok", "weber_fraction": math.exp(theta[0]), "pse": math.exp(theta[1]),
           "lapse_rate": theta[2]}
    log_likelihood = model.log_likelihood(theta)
    if math.isfinite(log_likelihood):
        out["log_likelihood"] = log_likelihood
        k, n = model.k, model.n
        saturated = sum(stats.binom.logpmf(k, n, k / n) - (
            np.log(scipy.special.comb(n, k))))
        out["deviance"] = 2 * (float(saturated) - log_likelihood)
    drop = DROP
    if method == "lsq":
        sst = float(np.sum((model.k / model.n - np.mean(model.k / model.n)) ** 2))
        out["r_squared"] = 1 - cost / sst
        free = len(model.x) - sum(model.free)
        if free < 1:
            return out
        drop = cost / free * stats.f.ppf(0.95, 1, free)

        def curve(x, w, *rest):
            rest = list(rest)
            pse = rest.pop(0) if free_pse else reference
            lapse = rest.pop(0) if rest else 0.0
            with np.errstate(divide="ignore"):
                z = np.log(x / pse) / np.log1p(w)
            return lapse + (1 - 2 * lapse) * stats.norm.cdf(z)

        if theta[2] > 0 or not free_lapse:
            start = [math.exp(theta[0])] + [math.exp(theta[1])] * free_pse
            start += [theta[2]] * free_lapse
            _, covariance = optimize.curve_fit(
                curve, model.x, model.k / model.n, p0=start, xtol=1e-14, ftol=1e-14,
                gtol=1e-14)
            out["standard_error"] = math.sqrt(covariance[0, 0])
    else:
        out["standard_error"] = hessian_in_w(model, theta)
    out["weber_fraction_ci95"] = [profile_end(model, theta, cost, 0, -1, drop),
                                  profile_end(model, theta, cost, 0, +1, drop)]
    if free_pse:
        out["pse_ci95"] = [profile_end(model, theta, cost, 1, -1, drop),
                           profile_end(model, theta, cost, 1, +1, drop)]
    return out


def answers(levels, reference, w, trials, seed, pse=None, lapse=0.0):
    random = np.random.default_rng(seed)
    p = stats.norm.cdf(np.log(np.array(levels) / (pse or reference)) / math.log1p(w))
    p = lapse + (1 - 2 * lapse) * p
    return [[x, int(random.binomial(trials, q)), trials] for x, q in zip(levels, p)]


def weber_cases():
    cases = []

    def add(name, data, reference, expected=None, **options):
        print(name, file=sys.stderr)
        cases.append({
            "name": name, "reference": reference, "method": options.get("method", "ml"),
            "free_pse": options.get("free_pse", False),
            "free_lapse": options.get("free_lapse", False), "data": data,
            "expected": expected or fit(data, reference, **options)})

    for seed in range(6):
        add(f"group D, five trials, {seed}", answers(D, 1.853, 0.7, 5, seed), 1.853)
        add(f"group E, five trials, {seed}", answers(E, 16.06, 0.3, 5, seed), 16.06)
    add("many trials", answers(D, 1.853, 0.35, 400, 7), 1.853)
    add("fine discrimination", answers([0.96, 0.98, 0.99, 1.01, 1.02, 1.04], 1, 0.015, 40, 8), 1)
    add("intensity 0 answered no", [[0, 0, 5]] + answers(D, 1.853, 0.6, 5, 9), 1.853)
    add("all yes yet an optimum", [[0.8, 5, 5], [1.5, 5, 5], [2, 5, 5], [3, 5, 5]], 1.0)
    add("one level suffices", [[2.0, 8, 10]], 1.0)
    add("rows of one intensity pooled", [[1.2, 1, 3], [0.8, 1, 4], [1.2, 3, 4], [1.5, 6, 7]], 1.0)
    for seed in range(4):
        add(f"pse free, {seed}", answers(D, 1.853, 0.5, 10, 20 + seed, pse=2.1), 1.853,
            free_pse=True)
        add(f"lapse free, {seed}", answers(E, 16.06, 0.25, 60, 30 + seed, lapse=0.08), 16.06,
            free_lapse=True)
    add("lapse free, on its bound", answers(D, 1.853, 0.6, 20, 41), 1.853, free_lapse=True)
    add("pse and lapse free, 0",
        answers(D + [5.0, 7.0, 0.6, 0.4], 1.853, 0.3, 120, 50, pse=1.7, lapse=0.06), 1.853,
        free_pse=True, free_lapse=True)
    add("pse and lapse free, 1",
        answers(D + [5.0, 7.0, 0.6, 0.4], 1.853, 0.4, 200, 51, pse=2.0, lapse=0.1), 1.853,
        free_pse=True, free_lapse=True)
    for seed in range(5):
        add(f"least squares, {seed}", answers(D, 1.853, 0.7, 5, 60 + seed), 1.853, method="lsq")
    add("least squares, intensity 0", [[0, 1, 5]] + answers(E, 16.06, 0.3, 5, 66), 16.06,
        method="lsq")
    for seed in range(3):
        add(f"least squares, pse free, {seed}", answers(E, 16.06, 0.4, 10, 70 + seed, pse=14),
            16.06, method="lsq", free_pse=True)
    add("least squares, lapse free", answers(E, 16.06, 0.2, 80, 80, lapse=0.1), 16.06,
        method="lsq", free_lapse=True)
    # Two minima of the sum of squares: a steep one for the near levels, a shallow for the far.
    add("least squares with two minima",
        [[1.01, 19, 20], [1.02, 20, 20], [3.0, 13, 20], [6.0, 14, 20], [12.0, 15, 20]], 1.0,
        method="lsq")

    def none(name, data, reference=1.0, **options):
        add(name, data, reference, expected={"status": "degenerate"}, **options)

    # By reasoning, not by search: see the name.
    none("no rows", [])
    none("no trials", [[1.5, 0, 0], [0.5, 0, 0]])
    none("all trials at the reference", [[1.0, 4, 10]])
    none("separated at the reference", [[0.5, 0, 5], [0.8, 0, 5], [1.2, 5, 5], [1.5, 5, 5]])
    none("separated with a mixed level at the reference", [[0.5, 0, 5], [1, 2, 5], [1.5, 5, 5]])
    none("half everywhere", [[0.5, 5, 10], [0.8, 5, 10], [1.2, 5, 10], [1.5, 5, 10]])
    none("inverted", [[0.5, 9, 10], [0.8, 7, 10], [1.25, 3, 10], [2, 1, 10]])
    none("a yes at intensity 0", [[0, 1, 5], [0.5, 1, 5], [2, 4, 5]])
    none("pse free, all yes", [[0.8, 5, 5], [1.5, 5, 5], [2, 5, 5]], free_pse=True)
    none("pse free, separated off the reference", [[2, 0, 5], [3, 3, 5], [4, 5, 5]],
         free_pse=True)
    none("pse free, one intensity", [[2, 3, 5], [2, 2, 5]], free_pse=True)
    none("pse free, falling", [[0.5, 8, 10], [1, 5, 10], [2, 3, 10]], free_pse=True)
    none("lapse free, one distance", [[0.5, 2, 10], [2, 8, 10]], free_lapse=True)
    none("lapse free, a step with lapses is better",
         [[0.5, 1, 10], [0.9, 0, 10], [1.1, 10, 10], [2, 9, 10]], free_lapse=True)
    none("pse and lapse free, two levels", [[0.5, 2, 10], [2, 8, 10]], free_pse=True,
         free_lapse=True)
    none("least squares, separated", [[0.5, 0, 5], [1.5, 5, 5]], method="lsq")
    none("least squares, half everywhere", [[0.5, 5, 10], [1.5, 5, 10]], method="lsq")
    none("least squares, inverted", [[0.5, 9, 10], [1.5, 1, 10]], method="lsq")
    return cases


# --- power law ---------------------------------------------------------------------------------


def power(x, s, method):
    x, s = np.array(x, float), np.array(s, float)
    if method == "loglog":
        keep = (x > 0) & (s > 0)
        line = stats.linregress(np.log(x[keep]), np.log(s[keep]))
        out = {"status": "ok", "k": math.exp(line.intercept), "a": line.slope,
               "r_squared": line.rvalue**2, "num_excluded": int(np.sum(~keep))}
        if keep.sum() > 2:
            out["k_standard_error"] = math.exp(line.intercept) * line.intercept_stderr
            out["a_standard_error"] = line.stderr
        return out

    def law(intensity, k, a):
        return k * intensity**a

    num_at_zero = int(np.sum(x == 0))  # Where the law is 0 for every k and every a > 0.
    x, s = x[x > 0], s[x > 0]
    best = None
    for start in itertools.product([0.2, 1.0, 5.0], [-2, -0.5, 0.3, 1.0, 3.0]):
        try:
            values, covariance = optimize.curve_fit(
                law, x, s, p0=start, xtol=1e-15, ftol=1e-15, gtol=1e-15, maxfev=20000)
        except RuntimeError:
            continue
        sse = float(np.sum((s - law(x, *values)) ** 2))
        if values[0] > 0 and (best is None or sse < best[0]):
            best = (sse, values, covariance)
    sse, values, covariance = best
    out = {"status": "ok", "k": values[0], "a": values[1], "num_excluded": num_at_zero,
           "r_squared": 1 - sse / float(np.sum((s - s.mean()) ** 2))}
    if len(x) > 2:
        out["k_standard_error"] = math.sqrt(covariance[0, 0])
        out["a_standard_error"] = math.sqrt(covariance[1, 1])
    return out


def power_cases():
    cases = []

    def add(name, x, s, method="nls", expected=None):
        print(name, file=sys.stderr)
        cases.append({"name": name, "method": method,
                      "data": [[float(a), float(b)] for a, b in zip(x, s)],
                      "expected": expected or power(x, s, method)})

    scale = [0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4]
    random = np.random.default_rng(90)
    for place, (k, a) in enumerate([(0.67, 0.64), (0.38, 1.2), (0.5, 0.9), (2.0, 0.3)]):
        s = [k * x**a * math.exp(random.normal(0, 0.15)) if x else 0 for x in scale]
        add(f"nls {place}", scale, s)
        add(f"loglog {place}", scale, s, "loglog")
    add("nls, something felt at 0", scale, [0.1, .35, .7, .9, 1.1, 1.15, 1.4, 1.5, 1.55])
    add("nls, falling", [1, 2, 4, 8], [3.9, 2.2, 0.9, 0.55])
    add("nls, two rows", [1, 4], [0.6, 1.7])
    add("loglog, two rows", [1, 4], [0.6, 1.7], "loglog")
    add("loglog, zeros among the magnitudes", [0, 0.5, 1, 2, 4], [0, 0, .8, 1.2, 1.9], "loglog")
    degenerate = {"status": "degenerate"}
    add("nls, one intensity", [0, 2, 2], [0, 1.1, 0.9], expected=degenerate)
    add("nls, all zero", [1, 2, 3], [0, 0, 0], expected=degenerate)
    add("nls, only the highest is felt", [1, 2, 3], [0, 0, 1], expected=degenerate)
    add("loglog, one row left", [0, 1, 2], [0.5, 0, 2], "loglog", degenerate)
    return cases


# --- groups ------------------------------------------------------------------------------------


def compare(test, a, b):
    a, b = np.array(a, float), np.array(b, float)
    if test == "paired":
        result = stats.ttest_rel(a, b)
        d = a - b
        reach = stats.t.ppf(0.975, len(d) - 1) * d.std(ddof=1) / math.sqrt(len(d))
        return {"status": "ok", "estimate": d.mean(), "statistic": result.statistic,
                "degrees_of_freedom": len(d) - 1, "p_value": result.pvalue,
                "ci95": [d.mean() - reach, d.mean() + reach],
                "cohen_dz": d.mean() / d.std(ddof=1)}
    if test == "welch":
        result = stats.ttest_ind(a, b, equal_var=False)
        va, vb = a.var(ddof=1) / len(a), b.var(ddof=1) / len(b)
        df = (va + vb) ** 2 / (va**2 / (len(a) - 1) + vb**2 / (len(b) - 1))
        reach = stats.t.ppf(0.975, df) * math.sqrt(va + vb)
        m = a.mean() - b.mean()
        return {"status": "ok", "estimate": m, "statistic": result.statistic,
                "degrees_of_freedom": df, "p_value": result.pvalue, "ci95": [m - reach, m + reach]}
    if test == "pearson":
        result = stats.pearsonr(a, b)
        ci = result.confidence_interval(0.95)
        r, df = result.statistic, len(a) - 2
        return {"status": "ok", "estimate": r, "p_value": result.pvalue,
                "degrees_of_freedom": df, "statistic": r * math.sqrt(df / (1 - r * r)),
                "ci95": [ci.low, ci.high]}
    d = a - b
    kept = np.round(d[d != 0], 12)
    result = stats.wilcoxon(kept, mode="approx", correction=True)
    p_value = signed_rank_p(kept) if len(kept) <= 50 else result.pvalue
    walsh = [(kept[i] + kept[j]) / 2 for i in range(len(kept)) for j in range(i, len(kept))]
    return {"status": "ok", "estimate": d.mean(), "statistic": result.statistic,
            "p_value": p_value, "hodges_lehmann": float(np.median(walsh))}


def signed_rank_p(differences):
    """Twice the smaller tail over all signs of the midranks, counted in whole numbers."""
    ranks = np.round(2 * stats.rankdata(np.abs(differences))).astype(int)
    ways = {0: 1}
    for rank in map(int, ranks):
        more = dict(ways)
        for total, num in ways.items():
            more[total + rank] = more.get(total + rank, 0) + num
        ways = more
    found = int(ranks[differences > 0].sum())
    tails = [sum(n for t, n in ways.items() if (t <= found if low else t >= found))
             for low in (True, False)]
    return min(1.0, 2 * min(tails) / 2 ** len(ranks))


def compare_cases():
    cases = []

    def add(name, test, a, b, expected=None):
        cases.append({"name": name, "test": test, "a": list(map(float, a)),
                      "b": list(map(float, b)), "expected": expected or compare(test, a, b)})

    random = np.random.default_rng(7)
    for place, n in enumerate([2, 5, 13, 40]):
        a = random.normal(0.7, 0.2, n)
        b = a - random.normal(0.3, 0.25, n)
        add(f"paired {place}", "paired", a, b)
        add(f"welch {place}", "welch", a, random.normal(0.3, 0.4, n + place))
        if n > 3:
            add(f"pearson {place}", "pearson", a, b)
            add(f"wilcoxon {place}", "wilcoxon", a, b)
    add("paired far apart", "paired", [9, 10, 11.5, 12], [1, 2.5, 3, 4])
    add("pearson near one", "pearson", [1, 2, 3, 4, 5], [1, 2, 3, 4, 5.001])
    add("wilcoxon with ties", "wilcoxon", [3, 5, 4, 8, 9, 7, 6], [1, 3, 6, 4, 2, 6, 2])
    add("wilcoxon with zeros", "wilcoxon", [3, 5, 4, 8, 9, 7, 6, 2], [1, 5, 6.5, 4, 2, 7, 2.5, 8])
    a = random.normal(0.2, 1, 70)
    add("wilcoxon, seventy pairs", "wilcoxon", a, np.zeros(70))
    degenerate = {"status": "degenerate"}
    add("paired, all alike", "paired", [1.1, 2.1, 3.1], [1, 2, 3], degenerate)
    add("paired, one pair", "paired", [1], [2], degenerate)
    add("welch, no spread", "welch", [1, 1, 1], [2, 2], degenerate)
    add("pearson, constant", "pearson", [1, 1, 1, 1], [1, 2, 3, 4], degenerate)
    add("pearson, on a line", "pearson", [1, 2, 3], [2, 4, 6], degenerate)
    add("wilcoxon, no difference", "wilcoxon", [1, 2], [1, 2], degenerate)
    return cases


def plain(value):
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (np.floating, np.integer)):
        return value.item()
    return value


if __name__ == "__main__":
    document = {
        "generated_by": "data/reference/fits_reference.py",
        "versions": {"python": sys.version.split()[0], "numpy": np.__version__,
                     "scipy": scipy.__version__},
        "weber": weber_cases(),
        "power": power_cases(),
        "compare": compare_cases(),
    }
    # One case a line, so that a change of one shows as one.
    lines = []
    for key, value in plain(document).items():
        if isinstance(value, list):
            cases = ",\n".join("  " + json.dumps(case, allow_nan=False) for case in value)
            lines.append(f'"{key}": [\n{cases}\n]')
        else:
            lines.append(f'"{key}": {json.dumps(value)}')
    print("{\n" + ",\n".join(lines) + "\n}")
