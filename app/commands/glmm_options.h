#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/mixed/mixed_derived.h"
#include "analysis/mixed/mixed_fit.h"
#include "analysis/mixed/mixed_table.h"
#include "app/commands/answer_options.h"

namespace jnd::app {

struct FitGlmmOptions : AnswerRequest {
  std::string fixed;
  std::vector<std::string> random;
  bool says_guess = false;  ///< Somebody gave --guess.
  std::string link = "probit", contrasts = "treatment", guess = "0", lapse = "0";
  std::string stimulus, terms, script, figure;
  double jnd_at = 0.75;
  int num_nodes = 1, num_bootstrap = 0;
  std::uint64_t seed = 1;
};

/// A mixed model that was fitted, and the data to which it was fitted.
struct GlmmResult {
  /// The cells of --group-by; empty if all rows form one group.
  std::vector<std::pair<std::string, std::string>> group;
  analysis::MixedFormulas formulas;        ///< Include the terms of the history.
  analysis::TrialTable table;              ///< The table of the group.
  std::optional<analysis::Design> design;  ///< The design of the fixed effects.
  analysis::MixedFit fit;
  analysis::StimulusLines lines;
  std::vector<analysis::DerivedQuantity> derived;
  int degrees_of_freedom = 0;  ///< Those of Student's t in the intervals of `derived`.
  /// The number of groups of each random term, by the name of the grouping.
  std::vector<std::pair<std::string, std::size_t>> groups;
  int num_without_fit = 0;  ///< How many refits of the bootstrap failed.
  /// The group's notes; if there is one group only, those of the file.
  std::vector<std::string> notes;
};

/// Prints the result for people, on stdout.
void print_glmm(const FitGlmmOptions& options, const GlmmResult& result);

/// A script that repeats the fit by lme4 in R.
[[nodiscard]] std::string glmm_script(const FitGlmmOptions& options, const GlmmResult& result);

}  // namespace jnd::app
