#include "app/commands/fit_psychometric.h"
#include "app/commands/fit_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/fits/chance_level.h"
#include "analysis/fits/curve_comparison.h"
#include "analysis/fits/curve_fit.h"
#include "analysis/fits/curve_json.h"
#include "analysis/report/curve_figure.h"
#include "analysis/report/single_figure.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/commands/answer_options.h"
#include "app/commands/fit_script.h"
#include "app/commands/fit_words.h"
#include "app/commands/psychometric_words.h"

namespace jnd::app {
namespace {

using analysis::CurveFit;
using analysis::FitStatus;

struct FitPsychometricOptions : AnswerOptions {
  std::string family = "normal", axis = "linear", task, guess, lapse = "0";
  std::string bootstrap_kind = "parametric", figure, script;
  bool symmetric = false, falling = false, rising = false;
  bool compare = false, posterior = false, as_csv = false;
  std::vector<double> at = {0.5};
  double jnd_at = analysis::CurveOptions{}.jnd_at;
  int num_bootstrap = 0, num_goodness = 0;
  std::uint64_t seed = 1;
};

/// The guess rate of "mafc:3" is 1/3.
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

analysis::CurveModel model_of(const FitPsychometricOptions& options) {
  analysis::CurveModel model;
  for (const analysis::CurveFamilyTraits& one : analysis::curve_families()) {
    if (one.name == options.family) model.family = one.family;
  }
  model.log_axis = options.axis == "log";
  const std::optional<double> by_task = guess_of_task(options.task);
  if (options.guess == "free") {
    model.free_guess = true;
  } else if (!options.guess.empty()) {
    model.guess_rate = std::stod(options.guess);
  }
  if (by_task && !options.guess.empty() &&
      (model.free_guess || std::fabs(model.guess_rate - *by_task) > 1e-12)) {
    throw UsageError(fmt::format(
        "--task {} has a guess rate of {:.4g}: expected no --guess beside it, found --guess {}",
        options.task, *by_task, options.guess));
  }
  if (by_task) model.guess_rate = *by_task;
  model.free_lapse = options.lapse == "free";
  if (!model.free_lapse) model.lapse_rate = std::stod(options.lapse);
  model.symmetric = options.symmetric;
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

/// The answers of all groups on an axis of which the logarithm is that of the curve.
std::vector<analysis::AnswerCount> all_for_chance(
    const std::vector<std::vector<analysis::AnswerCount>>& groups,
    const analysis::CurveModel& model) {
  std::vector<analysis::AnswerCount> all;
  for (const auto& rows : groups) all.insert(all.end(), rows.begin(), rows.end());
  analysis::CurveModel plain = model;
  plain.free_guess = plain.free_lapse = plain.symmetric = plain.falling = false;
  plain.guess_rate = plain.lapse_rate = 0.0;
  constexpr std::size_t kMostLevels = 60;
  const analysis::PsychometricLevels levels =
      analysis::binned(analysis::levels_of(all, plain), kMostLevels);
  std::vector<analysis::AnswerCount> rows;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    rows.push_back({std::exp((model.falling ? -2.0 : 2.0) * levels.abscissa[i]),
                    static_cast<std::int64_t>(levels.num_yes[i]),
                    static_cast<std::int64_t>(levels.num_trials[i])});
  }
  return rows;
}

/// Asks what the task was where the answers look like right ones, and nobody said.
void ask_for_task(const FitPsychometricOptions& options,
                  const std::vector<std::vector<analysis::AnswerCount>>& groups,
                  const analysis::CurveModel& model) {
  if (!options.task.empty() || !options.guess.empty()) return;
  const std::optional<double> chance =
      analysis::suspected_chance(all_for_chance(groups, model));
  if (!chance) return;
  const long alternatives = std::lround(1.0 / *chance);
  throw UsageError(fmt::format(
      "{}: the answers look like right ones of a forced choice among {}, for no level lies "
      "below {:.3g} %: say --task mafc:{} if they are, --task yes-no if they are not",
      options.csv, alternatives, 100.0 * *chance, alternatives));
}

void require_options(const FitPsychometricOptions& options) {
  if (options.falling && options.rising) {
    throw UsageError("--falling, --rising: expected one of them, found both");
  }
  if (static_cast<int>(options.json) + static_cast<int>(options.as_csv) +
          static_cast<int>(!options.script.empty()) >
      1) {
    throw UsageError("--json, --as-csv, --script: expected one of them at most, found several");
  }
  if (options.compare && options.group_by.empty()) {
    throw UsageError(
        "--compare: expected with --group-by COLUMN, which says what is compared, found "
        "without");
  }
  for (const double at : options.at) {
    if (at > 0.0 && at < 1.0) continue;
    throw UsageError(
        fmt::format("--at: expected numbers between 0 and 1, such as 0.75, found {}", at));
  }
  if (!(options.jnd_at > 0.0 && options.jnd_at < 1.0) || options.jnd_at == 0.5) {
    throw UsageError(
        fmt::format("--jnd-at: expected a number between 0 and 1 that is not 0.5, found {}",
                    options.jnd_at));
  }
  if (!options.figure.empty()) analysis::require_figure_file(options.figure);
}

void print_json(const FitPsychometricOptions& options, const analysis::AnswerFile& file,
                const std::vector<CurveFit>& fits, const std::vector<std::string>& notes,
                const std::optional<analysis::CurveComparison>& comparison) {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (std::size_t i = 0; i < fits.size(); ++i) {
    Json json;
    json["group"] = Json::object();
    for (const auto& [column, value] : file.groups[i].key) json["group"][column] = value;
    json.update(analysis::to_json(fits[i]));
    all.push_back(std::move(json));
  }
  Json document = {{"fits", std::move(all)},
                   {"num_rows", file.num_rows},
                   {"num_rows_elsewhere", file.num_elsewhere},
                   {"num_rows_missing", Json(file.num_missing)},
                   {"notes", notes}};
  if (options.num_bootstrap > 0 || options.num_goodness > 0) document["seed"] = options.seed;
  if (comparison) document["comparison"] = analysis::to_json(*comparison);
  fmt::print("{}\n", json_text(document));
}

std::vector<CurveFit> fits_of(const std::vector<std::vector<analysis::AnswerCount>>& groups,
                              const analysis::CurveOptions& how) {
  std::vector<CurveFit> fits;
  for (const auto& rows : groups) fits.push_back(analysis::fit_curve(rows, how));
  return fits;
}

int fit_psychometric(const FitPsychometricOptions& options) {
  require_options(options);
  analysis::CurveOptions how = {.model = model_of(options),
                                .at = options.at,
                                .jnd_at = options.jnd_at,
                                .num_bootstrap = options.num_bootstrap,
                                .bootstrap_kind = options.bootstrap_kind == "nonparametric"
                                                      ? analysis::BootstrapKind::kNonparametric
                                                      : analysis::BootstrapKind::kParametric,
                                .posterior = options.posterior,
                                .num_goodness = options.num_goodness,
                                .seed = options.seed};
  analysis::AnswerFile file = read_answers(options, !how.model.is_logarithmic());
  std::vector<std::vector<analysis::AnswerCount>> groups;
  for (analysis::AnswerGroup& group : file.groups) {
    groups.push_back(rows_of(group));
    group.tallies = {};
  }
  std::vector<std::string> notes = notes_of(file, options);
  how.model.falling = options.falling || (!options.rising && analysis::answers_fall(groups));
  if (how.model.falling && !options.falling) {
    notes.emplace_back(
        "the answers fall as the intensity grows, so a falling curve is fitted; --rising "
        "insists on one that rises");
  }
  if (how.model.falling && how.model.symmetric && how.model.guess_rate > 0.0) {
    throw UsageError("--symmetric: expected without guesses for a curve that falls");
  }
  ask_for_task(options, groups, how.model);
  const std::vector<CurveFit> fits = fits_of(groups, how);
  std::optional<analysis::CurveComparison> comparison;
  if (options.compare) {
    std::vector<analysis::ComparedGroup> compared;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      compared.push_back({words_of(file.groups[i]), groups[i]});
    }
    comparison = analysis::compare_curves(compared, how);
  }
  std::vector<std::string> names;
  for (const analysis::AnswerGroup& group : file.groups) names.push_back(words_of(group));
  if (options.json) {
    print_json(options, file, fits, notes, comparison);
  } else if (options.as_csv) {
    print_curves_as_csv(file.groups, fits);
  } else if (!options.script.empty()) {
    fmt::print("{}", script_of_fit(
                         options.script == "r" ? ScriptLanguage::kR : ScriptLanguage::kPython,
                         options, how, fits));
  } else {
    print_curves(names, fits, notes);
    if (comparison) print_comparison(*comparison);
  }
  if (!options.figure.empty()) {
    analysis::write_single_figure(
        analysis::curve_figure(names, fits, options.intensity, options.yes), options.figure);
  }
  std::size_t num_lacking = 0;
  std::string reason;
  for (const CurveFit& fit : fits) {
    if (fit.status != FitStatus::kOk && num_lacking++ == 0) reason = fit.reason;
  }
  if (file.num_rows == 0 || fits.empty()) {
    fmt::print(stderr, "jnd: {}: expected rows with answers, found none\n", options.csv);
    return kHasProblems;
  }
  if (num_lacking > 0) {
    fmt::print(stderr,
               "jnd: {}: expected a psychometric function in every group, found none in {} of "
               "{}: {}\n",
               options.csv, num_lacking, fits.size(), reason);
    return kHasProblems;
  }
  return kDone;
}

std::string family_help() {
  std::string words =
      "the curve's form between guess and lapse rate, with its location and scale:";
  for (const analysis::CurveFamilyTraits& one : analysis::curve_families()) {
    words += fmt::format(" {} {};", one.name, analysis::formula_words(one.family, false));
  }
  words.back() = '.';
  return words + " On a logarithmic axis ln x stands for x, but for weibull";
}

}  // namespace

void add_fit_psychometric(CLI::App& fit, Invocation& invocation) {
  const auto options = std::make_shared<FitPsychometricOptions>();
  CLI::App& command =
      *fit.add_subcommand("psychometric", "Psychometric functions from anybody's answers");
  add_answer_options(command, *options);
  std::vector<std::string> families;
  for (const analysis::CurveFamilyTraits& one : analysis::curve_families()) {
    families.emplace_back(one.name);
  }
  command.add_option("--family", options->family, family_help())
      ->check(CLI::IsMember(families))
      ->capture_default_str();
  command
      .add_option("--axis", options->axis,
                  "over the intensity, of any sign, or its logarithm; weibull is over "
                  "intensities >= 0 whatever this says")
      ->check(CLI::IsMember({"linear", "log"}))
      ->capture_default_str();
  command
      .add_option("--task", options->task,
                  "what the proportions are of: yes and no, or right answers of a forced "
                  "choice, whose guess rate is 1/M")
      ->option_text("yes-no|mafc:M");
  command.add_option("--guess", options->guess, "lower end of the curve, or `free` to fit it")
      ->transform(rate({"free"}))
      ->option_text("RATE|free [0]");
  command
      .add_option("--lapse", options->lapse,
                  "distance of the upper end from 1, or `free` to fit it")
      ->transform(rate({"free"}))
      ->option_text("RATE|free [0]");
  command.add_flag("--symmetric", options->symmetric,
                   "lapses at both ends: guess + lapse + (1 - guess - 2 lapse) F");
  command.add_flag("--falling", options->falling,
                   "the curve falls; without it and --rising, as the answers do");
  command.add_flag("--rising", options->rising, "the curve rises");
  command
      .add_option(
          "--at", options->at,
          "thresholds at these levels of the curve between guess and lapse rate, from 0 "
          "to 1: 0.75 of two alternatives is 87.5 % right")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("LEVEL[,LEVEL,..] [0.5]");
  command
      .add_option("--jnd-at", options->jnd_at,
                  "the JND is the distance from level 0.5 to this one")
      ->option_text("LEVEL [0.8413]");
  command.add_option("--bootstrap", options->num_bootstrap, "refits for bootstrap intervals")
      ->check(whole_number(0, 10'000'000));
  command
      .add_option("--bootstrap-kind", options->bootstrap_kind,
                  "answers drawn from the curve, or from the answers within each level")
      ->check(CLI::IsMember({"parametric", "nonparametric"}))
      ->capture_default_str();
  command.add_flag("--posterior", options->posterior,
                   "also medians and intervals of the posterior, with its priors");
  command.add_option("--goodness", options->num_goodness, "redraws for the goodness of fit")
      ->check(whole_number(0, 10'000'000));
  command.add_option("--seed", options->seed, "of bootstrap and goodness of fit")
      ->check(seed_number())
      ->capture_default_str();
  command.add_flag("--compare", options->compare,
                   "which parameters differ between the groups, and how far their thresholds "
                   "are apart");
  add_figure_option(command, options->figure);
  command
      .add_option("--script", options->script,
                  "print a script that repeats the fit without this program")
      ->check(CLI::IsMember({"r", "python"}));
  command.add_flag("--as-csv", options->as_csv, "print a table, a row for each threshold");
  command.add_flag("--json", options->json, "print one JSON document");
  command.callback([&invocation, options] {
    invocation.run = [options] { return fit_psychometric(*options); };
  });
}

}  // namespace jnd::app
