#include <fmt/format.h>

#include <algorithm>

#include "app/commands/glmm_options.h"
#include "app/commands/script_parts.h"

namespace jnd::app {
namespace {

/// A random term in parentheses, which may be missing: "(1 + u | participant)".
std::string random_in_r(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first != std::string::npos && text[first] == '(' ? text : "(" + text + ")";
}

/// lme4 can use quadrature only if there is a single random effect.
bool has_quadrature_in_r(const FitGlmmOptions& options, const GlmmResult& result) {
  return options.num_nodes > 1 && result.fit.random.size() == 1;
}

std::string columns_text(const FitGlmmOptions& options, const GlmmResult& result) {
  std::string text;
  std::string kept = "keep <- !is.na(yes) & !is.na(n) & n > 0";
  for (const analysis::TrialVariable& variable : result.table.variables) {
    if (options.terms == "history" &&
        (variable.name == analysis::previous_stimulus(options.stimulus) ||
         variable.name == analysis::kPreviousAnswer)) {
      continue;
    }
    const std::string column = "data[[" + quoted(variable.name) + "]]";
    if (variable.is_numeric()) text += column + " <- number(" + column + ")\n";
    kept += " & !is.na(" + column + ")";
  }
  text += kept + "\ndata <- data[keep, , drop = FALSE]\nyes <- yes[keep]\nn <- n[keep]\n";
  if (options.terms == "history") {
    text += "before <- ave(seq_len(nrow(data)), data[[" +
            quoted(result.formulas.random.front().group_columns.front()) +
            "]], FUN = function(i) c(NA, head(i, -1)))\ndata[[" +
            quoted(analysis::previous_stimulus(options.stimulus)) + "]] <- data[[" +
            quoted(options.stimulus) + "]][before]\ndata[[" +
            quoted(analysis::kPreviousAnswer) +
            "]] <- yes[before]\ndata <- data[!is.na(before), , drop = FALSE]\nyes <- "
            "yes[!is.na(before)]\nn <- n[!is.na(before)]\n";
  }
  for (const analysis::TrialVariable& variable : result.table.variables) {
    if (variable.is_numeric()) continue;
    const std::string column = "data[[" + quoted(variable.name) + "]]";
    text += column + " <- factor(" + column + ", levels = sort(unique(" + column +
            "), method = \"radix\"))\n";
  }
  return text;
}

std::string family_text(const FitGlmmOptions& options) {
  if (options.guess == "0" && options.lapse == "0") {
    return "family <- binomial(link = \"" + options.link + "\")\n";
  }
  return fmt::format(
      "guess <- {}\nspan <- 1 - guess - {}\nplain <- make.link(\"{}\")\n"
      "link <- structure(list(\n"
      "  linkfun = function(mu) plain$linkfun(pmin(pmax((mu - guess) / span, 1e-12), 1 - "
      "1e-12)),\n"
      "  linkinv = function(eta) guess + span * plain$linkinv(eta),\n"
      "  mu.eta = function(eta) span * plain$mu.eta(eta), valideta = function(eta) TRUE,\n"
      "  name = \"guess and lapse\"), class = \"link-glm\")\n"
      "family <- binomial(link = link)\n",
      options.guess, options.lapse, options.link);
}

}  // namespace

std::string glmm_script(const FitGlmmOptions& options, const GlmmResult& result) {
  const analysis::MixedFit& fit = result.fit;
  std::string text = "# Repeats a fit of jnd with lme4 in R.\n# jnd found:\n";
  for (const analysis::FixedEffect& one : fit.fixed) {
    text += fmt::format("#   {} {:.8g}, standard error {:.8g}\n", one.name, one.estimate,
                        one.standard_error);
  }
  for (const analysis::RandomEffect& one : fit.random) {
    text += fmt::format("#   standard deviation of {} between {}: {:.8g}\n", one.name,
                        one.group, one.sd);
  }
  text += fit.status == analysis::FitStatus::kOk
              ? fmt::format("#   log-likelihood {:.8g}\n", fit.log_likelihood)
              : "#   no fit: " + fit.reason + "\n";
  text += "suppressMessages(library(lme4))\n" + r_table_text(options) +
          r_answers_text(options) + columns_text(options, result);
  text += std::string("options(contrasts = c(\"contr.") + options.contrasts +
          "\", \"contr.poly\"))\ncenter <- function(x) scale(x, scale = FALSE)\n" +
          family_text(options);
  const bool has_quadrature = has_quadrature_in_r(options, result);
  if (options.num_nodes > 1 && !has_quadrature) {
    text +=
        "# lme4 has quadrature for a single random effect alone; this is Laplace's "
        "approximation.\n";
  }
  text += "data$answers_ <- cbind(yes, n - yes)\nfit <- glmer(answers_ ~ " +
          result.formulas.fixed.text;
  for (const std::string& one : options.random) text += " + " + random_in_r(one);
  text += fmt::format(
      ",\n  data = data, family = family, nAGQ = {},\n"
      "  control = glmerControl(optimizer = \"bobyqa\", optCtrl = list(maxfun = 1e5),\n"
      "    tolPwrss = 1e-13))  # By its usual one the last digits of lme4 are not settled.\n",
      has_quadrature ? options.num_nodes : 1);
  text +=
      "print(summary(fit), correlation = FALSE)\n"
      "cat(paste(names(fixef(fit)), sprintf(\"%.8g\", fixef(fit)), collapse = \", \"), "
      "\"\\n\", sep = \"\")\n";
  text += has_quadrature
              ? "# With nAGQ > 1 lme4 leaves out the likelihood of the saturated model.\n"
                "saturated <- sum(dbinom(yes, n, yes / n, log = TRUE))\n"
              : "saturated <- 0\n";
  text +=
      "cat(\"log_likelihood\", sprintf(\"%.8g\", as.numeric(logLik(fit)) + saturated), "
      "\"\\n\")\n";
  return text;
}

}  // namespace jnd::app
