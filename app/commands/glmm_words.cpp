#include <fmt/format.h>

#include <algorithm>

#include "app/commands/glmm_options.h"
#include "app/curves/fit_words.h"

namespace jnd::app {
namespace {

/// The width of a column: that of its longest cell, but at least `least`.
std::size_t longest(std::size_t least, const auto& items, const auto& name) {
  std::size_t most = least;
  for (const auto& one : items) most = std::max(most, name(one).size());
  return most;
}

void print_fixed(const analysis::MixedFit& fit) {
  const std::size_t width =
      longest(5, fit.fixed, [](const analysis::FixedEffect& one) { return one.name; });
  fmt::print("fixed effects\n  {:<{}}  {:>10}  {:>10}  {:>8}  {}\n", "", width, "estimate",
             "std. error", "z", "p");
  for (const analysis::FixedEffect& one : fit.fixed) {
    fmt::print("  {:<{}}  {:>10}  {:>10}  {:>8.3f}  {}\n", one.name, width,
               number(one.estimate), number(one.standard_error), one.z,
               one.p == 0.0 ? "< 1e-300" : number(one.p));
  }
}

void print_random(const GlmmResult& result) {
  fmt::print("random effects, between");
  for (std::size_t i = 0; i < result.groups.size(); ++i) {
    fmt::print("{} {} groups of {}", i == 0 ? "" : ",", result.groups[i].second,
               result.groups[i].first);
  }
  const auto name = [](const analysis::RandomEffect& one) {
    return one.group + "  " + one.name;
  };
  const std::size_t width = longest(5, result.fit.random, name);
  fmt::print("\n  {:<{}}  {:>10}  correlation with those above\n", "", width, "std. dev.");
  for (const analysis::RandomEffect& one : result.fit.random) {
    fmt::print("  {:<{}}  {:>10}", name(one), width, number(one.sd));
    for (const double correlation : one.correlations) fmt::print("  {:.3f}", correlation);
    fmt::print("\n");
  }
}

void print_derived(const FitGlmmOptions& options, const GlmmResult& result) {
  const bool is_log = result.lines.axis == analysis::StimulusAxis::kLogarithmic;
  fmt::print(
      "of the median group, over {}{}: PSE where F is 1/2, JND from there to F = {:g}; "
      "intervals by Student's t, df = {}\n",
      is_log ? "ln " : "", options.stimulus, options.jnd_at, result.degrees_of_freedom);
  const std::size_t width =
      longest(5, result.derived, [](const analysis::DerivedQuantity& one) { return one.name; });
  for (const analysis::DerivedQuantity& one : result.derived) {
    fmt::print("  {:<{}}  {:>10}  95 % {}", one.name, width, number(one.value),
               one.value ? whole_range(one.ci95) : "-");
    if (options.num_bootstrap > 0) {
      const bool is_told = one.bootstrap_ci95.low.has_value();
      fmt::print(", bootstrap {}",
                 is_told ? whole_range(one.bootstrap_ci95) : std::string("none"));
    }
    fmt::print("\n");
  }
  if (options.num_bootstrap > 0) {
    fmt::print("  {} redraws, of which {} had no fit and count as beyond either end\n",
               options.num_bootstrap, result.num_without_fit);
  }
}

}  // namespace

void print_glmm(const FitGlmmOptions& options, const GlmmResult& result) {
  const analysis::MixedFit& fit = result.fit;
  fmt::print("{} of {}", options.link, result.formulas.fixed.text);
  for (const std::string& one : options.random) fmt::print(", random {}", one);
  if (options.guess != "0" || options.lapse != "0") {
    fmt::print("; guess {}, lapse {}", options.guess, options.lapse);
  }
  fmt::print("\n");
  if (fit.status != analysis::FitStatus::kOk) {
    fmt::print("  no fit: {}\n", fit.reason);
  } else {
    print_fixed(fit);
    print_random(result);
    if (!result.derived.empty()) print_derived(options, result);
    fmt::print("log-likelihood {:.10g} by {}, AIC {:.7g}, {} rows, {} parameters\n",
               fit.log_likelihood,
               options.num_nodes == 1
                   ? std::string("Laplace's approximation")
                   : fmt::format("quadrature of {} nodes", options.num_nodes),
               fit.aic, fit.num_rows, fit.num_parameters);
  }
  for (const std::string& note : result.notes) fmt::print("note: {}\n", note);
}

}  // namespace jnd::app
