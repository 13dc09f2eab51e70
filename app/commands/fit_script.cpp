#include "app/commands/fit_script.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/commands/script_parts.h"

namespace jnd::app {
namespace {

using analysis::CurveFamily;

std::string list_of(const std::vector<std::string>& words, const char* open,
                    const char* close) {
  std::string text = open;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : ", ") + quoted(words[i]);
  }
  return text + close;
}

/// Comments that say what was found here, one line for each group, such as "#   location 1.2,
/// scale 3.4, ...".
std::string found_here(const std::vector<analysis::CurveFit>& fits) {
  std::string text;
  for (const analysis::CurveFit& fit : fits) {
    if (fit.status != analysis::FitStatus::kOk) {
      text += "#   no curve: " + fit.reason + "\n";
      continue;
    }
    text += fmt::format(
        "#   location {:.8g}, scale {:.8g}, guess {:.8g}, lapse {:.8g}, log-likelihood "
        "{:.8g}\n",
        *fit.location.value, *fit.scale.value, *fit.guess_rate.value, *fit.lapse_rate.value,
        *fit.log_likelihood);
  }
  return text;
}

struct FormulaInLanguage {
  CurveFamily family;
  const char* r;
  const char* python;
  const char* r_link;  ///< The link of glm; "" for none.
};

constexpr FormulaInLanguage kFormulas[] = {
    {CurveFamily::kNormal, "pnorm((u - location) / scale)",
     "0.5 * math.erfc(-(u - location) / scale / math.sqrt(2))", "probit"},
    {CurveFamily::kLogistic, "plogis((u - location) / scale)",
     "0.5 * (1 + math.tanh(0.5 * (u - location) / scale))", "logit"},
    {CurveFamily::kWeibull, "1 - exp(-exp(scale * (u - log(location))))",
     "-math.expm1(-math.exp(min(700, scale * (u - math.log(location)))))", "cloglog"},
    {CurveFamily::kGumbel, "1 - exp(-exp((u - location) / scale))",
     "-math.expm1(-math.exp(min(700, (u - location) / scale)))", "cloglog"},
    {CurveFamily::kReversedGumbel, "exp(-exp(-(u - location) / scale))",
     "math.exp(-math.exp(min(700, -(u - location) / scale)))", ""},
    {CurveFamily::kHyperbolicSecant, "2 / pi * atan(exp(pi / 2 * (u - location) / scale))",
     "2 / math.pi * math.atan(math.exp(min(700, math.pi / 2 * (u - location) / scale)))", ""},
};

const FormulaInLanguage& formula_of(CurveFamily family) {
  return *std::ranges::find(kFormulas, family, &FormulaInLanguage::family);
}

/// The curve with its ends, such as "guess + (1 - guess - lapse) * s".
std::string ends_words(const analysis::CurveModel& model) {
  const std::string s = model.falling ? "(1 - s)" : "s";
  return model.symmetric ? "guess + lapse + (1 - guess - 2 * lapse) * " + s
                         : "guess + (1 - guess - lapse) * " + s;
}

std::vector<std::string> free_rates(const analysis::CurveModel& model) {
  std::vector<std::string> names;
  if (model.free_guess) names.emplace_back("guess");
  if (model.free_lapse) names.emplace_back("lapse");
  return names;
}

std::string r_script(const AnswerRequest& options, const analysis::CurveOptions& how,
                     const std::vector<analysis::CurveFit>& fits) {
  const analysis::CurveModel& model = how.model;
  const FormulaInLanguage& formula = formula_of(model.family);
  std::string text = "# Repeats a fit of jnd with R alone: P(yes) = " + ends_words(model) +
                     ", s = " + analysis::formula_words(model.family, model.is_logarithmic()) +
                     ".\n# jnd found, group by group:\n" + found_here(fits);
  text += r_table_text(options);
  text += "x <- number(data[[" + quoted(options.intensity) + "]])\n";
  text += r_answers_text(options);
  text += options.group_by.empty()
              ? "group <- rep(\"all rows\", nrow(data))\n"
              : "group <- do.call(paste, c(lapply(" + list_of(options.group_by, "c(", ")") +
                    ", function(g) data[[g]]), sep = \", \"))\n";
  text +=
      "keep <- !is.na(x) & !is.na(yes) & !is.na(n) & n > 0\n"
      "fit <- function(x, yes, n) {\n";
  text += model.is_logarithmic() ? "  u <- log(x)\n" : "  u <- x\n";
  const bool is_glm = *formula.r_link != '\0' && !model.free_guess && !model.free_lapse &&
                      model.guess_rate == 0.0 && model.lapse_rate == 0.0;
  if (is_glm) {
    text += std::string("  line <- coef(glm(cbind(") +
            (model.falling ? "n - yes, yes" : "yes, n - yes") +
            ") ~ u, family = binomial(link = \"" + formula.r_link +
            "\"), subset = is.finite(u),\n" +
            "                   control = glm.control(epsilon = 1e-12, maxit = 100)))\n";
    text += model.family == CurveFamily::kWeibull
                ? "  location <- exp(-line[[1]] / line[[2]])\n  scale <- line[[2]]\n"
                : "  location <- -line[[1]] / line[[2]]\n  scale <- 1 / line[[2]]\n";
    text += "  guess <- 0\n  lapse <- 0\n";
  } else {
    text += fmt::format("  guess <- {:.17g}\n  lapse <- {:.17g}\n", model.guess_rate,
                        model.lapse_rate);
  }
  const std::vector<std::string> rates = free_rates(model);
  text += std::string("  p <- function(location, scale, guess, lapse) {\n    s <- ") +
          formula.r + "\n    " + ends_words(model) + "\n  }\n" +
          "  minus_log_likelihood <- function(location, scale, guess, lapse) {\n"
          "    p <- p(location, scale, guess, lapse)\n"
          "    value <- -sum(ifelse(yes > 0, yes * log(p), 0)) - sum(ifelse(n > yes, (n - yes) "
          "* log1p(-p), 0))\n"
          "    if (is.finite(value)) value else 1e10\n  }\n";
  if (!is_glm) {
    text +=
        "  # Parameters that may take any value: location, ln scale, and rates by 1 / (2 + 2 "
        "exp(-q)), which is below 0.5.\n"
        "  at <- function(q) {\n"
        "    values <- list(location = q[1], scale = exp(q[2]), guess = guess, lapse = "
        "lapse)\n";
    if (model.family == CurveFamily::kWeibull) text += "    values$location <- exp(q[1])\n";
    for (std::size_t i = 0; i < rates.size(); ++i) {
      text += fmt::format("    values${} <- 0.5 * plogis(q[{}])\n", rates[i], 3 + i);
    }
    text +=
        "    values\n  }\n"
        "  cost <- function(q) do.call(minus_log_likelihood, at(q))\n"
        "  inside <- u[is.finite(u)]\n"
        "  best <- list(value = Inf)\n"
        "  for (place in quantile(inside, c(0.3, 0.5, 0.7), names = FALSE)) for (width in "
        "c(0.1, 0.3)) {\n"
        "    wide <- width * diff(range(inside))\n";
    text += std::string("    q <- c(place, ") +
            (model.family == CurveFamily::kWeibull ? "-log(wide)" : "log(wide)") +
            (rates.empty()       ? ""
             : rates.size() == 1 ? ", -3"
                                 : ", -3, -3") +
            ")\n";
    text +=
        "    for (again in 1:6) {\n"
        "      found <- optim(q, cost, control = list(reltol = 1e-14, maxit = 5000))\n"
        "      q <- found$par\n"
        "    }\n"
        "    if (found$value < best$value) best <- found\n"
        "  }\n"
        "  values <- at(best$par)\n"
        "  location <- values$location; scale <- values$scale\n"
        "  guess <- values$guess; lapse <- values$lapse\n";
  }
  text +=
      "  c(location = location, scale = scale, guess = guess, lapse = lapse,\n"
      "    log_likelihood = -minus_log_likelihood(location, scale, guess, lapse))\n}\n"
      "for (one in unique(group[keep])) {\n"
      "  its <- keep & group == one\n"
      "  values <- fit(x[its], yes[its], n[its])\n"
      "  cat(one, \": \", paste(names(values), sprintf(\"%.8g\", values), collapse = \", \"), "
      "\"\\n\", sep = \"\")\n}\n";
  return text;
}

std::string python_script(const AnswerRequest& options, const analysis::CurveOptions& how,
                          const std::vector<analysis::CurveFit>& fits) {
  const analysis::CurveModel& model = how.model;
  const bool is_weibull = model.family == CurveFamily::kWeibull;
  const std::vector<std::string> rates = free_rates(model);
  std::string text = "# Repeats a fit of jnd with Python alone: P(yes) = " + ends_words(model) +
                     ", s = " + analysis::formula_words(model.family, model.is_logarithmic()) +
                     ".\n# jnd found, group by group:\n" + found_here(fits);
  text +=
      "import csv\nimport json\nimport math\n\n"
      "FILE = " +
      quoted(options.csv) + "\nINTENSITY = " + quoted(options.intensity) +
      "\nYES = " + quoted(yes_column(options)) +
      "\nYES_VALUE = " + (options.yes_value.empty() ? "None" : quoted(options.yes_value)) +
      "\nTRIALS = " +
      (trials_column(options).empty() ? "None" : quoted(trials_column(options))) +
      "\nGROUP_BY = " + list_of(options.group_by, "[", "]") +
      "\nWHERE = " + list_of(options.where, "[", "]") + "\n";
  text += fmt::format("GUESS, LAPSE = {:.17g}, {:.17g}\nFREE = {}\n\n", model.guess_rate,
                      model.lapse_rate, list_of(rates, "[", "]"));
  text += R"(
def flattened(trial, before=""):
    row = {}
    for key, value in trial.items():
        row[before + key] = "" if value is None else value if isinstance(value, str) else json.dumps(value)
        if isinstance(value, dict):
            row.update(flattened(value, before + key + "."))
    return row


def rows():
    with open(FILE, encoding="utf-8-sig", newline="") as file:
        text = file.read()
    if text.lstrip()[:1] in "[{":
        return [flattened(trial) for trial in json.loads(text)]
    lines = text.splitlines(keepends=True)
    separator = max("\t;,", key=lines[0].count)
    return list(csv.DictReader(lines, delimiter=separator, skipinitialspace=True))


def number(cell):
    return float(cell.strip().replace(",", "."))


def counts():
    groups = {}
    for row in rows():
        if any(row.get(one.split("=", 1)[0]) != one.split("=", 1)[1] for one in WHERE):
            continue
        needed = [INTENSITY, YES] + ([TRIALS] if TRIALS else [])
        cells = [(row.get(name) or "").strip() for name in needed]
        names = [(row.get(name) or "").strip() for name in GROUP_BY]
        if any(cell.lower() in ("", "na") for cell in names):
            continue
        if any(cell.lower() in ("", "na", "nan", "null", "none") for cell in cells):
            continue
        trials = number(row[TRIALS]) if TRIALS else 1
        answer = row[YES].strip()
        if YES_VALUE is not None:
            yes = trials if answer == YES_VALUE else 0
        else:
            words = {"true": 1, "yes": 1, "false": 0, "no": 0, "-1": 0}
            yes = words[answer.lower()] if answer.lower() in words else number(answer)
        if trials > 0:
            group = groups.setdefault(", ".join(row[name] for name in GROUP_BY), {})
            x = number(row[INTENSITY])
            at = group.setdefault(x, [0, 0])
            at[0] += yes
            at[1] += trials
    return groups


)";
  text +=
      std::string("def probability(x, location, scale, guess, lapse):\n") +
      (model.is_logarithmic()
           ? "    if x == 0:\n        s = 0\n    else:\n        u = math.log(x)\n        s = "
           : "    u = x\n    s = ") +
      formula_of(model.family).python + "\n    return " + ends_words(model) + "\n";
  text += R"(

def values_at(q):
    values = {"location": q[0], "scale": math.exp(q[1]), "guess": GUESS, "lapse": LAPSE}
)";
  if (is_weibull) text += "    values[\"location\"] = math.exp(q[0])\n";
  text += R"(    for i, name in enumerate(FREE):
        values[name] = 0.5 / (1 + math.exp(-q[2 + i]))
    return values


def cost(q, data):
    try:
        values = values_at(q)
        total = 0.0
        for x, (yes, trials) in data.items():
            p = probability(x, **values)
            if yes > 0:
                total -= yes * math.log(p)
            if yes < trials:
                total -= (trials - yes) * math.log1p(-p)
        return total
    except (ValueError, OverflowError):
        return 1e10


def lowest(start, data):
    """Nelder and Mead (1965), started again where it came to rest."""
    best = list(start)
    for size in (0.5, 0.2, 0.05, 0.01):
        corners = [best] + [[v + (size if i == j else 0) for j, v in enumerate(best)] for i in range(len(best))]
        corners = sorted((cost(q, data), q) for q in corners)
        for _ in range(2000):
            if corners[-1][0] - corners[0][0] < 1e-13 * abs(corners[0][0]):
                break
            middle = [sum(q[j] for _, q in corners[:-1]) / (len(corners) - 1) for j in range(len(best))]
            move = lambda share: [m + share * (w - m) for m, w in zip(middle, corners[-1][1])]
            point = move(-1)
            value = cost(point, data)
            if value < corners[0][0]:
                far = move(-2)
                far_value = cost(far, data)
                point, value = (far, far_value) if far_value < value else (point, value)
            elif value >= corners[-2][0]:
                point = move(-0.5 if value < corners[-1][0] else 0.5)
                value = cost(point, data)
                if value >= corners[-1][0]:
                    first = corners[0][1]
                    corners = [corners[0]] + [
                        (cost(near, data), near)
                        for near in ([0.5 * (a + b) for a, b in zip(first, q)] for _, q in corners[1:])
                    ]
                    corners.sort()
                    continue
            corners[-1] = (value, point)
            corners.sort()
        best = corners[0][1]
    return cost(best, data), best


for name, data in counts().items():
)";
  text += model.is_logarithmic() ? "    places = sorted(math.log(x) for x in data if x > 0)\n"
                                 : "    places = sorted(data)\n";
  text +=
      "    wide = places[-1] - places[0]\n    starts = [\n        [places[int(share * "
      "(len(places) - 1))], ";
  text += is_weibull ? "-math.log(width * wide)" : "math.log(width * wide)";
  text += R"(] + [-3.0] * len(FREE)
        for share in (0.3, 0.5, 0.7)
        for width in (0.1, 0.3)
    ]
    value, best = min(lowest(start, data) for start in starts)
    found = ", ".join(f"{key} {number:.8g}" for key, number in values_at(best).items())
    print(f"{name or 'all rows'}: {found}, log_likelihood {-value:.8g}")
)";
  return text;
}

}  // namespace

std::string script_of_fit(ScriptLanguage language, const AnswerRequest& options,
                          const analysis::CurveOptions& how,
                          const std::vector<analysis::CurveFit>& fits) {
  return language == ScriptLanguage::kR ? r_script(options, how, fits)
                                        : python_script(options, how, fits);
}

}  // namespace jnd::app
