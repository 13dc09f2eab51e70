"""Writes magnitudes.json: an invented study of estimation and production with its analysis.

Independent of the C++: numpy and SciPy throughout, power laws by least squares in (k, a) from
several starts, slopes by ordinary least squares with a column of ones for every group. Not run by
the tests, which read the JSON:

    /usr/bin/python3 data/reference/magnitudes/magnitudes.py > data/reference/magnitudes/magnitudes.json
"""

import itertools
import json
import sys

import numpy as np
import scipy
from scipy import optimize, stats

INTENSITIES = [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]
TARGETS = [100.0, 50.0, 200.0]
random = np.random.default_rng(20260101)


# --- an invented study -------------------------------------------------------------------------


def invented():
    """Eight participants; P03 lacks the production, P07 the estimation. Some answers are 0."""
    people = []
    for number in range(1, 9):
        unit, exponent = np.exp(random.normal(-0.4, 0.3)), random.normal(0.65, 0.1)
        produced_unit, produced_exponent = np.exp(random.normal(0.8, 0.2)), random.normal(0.85, 0.1)
        anchor = random.normal(0.12, 0.05)
        cells = "priming={};method_order={}".format(
            "primed" if number % 2 else "unprimed",
            "estimation,production" if number % 4 < 2 else "production,estimation",
        )
        trial, estimation, production = 0, [], []
        for repetition in (1, 2, 3):
            previous = 0.0
            for intensity in random.permutation(INTENSITIES):
                trial += 1
                felt = unit * intensity**exponent if intensity > 0 else 0.0
                felt *= np.exp(0.03 * (previous - 2)) * np.exp(random.normal(0, 0.2))
                answer = 5 * round(20 * felt)
                if number == 2 and intensity == 0.5 and repetition == 2:
                    answer = 0
                if number == 5 and intensity == 1.0 and repetition == 3:
                    answer = 0
                previous = intensity
                estimation.append([trial, repetition, float(intensity), float(answer)])
        for repetition, target in enumerate(TARGETS, start=1):
            for start in random.permutation(INTENSITIES):
                trial += 1
                matched = produced_unit * (target / 100) ** produced_exponent
                matched *= np.exp(random.normal(0, 0.15))
                value = round(max(0.0, matched + anchor * (start - 2)), 1)
                if number == 4 and target == 50.0 and start == 0.0:
                    value = 0.0
                production.append([trial, repetition, float(start), target, float(value)])
        people.append(
            {
                "participant": f"P{number:02d}",
                "cells": cells,
                "estimation": [] if number == 7 else estimation,
                "production": [] if number == 3 else production,
            }
        )
    return people


# --- means -------------------------------------------------------------------------------------


def by_x(rows, x, y, unit=1.0):
    found = {}
    for row in rows:
        found.setdefault(row[x], []).append(row[y] * unit)
    return found


def arithmetic(answers):
    return {x: float(np.mean(v)) for x, v in answers.items()}


def log_means(answers, rule):
    positive = [v for values in answers.values() for v in values if v > 0]
    result = {}
    for x, values in answers.items():
        if x <= 0:
            continue
        if rule == "half":
            logs = [np.log(v if v > 0 else min(positive) / 2) for v in values]
        else:
            logs = [np.log(v) for v in values if v > 0]
        if logs:
            result[x] = float(np.mean(logs))
    return result


def group(means):
    return {
        x: float(np.mean([m[x] for m in means if x in m]))
        for x in sorted({x for m in means for x in m})
    }


# --- fits --------------------------------------------------------------------------------------


def nls(intensity, magnitude):
    """Least squares of the magnitudes, those at intensity 0 left out."""
    intensity, magnitude = np.array(intensity), np.array(magnitude)
    positive = intensity > 0
    intensity, magnitude = intensity[positive], magnitude[positive]

    def residual(theta):
        return theta[0] * intensity ** theta[1] - magnitude

    def jacobian(theta):
        felt = intensity ** theta[1]
        return np.column_stack([felt, theta[0] * felt * np.log(intensity)])

    best = None
    for start in itertools.product([0.2, 1.0], [0.4, 1.0, 2.0]):
        fit = optimize.least_squares(residual, start, jacobian, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        if best is None or fit.cost < best.cost:
            best = fit
    sse, sst = 2 * best.cost, np.sum((magnitude - magnitude.mean()) ** 2)
    return float(best.x[0]), float(best.x[1]), float(1 - sse / sst)


def line(x, y):
    fit = stats.linregress(x, y)
    return float(np.exp(fit.intercept)), float(fit.slope)


def intensity_on_magnitude(target_ratio, log_intensity):
    fit = stats.linregress(np.log(target_ratio), log_intensity)
    reach = stats.t.ppf(0.975, len(target_ratio) - 2) * fit.stderr
    k, a = np.exp(-fit.intercept / fit.slope), 1 / fit.slope
    return float(k), float(a), [1 / (fit.slope + reach), 1 / (fit.slope - reach)]


def equalise(means, logs):
    common = set.intersection(*(set(m) for m in logs))
    moduli = np.array([np.mean([m[x] for x in common]) for m in logs])
    factors = np.exp(moduli.mean() - moduli)
    return [{x: f * v for x, v in m.items()} for m, f in zip(means, factors)], moduli


def t_interval(values):
    if np.ptp(values) == 0:
        return [float(values[0]), float(values[0])]
    low, high = stats.t.interval(0.95, len(values) - 1, np.mean(values), stats.sem(values))
    return [float(low), float(high)]


# --- the expected numbers ----------------------------------------------------------------------


class Expected:
    def __init__(self):
        self.estimates, self.own, self.tests = {}, {}, {}

    def add(self, name, value, ci95=None):
        self.estimates[name] = {"value": float(value)}
        if ci95 is not None:
            self.estimates[name]["ci95"] = [float(end) for end in ci95]

    def law(self, name, fit):
        self.add(name + ".k", fit[0])
        self.add(name + ".a", fit[1])

    def own_value(self, participant, name, value, ci95=None):
        entry = {"participant": participant, "name": name, "value": float(value)}
        if ci95 is not None:
            entry["ci95"] = [float(end) for end in ci95]
        self.own.setdefault(name, []).append(entry)

    def mean(self, name, values):
        self.add(name, np.mean(values), t_interval(values))

    def geometric_mean(self, name, logs):
        self.add(name, np.exp(np.mean(logs)), np.exp(t_interval(logs)))


def own_exponents(expected, name, exponents):
    expected.mean(name + ".individual_a_mean", exponents)
    expected.add(name + ".individual_a_median", np.median(exponents))
    expected.add(name + ".individual_a_sd", np.std(exponents, ddof=1))


def estimation(expected, people):
    name = "magnitude_estimation"
    people = [p for p in people if p["estimation"]]
    answers = [by_x(p["estimation"], 2, 3, 0.01) for p in people]
    means = [arithmetic(a) for a in answers]
    logs = [log_means(a, "half") for a in answers]
    without = [log_means(a, "out") for a in answers]
    mean = group(means)
    k, a, r_squared = nls(list(mean), list(mean.values()))
    expected.law(name, (k, a))
    expected.add(name + ".r_squared", r_squared)
    points = [(x, v) for m in means for x, v in m.items()]
    expected.law(name + ".data_points", nls(*zip(*points)))
    positive = {x: v for x, v in mean.items() if x > 0}
    expected.law(
        name + ".log_log", line(np.log(list(positive)), np.log(list(positive.values())))
    )
    for suffix, source in (("geometric", logs), ("geometric_without_zeros", without)):
        g = group(source)
        expected.law(f"{name}.{suffix}", line(np.log(list(g)), list(g.values())))
    expected.add(name + ".num_zeros", 2)
    equalised, moduli = equalise(means, logs)
    e = group(equalised)
    expected.law(name + ".equalised", nls(list(e), list(e.values())))
    expected.add(name + ".modulus_sd_ln", np.std(moduli, ddof=1))
    exponents = []
    for p, m, l in zip(people, means, logs):
        own = nls(list(m), list(m.values()))
        exponents.append(own[1])
        expected.own_value(p["participant"], name + ".k", own[0])
        expected.own_value(p["participant"], name + ".a", own[1])
        expected.own_value(
            p["participant"], name + ".geometric.a", line(np.log(list(l)), list(l.values()))[1]
        )
    own_exponents(expected, name, exponents)
    for x in INTENSITIES:
        expected.mean(f"{name}.mean_at_{x:g}", [m[x] for m in means])
        if x > 0:
            expected.geometric_mean(f"{name}.geometric_mean_at_{x:g}", [m[x] for m in logs])
    correlations(expected, people)


def correlations(expected, people):
    every = []
    for first, second in ((1, 2), (1, 3), (2, 3)):
        name = f"trial_correlation.t{first}_t{second}"
        values = []
        for p in people:
            curves = [{r[2]: r[3] for r in p["estimation"] if r[1] == t} for t in (first, second)]
            found = stats.pearsonr(
                [curves[0][x] for x in INTENSITIES], [curves[1][x] for x in INTENSITIES]
            )
            interval = found.confidence_interval()
            values.append(found.statistic)
            expected.own_value(p["participant"], name, found.statistic, interval)
        expected.add(name, np.mean(values))
        every += values
    expected.add("trial_correlation_median", np.median(every))


def production(expected, people):
    name = "magnitude_production"
    people = [p for p in people if p["production"]]
    answers = [by_x(p["production"], 3, 4) for p in people]
    means = [arithmetic(a) for a in answers]
    logs = [log_means(a, "half") for a in answers]
    without = [log_means(a, "out") for a in answers]
    mean = group(means)
    ratios = [t / 100 for t in mean]
    k, a, r_squared = nls(list(mean.values()), ratios)
    expected.law(name, (k, a))
    expected.add(name + ".r_squared", r_squared)
    for suffix, source in (("geometric", logs), ("geometric_without_zeros", without)):
        g = group(source)
        expected.law(f"{name}.{suffix}", line(list(g.values()), np.log([t / 100 for t in g])))
    expected.add(name + ".num_zeros", 1)
    equalised, moduli = equalise(means, logs)
    e = group(equalised)
    expected.law(name + ".equalised", nls(list(e.values()), [t / 100 for t in e]))
    expected.add(name + ".modulus_sd_ln", np.std(moduli, ddof=1))
    g = group(logs)
    expected.law(
        name + ".intensity_on_magnitude",
        intensity_on_magnitude([t / 100 for t in g], list(g.values())),
    )
    exponents = []
    for p, m, own_answers in zip(people, means, answers):
        own = nls(list(m.values()), [t / 100 for t in m])
        exponents.append(own[1])
        expected.own_value(p["participant"], name + ".k", own[0])
        expected.own_value(p["participant"], name + ".a", own[1])
        smallest = min(v for values in own_answers.values() for v in values if v > 0)
        rows = [
            (t / 100, np.log(v if v > 0 else smallest / 2))
            for t, values in own_answers.items()
            for v in values
        ]
        k, a, interval = intensity_on_magnitude(*zip(*rows))
        expected.own_value(p["participant"], name + ".intensity_on_magnitude.k", k)
        expected.own_value(p["participant"], name + ".intensity_on_magnitude.a", a, interval)
    own_exponents(expected, name, exponents)
    for target in sorted(TARGETS):
        expected.mean(f"set_intensity.{target:g}_percent", [m[target] for m in means])
        expected.geometric_mean(
            f"set_intensity.{target:g}_percent.geometric_mean", [m[target] for m in logs]
        )
    for low, high in ((50.0, 100.0), (100.0, 200.0)):
        ratio = f"production_ratio_{high:g}_{low:g}"
        values = [m[high] / m[low] for m in means]
        expected.mean(ratio, values)
        expected.add(ratio + ".sd", np.std(values, ddof=1))
        for p, value in zip(people, values):
            expected.own_value(p["participant"], ratio, value)


def spearman_p(a, b):
    """Twice the smaller tail over every pairing of the ranks."""
    x, y = stats.rankdata(a), stats.rankdata(b)
    sums = np.array([x @ y[list(order)] for order in itertools.permutations(range(len(y)))])
    found = x @ y
    return min(1.0, 2 * min(np.mean(sums <= found + 1e-9), np.mean(sums >= found - 1e-9)))


def spearman_interval(rho, n):
    z, reach = np.arctanh(rho), stats.norm.ppf(0.975) * np.sqrt((1 + rho**2 / 2) / (n - 3))
    return [float(np.tanh(z - reach)), float(np.tanh(z + reach))]


def combined(expected, people):
    people = [p for p in people if p["estimation"] and p["production"]]
    estimated = [arithmetic(by_x(p["estimation"], 2, 3, 0.01)) for p in people]
    produced = [arithmetic(by_x(p["production"], 3, 4)) for p in people]

    def curves(chosen_estimated, chosen_produced):
        e, p = group(chosen_estimated), group(chosen_produced)
        return (
            nls(list(e), list(e.values())),
            nls(list(p.values()), [t / 100 for t in p]),
            list(p.values()),
        )

    def between(first, second, intensities):
        x = [i for i in intensities for _ in range(2)]
        y = [c[0] * i ** c[1] if i > 0 else 0.0 for i in intensities for c in (first, second)]
        return nls(x, y)

    first, second, reached = curves(estimated, produced)
    expected.law("combined", between(first, second, INTENSITIES))
    expected.law(
        "combined.geometric_mean", (np.sqrt(first[0] * second[0]), (first[1] + second[1]) / 2)
    )
    low, high = max(0.5, min(reached)), min(4.0, max(reached))
    inside = [i for i in INTENSITIES if low <= i <= high]
    expected.add("combined.shared_range_low", low)
    expected.add("combined.shared_range_high", high)
    expected.add("combined.num_extrapolated", len(INTENSITIES) - 1 - len(inside))
    expected.law("combined.within_shared_range", between(first, second, inside))
    exponents = []
    for p, e, m in zip(people, estimated, produced):
        own_first, own_second, _ = curves([e], [m])
        exponents.append((own_first[1], own_second[1]))
        own = between(own_first, own_second, INTENSITIES)
        expected.own_value(p["participant"], "combined.k", own[0])
        expected.own_value(p["participant"], "combined.a", own[1])
    turned = {
        own["participant"]: own["value"]
        for own in expected.own["magnitude_production.intensity_on_magnitude.a"]
    }
    estimated_a, s_on_i = (np.array(v) for v in zip(*exponents))
    i_on_s = np.array([turned[p["participant"]] for p in people])
    for words, a, b in (
        ("production as I on S (primary)", estimated_a, i_on_s),
        ("production as S on I (secondary)", estimated_a, s_on_i),
    ):
        t = stats.ttest_rel(a, b)
        w = stats.wilcoxon(a, b, method="exact")
        rho = stats.spearmanr(a, b)
        pair = f"own exponents, estimation - production, {words}: "
        expected.tests[pair + "paired t"] = {
            "estimate": np.mean(a - b), "statistic": t.statistic, "p_value": t.pvalue
        }
        expected.tests[pair + "Wilcoxon, sensitivity"] = {
            "statistic": w.statistic, "p_value": w.pvalue
        }
        expected.tests[f"own exponents, estimation and production, {words}: Spearman's r"] = {
            "estimate": rho.statistic,
            "p_value": spearman_p(a, b),
            "ci95": spearman_interval(rho.statistic, len(a)),
        }


# --- exploratory -------------------------------------------------------------------------------


def within_slope(groups, x, y):
    """Ordinary least squares with an intercept of its own for each group."""
    levels = sorted(set(groups))
    design = np.array([[x_] + [float(g == l) for l in levels] for g, x_ in zip(groups, x)])
    return float(np.linalg.lstsq(design, np.array(y), rcond=None)[0][0])


def relative(rows, stimulus, response, x_of):
    mean = arithmetic(by_x(rows, stimulus, response))
    points = []
    for previous, row in zip([None] + rows[:-1], rows):
        x = x_of(row, previous)
        if row[stimulus] > 0 and x is not None:
            points.append((row[stimulus], x, row[response] / mean[row[stimulus]] - 1))
    return within_slope(*zip(*points))


def exploratory(expected, people):
    t_tests, rank_tests = [], []

    def against_zero(name, values):
        expected.mean(name, values)
        t = stats.ttest_1samp(values, 0)
        w = stats.wilcoxon(values, method="exact")
        t_tests.append((f"{name} against 0, t", np.mean(values), t.statistic, t.pvalue))
        rank_tests.append((f"{name} against 0, ranks, sensitivity", None, w.statistic, w.pvalue))

    estimators = [p for p in people if p["estimation"]]
    producers = [p for p in people if p["production"]]
    for name, source, of_one in (
        (
            "magnitude_estimation.drift_per_ten_trials",
            estimators,
            lambda p: relative(p["estimation"], 2, 3, lambda row, before: row[0] / 10),
        ),
        (
            "magnitude_estimation.previous_stimulus_slope",
            estimators,
            lambda p: relative(
                p["estimation"], 2, 3, lambda row, before: None if before is None else before[2]
            ),
        ),
        (
            "magnitude_production.starting_value_slope",
            producers,
            lambda p: within_slope(*zip(*[(r[3], r[2], r[4]) for r in p["production"]])),
        ),
        (
            "magnitude_production.drift_per_ten_trials",
            producers,
            lambda p: relative(p["production"], 3, 4, lambda row, before: row[0] / 10),
        ),
    ):
        values = [of_one(p) for p in source]
        for p, value in zip(source, values):
            expected.own_value(p["participant"], name, value)
        against_zero(name, values)

    arms = {p["participant"]: dict(c.split("=") for c in p["cells"].split(";")) for p in people}
    for counterbalance in ("method_order", "priming"):
        for block in ("magnitude_estimation", "magnitude_production"):
            for parameter, words, scale in (("k", "ln k", np.log), ("a", "a", lambda v: v)):
                groups = {}
                for own in expected.own[f"{block}.{parameter}"]:
                    arm = arms[own["participant"]][counterbalance]
                    groups.setdefault(arm, []).append(scale(own["value"]))
                (first, a), (second, b) = sorted(groups.items())
                name = f"{counterbalance}: {first} - {second}: {words} of {block}"
                t = stats.ttest_ind(a, b, equal_var=False)
                u = stats.mannwhitneyu(a, b, method="exact")
                t_tests.append((name + ", t", np.mean(a) - np.mean(b), t.statistic, t.pvalue))
                rank_tests.append((name + ", ranks, sensitivity", None, u.statistic, u.pvalue))
    p = np.array([test[3] for test in t_tests])
    # Holm (1979) by its closed form: the largest of the steps up to each p value.
    holm = [min(1.0, max((len(p) - np.sum(p < q)) * q for q in p if q <= own)) for own in p]
    for (name, mean, statistic, p_value), adjusted in zip(t_tests, holm):
        expected.tests[name] = {
            "statistic": statistic, "p_value": p_value, "p_value_holm": adjusted, "estimate": mean
        }
    # Rank tests are of the same hypotheses: without an adjustment of their own.
    for name, _, statistic, p_value in rank_tests:
        expected.tests[name] = {"statistic": statistic, "p_value": p_value}


def main():
    people, expected = invented(), Expected()
    estimation(expected, people)
    production(expected, people)
    combined(expected, people)
    exploratory(expected, people)
    document = {
        "generated_by": "data/reference/magnitudes/magnitudes.py",
        "versions": {
            "python": sys.version.split()[0],
            "numpy": np.__version__,
            "scipy": scipy.__version__,
        },
        "people": people,
        "estimates": expected.estimates,
        "own": [entry for entries in expected.own.values() for entry in entries],
        "tests": expected.tests,
    }
    rows = []
    for key, value in document.items():
        if isinstance(value, list):
            lines = ",\n  ".join(json.dumps(one) for one in value)
            rows.append(f'"{key}": [\n  {lines}\n]')
        elif key in ("estimates", "tests"):
            lines = ",\n  ".join(f"{json.dumps(k)}: {json.dumps(v)}" for k, v in value.items())
            rows.append(f'"{key}": {{\n  {lines}\n}}')
        else:
            rows.append(f'"{key}": {json.dumps(value)}')
    print("{\n" + ",\n".join(rows) + "\n}")


main()
