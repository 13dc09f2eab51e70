#include "app/commands/fit_psychometric.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/fits/curve_json.h"
#include "analysis/report/single_figure.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/commands/answer_options.h"
#include "app/commands/fit_figures.h"
#include "app/commands/fit_script.h"
#include "app/commands/psychometric_words.h"
#include "app/curves/curve_analysis.h"
#include "app/curves/curve_request.h"
#include "app/curves/curve_table.h"
#include "app/curves/prior_options.h"

namespace jnd::app {
namespace {

using analysis::CurveFit;
using analysis::FitStatus;

struct FitPsychometricOptions : CurveRequest {
  std::string figure, script;
  bool as_csv = false;
};

/// Asks what the task was if the answers look like right answers and nobody said it.
void ask_for_task(const CurveAnalysis& curves) {
  if (!curves.suspected_chance) return;
  const ExportedAnswers exported = exported_answers(curves.file.columns, curves.request.yes);
  if (exported == ExportedAnswers::kRight) {
    throw UsageError(fmt::format(
        "{}: is_right is the right interval of three: expected --task mafc:3 if the block's "
        "task "
        "is three_interval or oddity, --task mafc:2 if it is abx or match_to_sample, found no "
        "--task",
        curves.request.csv));
  }
  if (exported == ExportedAnswers::kVaried) {
    throw UsageError(fmt::format(
        "{}: what a response is depends on how the block asks: expected --yes is_test_chosen, "
        "is_felt, is_called_different or is_right, whichever is not empty in the block, found "
        "--yes response",
        curves.request.csv));
  }
  if (curves.is_suspected_by_name) {
    throw UsageError(fmt::format(
        "{}: {} sounds like right answers, which chance alone gives in a forced choice: say "
        "--task mafc:M if it was one among M, --task yes-no if a yes is what was felt",
        curves.request.csv, curves.request.yes));
  }
  const double chance = *curves.suspected_chance;
  const long alternatives = std::lround(1.0 / chance);
  throw UsageError(fmt::format(
      "{}: the answers look like right ones of a forced choice among {}, for no level lies "
      "below {:.3g} %: say --task mafc:{} if they are, --task yes-no if they are not",
      curves.request.csv, alternatives, 100.0 * chance, alternatives));
}

void require_options(const FitPsychometricOptions& options) {
  require_request(options);
  if (static_cast<int>(options.json) + static_cast<int>(options.as_csv) +
          static_cast<int>(!options.script.empty()) >
      1) {
    throw UsageError("--json, --as-csv, --script: expected one of them at most, found several");
  }
  if (options.compare && (options.as_csv || !options.script.empty())) {
    throw UsageError(fmt::format(
        "--compare: expected a table for people or --json beside it, found {}, which holds the "
        "fits alone; run it once with --compare --json and once without --compare",
        options.as_csv ? "--as-csv" : "--script"));
  }
  if (!options.figure.empty()) analysis::require_figure_file(options.figure);
}

void print_json(const CurveAnalysis& curves, const std::vector<std::string>& notes) {
  using Json = nlohmann::ordered_json;
  const CurveRequest& request = curves.request;
  Json all = Json::array();
  for (std::size_t i = 0; i < curves.fits.size(); ++i) {
    Json json;
    json["group"] = Json::object();
    for (const auto& [column, value] : curves.file.groups[i].key) json["group"][column] = value;
    json.update(analysis::to_json(curves.fits[i]));
    all.push_back(std::move(json));
  }
  Json document = {{"fits", std::move(all)},
                   {"num_rows", curves.file.num_rows},
                   {"num_rows_elsewhere", curves.file.num_elsewhere},
                   {"num_rows_missing", Json(curves.file.num_missing)},
                   {"notes", notes}};
  if (request.num_bootstrap > 0 || request.num_goodness > 0) document["seed"] = request.seed;
  if (curves.comparison) document["comparison"] = analysis::to_json(*curves.comparison);
  fmt::print("{}\n", json_text(document));
}

int fit_psychometric(const FitPsychometricOptions& options) {
  require_options(options);
  CurveAnalysis curves = read_curves(options);
  std::vector<std::string> notes = notes_of(curves.file, options);
  if (curves.found_falling) {
    notes.emplace_back(
        "the answers fall as the intensity grows, so a falling curve is fitted; --rising "
        "insists on one that rises");
  }
  ask_for_task(curves);
  fit_curves(curves);
  if (options.compare) add_comparison(curves);
  if (options.json) {
    print_json(curves, notes);
  } else if (options.as_csv) {
    fmt::print("{}", curves_as_csv(curves.file.groups, curves.fits));
  } else if (!options.script.empty()) {
    fmt::print("{}", script_of_fit(
                         options.script == "r" ? ScriptLanguage::kR : ScriptLanguage::kPython,
                         options, curves.how, curves.fits));
  } else {
    print_curves(curves.names, curves.fits, notes);
    if (curves.comparison) print_comparison(*curves.comparison);
  }
  if (!options.figure.empty() && !curves.fits.empty()) save_picture(curves, options.figure);
  std::size_t num_lacking = 0;
  std::string reason;
  for (const CurveFit& fit : curves.fits) {
    if (fit.status != FitStatus::kOk && num_lacking++ == 0) reason = fit.reason;
  }
  if (curves.file.num_rows == 0 || curves.fits.empty()) {
    fmt::print(stderr, "jnd: {}: expected rows with answers, found none\n", options.csv);
    return kHasProblems;
  }
  if (num_lacking > 0) {
    fmt::print(stderr,
               "jnd: {}: expected a psychometric function in every group, found none in {} of "
               "{}: {}\n",
               options.csv, num_lacking, curves.fits.size(), reason);
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
  invocation.examples[&command] = {
      {"jnd fit psychometric --csv trials.csv --intensity level --yes correct --task mafc:2",
       "the curve of a forced choice between two"}};
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
      .add_option("--at-proportion", options->at_proportion,
                  "thresholds at these proportions as answered, between guess rate and 1 - "
                  "lapse rate: 0.75 of two alternatives is 75 % right. Without --at they are "
                  "the only ones")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("PROPORTION[,PROPORTION,..]");
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
  command.add_option("--lapse-prior", options->lapse_prior, kLapsePriorHelp)
      ->option_text("A,B [1,10]");
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
  command.callback([&invocation, &command, options] {
    if (!options->at_proportion.empty() && command.count("--at") == 0) options->at.clear();
    invocation.run = [options] { return fit_psychometric(*options); };
  });
}

}  // namespace jnd::app
