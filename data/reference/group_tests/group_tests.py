"""Writes group_tests.json: effect sizes with intervals, rank tests and Holm's adjustment.

Independent of the C++: SciPy's noncentral t, Mann-Whitney, Wilcoxon and Spearman; exact p values
with ties and of Spearman by counting arrangements in whole numbers; Hodges and Lehmann's interval
by trying every shift; Holm by its steps. Ties and zeros by another program: rank_tests.R. R 4.2.2 agrees to nine digits (pt with
ncp, within the 37.6 up to which it is exact; wilcox.test; p.adjust). Not run by the tests:

    /usr/bin/python3 data/reference/group_tests/group_tests.py > data/reference/group_tests/group_tests.json
"""

import json
import math
import sys

import numpy as np
import scipy
from scipy import optimize, special, stats

random = np.random.default_rng(20260102)
Z = stats.norm.ppf(0.975)


def noncentrality(t, df):
    def end(probability):
        def excess(nc):
            return stats.nct.cdf(t, df, nc) - probability

        # Widened by small steps: far out SciPy's distribution is not a number.
        low = high = t
        while excess(low) < 0:
            low -= 0.5
        while excess(high) > 0:
            high += 0.5
        return optimize.brentq(excess, low, high, xtol=1e-13, rtol=1e-13)

    return np.array([end(0.975), end(0.025)])


def hedges(df):
    return special.gamma(df / 2) / (np.sqrt(df / 2) * special.gamma((df - 1) / 2))


def of_differences(d):
    n = len(d)
    dz = np.mean(d) / np.std(d, ddof=1)
    ends = noncentrality(dz * np.sqrt(n), n - 1) / np.sqrt(n)
    factor = hedges(n - 1)
    return {
        "cohen_dz": dz, "cohen_dz_ci95": list(ends),
        "hedges_g": factor * dz, "hedges_g_ci95": list(factor * ends),
    }


def of_groups(a, b):
    # Delacre, Lakens, Ley, Liu and Leys (2021): the spreads of the groups as they are.
    n, m = len(a), len(b)
    u, v = np.var(a, ddof=1), np.var(b, ddof=1)
    root, error = np.sqrt((u + v) / 2), np.sqrt(u / n + v / m)
    difference = np.mean(a) - np.mean(b)
    welch = error**4 / ((u / n) ** 2 / (n - 1) + (v / m) ** 2 / (m - 1))
    factor = hedges(
        (n - 1) * (m - 1) * (u + v) ** 2 / ((m - 1) * u**2 + (n - 1) * v**2))
    return {
        "hedges_g": factor * difference / root,
        "hedges_g_ci95": list(
            factor * error / root * noncentrality(difference / error, welch)),
    }


def fisher(r, se):
    if abs(r) == 1:
        return [None, None]
    return [np.tanh(np.arctanh(r) - Z * se), np.tanh(np.arctanh(r) + Z * se)]


def has_ties(values):
    return len(set(values)) < len(values)


def shifts_not_rejected(candidates, p_value):
    """Ends of the shifts that the exact test at 5 % keeps, tried just inside each candidate."""
    beyond = [candidates[0] - 1, candidates[-1] + 1]
    if any(p_value(shift) > 0.05 for shift in beyond):
        return [None, None]
    kept = []
    for low, high in zip(candidates[:-1], candidates[1:]):
        if high > low and p_value((low + high) / 2) > 0.05:
            kept += [low, high]
    return [min(kept), max(kept)]


def paired(a, b):
    d = a - b
    t = stats.ttest_rel(a, b)
    return {"statistic": t.statistic, "p_value": t.pvalue, **of_differences(d)}


def one_sample(a, b):
    t = stats.ttest_1samp(a, 0)
    return {
        "estimate": np.mean(a), "statistic": t.statistic, "p_value": t.pvalue, **of_differences(a)
    }


def welch(a, b):
    t = stats.ttest_ind(a, b, equal_var=False)
    return {"statistic": t.statistic, "p_value": t.pvalue, **of_groups(a, b)}


def smaller_tail_twice(ways, found):
    """Of a dictionary from a sum to how many arrangements have it."""
    low = sum(num for total, num in ways.items() if total <= found)
    high = sum(num for total, num in ways.items() if total >= found)
    return min(1.0, 2 * min(low, high) / sum(ways.values()))


def wilcoxon(a, b):
    d = np.round(a - b, 9)
    d = d[d != 0]
    ranks = np.round(2 * stats.rankdata(np.abs(d))).astype(int)
    r = (ranks[d > 0].sum() - ranks[d < 0].sum()) / ranks.sum()
    test = stats.wilcoxon(d, method="approx", correction=True)
    if len(d) > 50:
        return {"statistic": test.statistic, "p_value": test.pvalue, "rank_biserial": r}
    ways = {0: 1}
    for rank in map(int, ranks):
        more = dict(ways)
        for total, num in ways.items():
            more[total + rank] = more.get(total + rank, 0) + num
        ways = more
    p_value = smaller_tail_twice(ways, int(ranks[d > 0].sum()))
    if not has_ties(np.abs(d)) and len(d) == len(a):
        assert abs(p_value - stats.wilcoxon(d, method="exact").pvalue) < 1e-12
    return {"statistic": test.statistic, "p_value": p_value, "rank_biserial": r}


def ranksum(a, b):
    n, m = len(a), len(b)
    exact = not has_ties(list(a) + list(b)) and n + m <= 50
    test = stats.mannwhitneyu(
        a, b, use_continuity=True, method="exact" if exact else "asymptotic"
    )
    p_value = test.pvalue
    if n + m <= 50:
        ranks = np.round(2 * stats.rankdata(np.concatenate([a, b]))).astype(int)
        ways = {(0, 0): 1}  # By how many were taken, and their sum.
        for rank in map(int, ranks):
            more = dict(ways)
            for (taken, total), num in ways.items():
                key = (taken + 1, total + rank)
                more[key] = more.get(key, 0) + num
            ways = more
        p_value = smaller_tail_twice(
            {total: num for (taken, total), num in ways.items() if taken == n},
            int(ranks[:n].sum()),
        )
        assert not exact or abs(p_value - test.pvalue) < 1e-12
    r = 2 * test.statistic / (n * m) - 1
    differences = np.sort((a[:, None] - b[None, :]).ravel())
    expected = {
        "estimate": np.mean(a) - np.mean(b),
        "statistic": test.statistic, "p_value": p_value,
        "hodges_lehmann": np.median(differences),
        "rank_biserial": r,
    }
    if exact:
        expected["hodges_lehmann_ci95"] = shifts_not_rejected(
            differences, lambda shift: stats.mannwhitneyu(a - shift, b, method="exact").pvalue
        )
    return expected


def pairings(a, b):
    """How many ways to pair the doubled midranks of two columns have which sum of products:
    by how many of each rank of b are left, for the first so many of a."""
    ways = {(tuple(sorted(b)), 0): 1}
    for rank in a:
        more = {}
        for (left, total), num in ways.items():
            for place, other in enumerate(left):
                key = (left[:place] + left[place + 1 :], total + rank * other)
                more[key] = more.get(key, 0) + num
        ways = more
    return {total: num for (left, total), num in ways.items()}


def spearman(a, b):
    test = stats.spearmanr(a, b)
    se = np.sqrt((1 + test.statistic**2 / 2) / (len(a) - 3))
    n = len(a)
    p_value = test.pvalue
    if n <= 14:
        x, y = ([int(r) for r in np.round(2 * stats.rankdata(v))] for v in (a, b))
        ways = pairings(x, y)
        assert sum(ways.values()) == math.factorial(n)
        p_value = smaller_tail_twice(ways, sum(i * j for i, j in zip(x, y)))
    return {
        "estimate": test.statistic,
        "statistic": (n**3 - n) / 6 * (1 - test.statistic),
        "p_value": p_value,
        "ci95": fisher(test.statistic, se),
    }


def holm(p_values):
    order = np.argsort(p_values, kind="stable")
    adjusted, largest = [None] * len(p_values), 0.0
    for step, place in enumerate(order):
        largest = max(largest, min(1.0, (len(p_values) - step) * p_values[place]))
        adjusted[place] = largest
    return adjusted


def rounded(values):
    return [round(float(v), 3) for v in values]


cases = []


def case(test, name, a, b):
    a, b = rounded(a), rounded(b)
    expected = test(np.array(a), np.array(b))
    cases.append({
        "test": test.__name__, "name": name, "a": a, "b": b,
        "expected": {
            k: [None if e is None else float(e) for e in v] if isinstance(v, list) else float(v)
            for k, v in expected.items()
        },
    })


for n, shift in ((3, 0.5), (5, -1.0), (13, 0.8), (13, 0.0), (40, 0.3), (8, 12.0)):
    a, b = random.normal(shift, 1, n), random.normal(0, 1, n)
    case(paired, f"{n} pairs, shift {shift}", a, b)
    case(one_sample, f"{n} values, shift {shift}", a, [])
    case(wilcoxon, f"{n} pairs, shift {shift}", a, b)
    if n > 3:
        case(spearman, f"{n} pairs", a, a + b)
for n, m, shift in (
    (2, 2, 0.4), (4, 3, 2.0), (6, 7, 0.7), (13, 13, -0.9), (30, 18, 0.2), (9, 4, 8.0)
):
    a, b = random.normal(shift, 1, n), random.normal(0, 1.6, m)
    case(welch, f"{n} and {m} values, shift {shift}", a, b)
    if n + m > 6:
        case(ranksum, f"{n} and {m} values, shift {shift}", a, b)
tied = np.round(random.normal(2, 2, 24))
case(ranksum, "ties between and within groups", tied[:10], tied[10:])
case(wilcoxon, "ties and zeros", tied[:12], tied[12:])
case(spearman, "ties", tied[:12], tied[12:])
case(ranksum, "more than fifty values", random.normal(0.4, 1, 40), random.normal(0, 1, 25))

families = []
for size in (1, 2, 5, 12):
    p = rounded(random.uniform(0, 1, size) ** 3)
    families.append({"p_values": p, "adjusted": holm(p)})
families.append({"p_values": [0.01, 0.04, 0.03, 0.005, 0.04],
                 "adjusted": holm([0.01, 0.04, 0.03, 0.005, 0.04])})

print("{")
print('"generated_by": "data/reference/group_tests/group_tests.py",')
versions = {
    "python": sys.version.split()[0], "numpy": np.__version__, "scipy": scipy.__version__
}
print(f'"versions": {json.dumps(versions)},')
print('"holm": [\n  ' + ",\n  ".join(json.dumps(f) for f in families) + "\n],")
print('"tests": [\n  ' + ",\n  ".join(json.dumps(c) for c in cases) + "\n]")
print("}")
