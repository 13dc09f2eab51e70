#include "app/curves/curve_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/command_line/command.h"
#include "app/curves/prior_options.h"

namespace jnd::app {
namespace {

/// The guess rate of a task, such as 1/3 for "mafc:3".
std::optional<double> guess_of_task(const std::string& task) {
  if (task.empty()) return std::nullopt;
  if (task == "yes-no") return 0.0;
  const std::string forced = "mafc:";
  const std::string digits = task.starts_with(forced) ? task.substr(forced.size()) : "";
  const bool is_number =
      !digits.empty() && digits.size() < 4 &&
      std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
  if (!is_number || std::stoi(digits) < 2) {
    throw UsageError(
        fmt::format("--task: expected yes-no, or mafc:M with M alternatives such as mafc:2, "
                    "found {}",
                    task));
  }
  return 1.0 / std::stoi(digits);
}

analysis::CurveModel model_of(const CurveRequest& request) {
  analysis::CurveModel model;
  for (const analysis::CurveFamilyTraits& one : analysis::curve_families()) {
    if (one.name == request.family) model.family = one.family;
  }
  model.log_axis = request.axis == "log";
  const std::optional<double> by_task = guess_of_task(request.task);
  if (request.guess == "free") {
    model.free_guess = true;
  } else if (!request.guess.empty()) {
    model.guess_rate = std::stod(request.guess);
  }
  if (by_task && !request.guess.empty() &&
      (model.free_guess || std::fabs(model.guess_rate - *by_task) > 1e-12)) {
    throw UsageError(fmt::format(
        "--task {} has a guess rate of {:.4g}: expected no --guess beside it, found --guess {}",
        request.task, *by_task, request.guess));
  }
  if (by_task) model.guess_rate = *by_task;
  model.free_lapse = request.lapse == "free";
  if (!model.free_lapse) model.lapse_rate = std::stod(request.lapse);
  model.symmetric = request.symmetric;
  if (model.symmetric && model.free_guess) {
    throw UsageError(
        "--symmetric: expected with a guess rate that is known, found --guess free; without "
        "--symmetric both ends are free");
  }
  const double lapses = model.lapse_rate * (model.symmetric ? 2.0 : 1.0);
  if (model.guess_rate + lapses >= 1.0) {
    throw UsageError(fmt::format(
        "--lapse: expected a rate that leaves the curve a rise above a guess rate of {:.4g}, "
        "found {:.4g}",
        model.guess_rate, model.lapse_rate));
  }
  return model;
}

/// The lowest and the highest proportion, as answered, that a curve can approach.
struct CurveReach {
  double low = 0.0, high = 1.0;
};

CurveReach reach_of(const analysis::CurveModel& model) {
  const double lapse = model.free_lapse ? 0.0 : model.lapse_rate;
  const double guess = model.free_guess ? 0.0 : model.guess_rate;
  return {.low = guess + (model.symmetric ? lapse : 0.0), .high = 1.0 - lapse};
}

/// Turns the proportions that were asked for into levels. If a curve's rates are known, the
/// levels are the same for every group, so they are treated like any other level.
void settle_proportions(const CurveRequest& request, analysis::CurveOptions& options) {
  const analysis::CurveModel& model = options.model;
  const CurveReach reach = reach_of(model);
  for (const double proportion : request.at_proportion) {
    if (!(proportion > reach.low && proportion < reach.high)) {
      throw UsageError(fmt::format(
          "--at-proportion: expected proportions as answered between {:.4g}, the lower end of "
          "the curve, and {:.4g}, its upper end, found {:.4g}; --at takes levels from 0 to 1 "
          "between these ends",
          reach.low, reach.high, proportion));
    }
    if (model.free_guess || model.free_lapse) {
      options.at_proportion.push_back(proportion);
      continue;
    }
    const double level = (proportion - reach.low) / (reach.high - reach.low);
    const bool is_told = std::ranges::any_of(
        options.at, [level](double at) { return std::fabs(at - level) < 1e-12; });
    if (!is_told) options.at.push_back(level);
  }
}

/// A word as a shell takes it: in quotes if it contains characters that mean something there.
std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./:=,+@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char letter : text)
    quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

}  // namespace

void require_request(const CurveRequest& request) {
  if (request.falling && request.rising) {
    throw UsageError("--falling, --rising: expected one of them, found both");
  }
  if (request.compare && request.group_by.empty()) {
    throw UsageError(
        "--compare: expected with --group-by COLUMN, which says what is compared, found "
        "without");
  }
  for (const double at : request.at) {
    if (at > 0.0 && at < 1.0) continue;
    throw UsageError(
        fmt::format("--at: expected numbers between 0 and 1, such as 0.75, found {}", at));
  }
  for (const double proportion : request.at_proportion) {
    if (proportion > 0.0 && proportion < 1.0) continue;
    throw UsageError(
        fmt::format("--at-proportion: expected numbers between 0 and 1, such as 0.75, found {}",
                    proportion));
  }
  const bool has_free_rate = request.lapse == "free" || request.guess == "free";
  if (!request.at_proportion.empty() && request.compare && has_free_rate) {
    throw UsageError(
        "--at-proportion: expected known rates beside --compare, for with a free rate a "
        "proportion is another level of each curve, found a rate that is free; say --at with "
        "a level instead, or leave --compare out");
  }
  if (!(request.jnd_at > 0.0 && request.jnd_at < 1.0) || request.jnd_at == 0.5) {
    throw UsageError(
        fmt::format("--jnd-at: expected a number between 0 and 1 that is not 0.5, found {}",
                    request.jnd_at));
  }
  if (!request.lapse_prior.empty() && !(request.posterior && has_free_rate)) {
    throw UsageError(fmt::format(
        "--lapse-prior {}: expected with --posterior and a rate that is free, found without; "
        "add --posterior --lapse free, or leave it out",
        request.lapse_prior));
  }
}

analysis::CurveOptions options_of(const CurveRequest& request) {
  const bool has_prior = !request.lapse_prior.empty();
  analysis::CurveOptions options = {
      .model = model_of(request),
      .at = request.at,
      .jnd_at = request.jnd_at,
      .num_bootstrap = request.num_bootstrap,
      .bootstrap_kind = request.bootstrap_kind == "nonparametric"
                            ? analysis::BootstrapKind::kNonparametric
                            : analysis::BootstrapKind::kParametric,
      .posterior = request.posterior,
      .rate_prior = has_prior
                        ? beta_prior_of("--lapse-prior", request.lapse_prior, kLargestGridPrior)
                        : analysis::kUsualRatePrior,
      .prior_sensitivity = has_prior,
      .num_goodness = request.num_goodness,
      .seed = request.seed};
  settle_proportions(request, options);
  return options;
}

std::string command_of(const CurveRequest& request) {
  const CurveRequest plain;
  std::string text = "jnd fit psychometric";
  const auto say = [&](const char* option, const std::string& value,
                       const std::string& unsaid = "") {
    if (value != unsaid) text += std::string(" ") + option + " " + shell_word(value);
  };
  const auto flag = [&](const char* option, bool is_set) {
    if (is_set) text += std::string(" ") + option;
  };
  const auto count = [&](const char* option, auto value, auto unsaid) {
    if (value != unsaid) text += fmt::format(" {} {}", option, value);
  };
  say("--csv", request.csv);
  say("--intensity", request.intensity, plain.intensity);
  say("--yes", request.yes);
  say("--yes-value", request.yes_value);
  say("--trials", request.trials);
  for (const std::string& one : request.where) say("--where", one);
  say("--group-by", fmt::format("{}", fmt::join(request.group_by, ",")));
  say("--family", request.family, plain.family);
  say("--axis", request.axis, plain.axis);
  say("--task", request.task);
  say("--guess", request.guess);
  say("--lapse", request.lapse, plain.lapse);
  flag("--symmetric", request.symmetric);
  flag("--falling", request.falling);
  flag("--rising", request.rising);
  // If proportions are given, `at` has no default.
  const std::vector<double> unsaid =
      request.at_proportion.empty() ? plain.at : std::vector<double>();
  say("--at", fmt::format("{}", fmt::join(request.at, ",")),
      fmt::format("{}", fmt::join(unsaid, ",")));
  say("--at-proportion", fmt::format("{}", fmt::join(request.at_proportion, ",")));
  count("--jnd-at", request.jnd_at, plain.jnd_at);
  count("--bootstrap", request.num_bootstrap, plain.num_bootstrap);
  say("--bootstrap-kind", request.bootstrap_kind, plain.bootstrap_kind);
  flag("--posterior", request.posterior);
  say("--lapse-prior", request.lapse_prior);
  count("--goodness", request.num_goodness, plain.num_goodness);
  count("--seed", request.seed, plain.seed);
  flag("--compare", request.compare);
  return text;
}

}  // namespace jnd::app
