#include "app/commands/fit_glmm.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "analysis/mixed/mixed_json.h"
#include "analysis/report/single_figure.h"
#include "analysis/statistics/summary.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/commands/fit_figures.h"
#include "app/commands/fit_tables.h"
#include "app/commands/glmm_options.h"
#include "core/parallel.h"

namespace jnd::app {
namespace {

using analysis::FitStatus;
using analysis::FormulaError;

[[noreturn]] void throw_formula(const char* option, const FormulaError& error) {
  throw UsageError(fmt::format("{}: {}\n{}", option, error.what(), error.picture));
}

analysis::MixedFormulas formulas_of(const FitGlmmOptions& options, const std::string& fixed) {
  analysis::MixedFormulas formulas;
  try {
    formulas.fixed = analysis::parse_formula(fixed);
  } catch (const FormulaError& error) {
    throw_formula("--fixed", error);
  }
  try {
    for (const std::string& one : options.random) {
      for (analysis::RandomTerm& term : analysis::parse_random_terms(one)) {
        formulas.random.push_back(std::move(term));
      }
    }
  } catch (const FormulaError& error) {
    throw_formula("--random", error);
  }
  return formulas;
}

/// A name in the form in which a formula reads it.
std::string in_formula(const std::string& name) {
  const bool is_plain = std::ranges::all_of(name, [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' ||
           letter == '.';
  });
  return is_plain ? name : "`" + name + "`";
}

bool has_history(const FitGlmmOptions& options) { return options.terms == "history"; }

/// The fixed effects, together with those of the previous trial.
std::string whole_fixed(const FitGlmmOptions& options) {
  if (!has_history(options)) return options.fixed;
  return options.fixed + " + " + in_formula(analysis::previous_stimulus(options.stimulus)) +
         " + " + analysis::kPreviousAnswer;
}

void require_glmm_options(const FitGlmmOptions& options) {
  if (options.script == "python") {
    throw UsageError(
        "--script python: expected r, found python, for which no package has this model: the "
        "mixed binomial models of statsmodels are Bayesian approximations; --script r writes "
        "one for lme4");
  }
  if (options.json && !options.script.empty()) {
    throw UsageError("--json, --script: expected one of them at most, found both");
  }
  if (!options.group_by.empty() && !options.script.empty()) {
    throw UsageError(
        "--script: expected without --group-by, found with it; --where COLUMN=CELL takes one "
        "group");
  }
  if (!options.figure.empty()) {
    if (!options.group_by.empty()) {
      throw UsageError(
          "--figure: expected without --group-by, found with it; --where COLUMN=CELL takes one "
          "group, and a condition in --fixed has the curves of all in one figure");
    }
    if (options.stimulus.empty()) {
      throw UsageError(
          "--figure: expected with --stimulus COLUMN, over which the curves are drawn, found "
          "without");
    }
    analysis::require_figure_file(options.figure);
  }
  if (has_history(options) && options.stimulus.empty()) {
    throw UsageError(
        "--terms history: expected with --stimulus COLUMN, of which the value before is taken, "
        "found without");
  }
  if (options.num_bootstrap > 0 && options.stimulus.empty()) {
    throw UsageError(
        "--bootstrap: expected with --stimulus COLUMN, of whose PSE and JND it is, found "
        "without");
  }
  if (!(options.jnd_at > 0.0 && options.jnd_at < 1.0) || options.jnd_at == 0.5) {
    throw UsageError(
        fmt::format("--jnd-at: expected a number between 0 and 1 that is not 0.5, found {}",
                    options.jnd_at));
  }
  if (!options.says_guess && analysis::is_called_right(options.yes)) {
    throw UsageError(fmt::format(
        "{}: {} sounds like right answers, which chance alone gives in a forced choice: say "
        "--guess 0.5 if it was one of two, --guess 0 if a yes is what was felt",
        options.csv, options.yes));
  }
  if (std::stod(options.guess) + std::stod(options.lapse) >= 1.0) {
    throw UsageError(fmt::format(
        "--lapse: expected a rate that leaves the curve a rise above --guess {}, found {}",
        options.guess, options.lapse));
  }
}

/// Throws `UsageError` if a formula contains a column by which rows are grouped.
void require_group_columns(const FitGlmmOptions& options,
                           const std::vector<std::string>& of_formulas) {
  for (const std::string& column : options.group_by) {
    if (std::ranges::find(of_formulas, column) == of_formulas.end()) continue;
    throw UsageError(
        fmt::format("--group-by: expected columns that no formula names, found {}; within a "
                    "group it does not vary",
                    column));
  }
}

/// The table with the columns that the formulas name, and those by which rows are grouped.
analysis::TrialTable read_glmm_table(const FitGlmmOptions& options,
                                     const analysis::MixedFormulas& formulas) {
  analysis::TrialColumns columns{.answers = answer_words(options),
                                 .variables = analysis::columns_of(formulas),
                                 .where = where_of(options)};
  if (has_history(options)) {
    std::erase(columns.variables, analysis::previous_stimulus(options.stimulus));
    std::erase(columns.variables, analysis::kPreviousAnswer);
  }
  require_group_columns(options, columns.variables);
  for (const std::string& column : options.group_by) {
    if (std::ranges::find(columns.variables, column) == columns.variables.end()) {
      columns.variables.push_back(column);
    }
  }
  try {
    return analysis::read_trial_table(options.csv, columns);
  } catch (const analysis::UnknownColumn& unknown) {
    if (std::ranges::find(options.group_by, unknown.column) != options.group_by.end()) {
      throw UsageError(fmt::format("--group-by: expected a column of {}, found {}",
                                   unknown.known, unknown.column));
    }
    const bool is_fixed = std::ranges::any_of(
        formulas.fixed.variables,
        [&](const auto& variable) { return variable.column == unknown.column; });
    throw_formula(is_fixed ? "--fixed" : "--random",
                  analysis::unknown_in(formulas, unknown.column, unknown.known));
  }
}

/// What was left out of the whole file, one sentence each.
std::vector<std::string> notes_of_file(const analysis::TrialTable& table) {
  std::vector<std::string> notes;
  if (table.num_elsewhere > 0) {
    notes.push_back(fmt::format("left out {} of {} rows by --where", table.num_elsewhere,
                                table.num_rows_in_file));
  }
  for (const auto& [column, number] : table.num_missing) {
    notes.push_back(fmt::format("left out {} of {} rows, which have nothing in the column {}",
                                number, table.num_rows_in_file, column));
  }
  if (table.num_without_trials > 0) {
    notes.push_back(fmt::format("left out {} of {} rows, which have no trials",
                                table.num_without_trials, table.num_rows_in_file));
  }
  return notes;
}

void add_trial_before(const FitGlmmOptions& options, GlmmResult& result) {
  if (!has_history(options)) return;
  const std::string& person = result.formulas.random.front().group_columns.front();
  const std::size_t num_first = analysis::add_history(result.table, options.stimulus, person);
  result.notes.push_back(fmt::format(
      "{} is the stimulus and {} the answer (1 for yes) of the row before of the same {}; left "
      "out {} rows, which are the first of theirs",
      analysis::previous_stimulus(options.stimulus), analysis::kPreviousAnswer, person,
      num_first));
}

/// The grouping that has the fewest groups, and their number.
const std::pair<std::string, std::size_t>& fewest_groups(const GlmmResult& result) {
  return *std::ranges::min_element(result.groups, {},
                                   &std::pair<std::string, std::size_t>::second);
}

/// Says why the bootstrap gives no interval.
void add_caution_of_bootstrap(const FitGlmmOptions& options, GlmmResult& result) {
  if (options.num_bootstrap == 0) return;
  const std::size_t num_groups = fewest_groups(result).second;
  const std::optional<std::size_t> needed = analysis::num_redraws_needed(num_groups);
  if (!needed) {
    result.notes.push_back(fmt::format(
        "the bootstrap has no interval with fewer than {} groups of a random effect",
        analysis::kFewestResampled));
  } else if (static_cast<std::size_t>(options.num_bootstrap) < *needed) {
    result.notes.push_back(fmt::format(
        "the bootstrap has no interval with {} redraws: percentiles of {} groups, which reach "
        "as far as Student's t, need {} or more",
        options.num_bootstrap, num_groups, *needed));
  } else if (result.num_without_fit >
             analysis::expanded_tail(num_groups) * options.num_bootstrap) {
    result.notes.push_back(fmt::format(
        "the bootstrap has no interval, for {} of {} redraws had no fit and may lie beyond "
        "either end",
        result.num_without_fit, options.num_bootstrap));
  }
}

/// Says whose groups decide how wide the intervals are, where there are several groupings.
void add_note_of_groups(GlmmResult& result) {
  if (result.groups.size() < 2) return;
  const auto& [name, number] = fewest_groups(result);
  result.notes.push_back(
      fmt::format("intervals of PSE and JND go by the {} groups of {}, which are the fewest",
                  number, name));
}

void add_derived(const FitGlmmOptions& options, const analysis::MixedOptions& how,
                 const analysis::MixedRefit& refit, GlmmResult& result) {
  analysis::MixedUncertainty uncertainty = {.covariance = result.fit.fixed_covariance,
                                            .num_groups = fewest_groups(result).second,
                                            .redrawn = {}};
  std::vector<Eigen::VectorXd>& redrawn = uncertainty.redrawn;
  redrawn.resize(static_cast<std::size_t>(options.num_bootstrap));
  const int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  core::for_each_index(redrawn.size(), jobs, [&](std::size_t i) {
    redrawn[i] = refit.redrawn(options.seed, static_cast<std::int64_t>(i));
  });
  result.num_without_fit = static_cast<int>(std::ranges::count_if(
      redrawn, [](const Eigen::VectorXd& one) { return one.size() == 0; }));
  result.degrees_of_freedom = static_cast<int>(uncertainty.num_groups) - 1;
  result.derived = analysis::derived_quantities(result.lines, how.curve.link, options.jnd_at,
                                                result.fit.estimates(), uncertainty);
  add_note_of_groups(result);
  add_caution_of_bootstrap(options, result);
  for (const std::string& name : result.lines.held) {
    result.notes.push_back(
        fmt::format("PSE and JND are where {} is at its mean over the trials", name));
  }
  for (const analysis::MixedCell& cell : result.lines.cells) {
    const double slope = cell.slope.dot(result.fit.estimates());
    const double error = std::sqrt(cell.slope.dot(result.fit.fixed_covariance * cell.slope));
    if (std::fabs(slope) > 1.96 * error) continue;
    result.notes.push_back(fmt::format(
        "the curve{} is not steeper than none by two standard errors, so that its PSE and JND "
        "have no interval worth the name; --bootstrap shows how far they scatter",
        cell.name.empty() ? "" : " of " + cell.name));
  }
}

/// Adds cautions about what makes standard errors too small in any fit.
void add_cautions(GlmmResult& result) {
  std::map<std::string, std::vector<std::string>> same_for_all;
  for (const analysis::EffectOfAll& one :
       analysis::effects_of_all(result.formulas, result.table)) {
    if (!one.column.starts_with("previous_")) same_for_all[one.group].push_back(one.effect);
  }
  for (const auto& [group, effects] : same_for_all) {
    result.notes.push_back(fmt::format(
        "the model takes the effect of {} as the same in each {}, within which it differs: "
        "where "
        "the effects are not the same, their standard errors and p are far too small; --random "
        "\"1 + {} | {}\" lets them differ",
        fmt::join(effects, " and of "), group, fmt::join(effects, " + "), group));
  }
  constexpr std::size_t kFewGroups = 20;
  for (const auto& [name, number] : result.groups) {
    if (number >= kFewGroups) continue;
    result.notes.push_back(
        fmt::format("z and p hold for many groups: with {} of {} they are somewhat too sure",
                    number, name));
  }
}

/// Fits the model to the result's table.
void fit_glmm_table(const FitGlmmOptions& options, GlmmResult& result) {
  add_trial_before(options, result);
  const auto contrasts =
      options.contrasts == "sum" ? analysis::Contrasts::kSum : analysis::Contrasts::kTreatment;
  const analysis::MixedOptions how = {.curve = {.link = *analysis::mixed_link(options.link),
                                                .guess_rate = std::stod(options.guess),
                                                .lapse_rate = std::stod(options.lapse)},
                                      .num_nodes = options.num_nodes};
  std::optional<analysis::Design>& design = result.design;
  try {
    design.emplace(result.formulas.fixed, result.table, contrasts);
    if (!options.stimulus.empty()) {
      result.lines = analysis::stimulus_lines(result.formulas.fixed, *design, result.table,
                                              options.stimulus);
    }
  } catch (const FormulaError& error) {
    throw_formula("--fixed", error);
  }
  analysis::MixedData data;
  try {
    data = analysis::mixed_data(result.formulas, *design, result.table, contrasts);
  } catch (const FormulaError& error) {
    throw_formula("--random", error);
  }
  for (const analysis::MixedTerm& term : data.terms) {
    const auto known = std::ranges::find(result.groups, term.group,
                                         &std::pair<std::string, std::size_t>::first);
    if (known == result.groups.end()) result.groups.emplace_back(term.group, term.num_groups);
  }
  std::optional<analysis::MixedRefit> refit;
  try {
    refit.emplace(data, how);
  } catch (const core::Error& error) {
    throw core::Error(options.csv + ": " + error.what());
  }
  result.fit = refit->fit();
  result.notes.insert(result.notes.end(), result.fit.notes.begin(), result.fit.notes.end());
  add_cautions(result);
  if (result.fit.status == FitStatus::kOk && !options.stimulus.empty()) {
    add_derived(options, how, *refit, result);
  }
}

/// Fits one group among several. If it cannot be fitted, its result says why.
void fit_glmm_group(const FitGlmmOptions& options, GlmmResult& result) {
  const auto fail = [&](const std::string& why) {
    const std::string file = options.csv + ": ";
    const std::size_t begin = why.starts_with(file) ? file.size() : 0;
    result.fit.status = FitStatus::kDegenerate;
    result.fit.reason = why.substr(begin, why.find('\n') - begin);
  };
  try {
    fit_glmm_table(options, result);
  } catch (const core::Error& error) {
    fail(error.what());
  } catch (const UsageError& error) {
    // For example, a factor has only one level in this group.
    fail(error.what());
  }
}

/// All fits, and the notes about the file.
struct GlmmResults {
  /// The whole table, if there is --group-by.
  analysis::TrialTable table;
  std::vector<std::string> notes;
  std::vector<GlmmResult> groups;
};

GlmmResults glmm_results(const FitGlmmOptions& options) {
  const analysis::MixedFormulas formulas = formulas_of(options, whole_fixed(options));
  const auto& variables = formulas.fixed.variables;
  if (!options.stimulus.empty() &&
      std::ranges::find(variables, options.stimulus, &analysis::FormulaVariable::column) ==
          variables.end()) {
    throw UsageError(
        fmt::format("--stimulus: expected a column of --fixed, found {}", options.stimulus));
  }
  GlmmResults results;
  results.table = read_glmm_table(options, formulas);
  results.notes = notes_of_file(results.table);
  if (results.table.num_rows() == 0) {
    throw core::Error(options.csv + ": expected rows with answers, found none");
  }
  if (options.group_by.empty()) {
    GlmmResult& all = results.groups.emplace_back();
    all.formulas = formulas;
    all.notes = results.notes;
    all.table = std::move(results.table);
    fit_glmm_table(options, all);
    return results;
  }
  for (analysis::TrialGroup& group : analysis::groups_of(results.table, options.group_by)) {
    GlmmResult& one = results.groups.emplace_back();
    one.group = std::move(group.key);
    one.formulas = formulas;
    one.table = std::move(group.table);
    fit_glmm_group(options, one);
  }
  return results;
}

nlohmann::ordered_json document_of(const FitGlmmOptions& options, const GlmmResult& result) {
  using Json = nlohmann::ordered_json;
  Json json = analysis::to_json(result.fit);
  json["derived"] = analysis::to_json(result.derived, options.num_bootstrap > 0);
  json["link"] = options.link;
  json["guess_rate"] = std::stod(options.guess);
  json["lapse_rate"] = std::stod(options.lapse);
  json["contrasts"] = options.contrasts;
  json["nodes"] = options.num_nodes;
  json["formula"] = {{"fixed", result.formulas.fixed.text}, {"random", options.random}};
  json["groups"] = Json::object();
  for (const auto& [name, number] : result.groups) json["groups"][name] = number;
  if (!options.stimulus.empty()) {
    json["stimulus"] = options.stimulus;
    json["axis"] =
        result.lines.axis == analysis::StimulusAxis::kLinear ? "linear" : "logarithmic";
    json["jnd_at"] = options.jnd_at;
    if (!result.derived.empty()) json["degrees_of_freedom"] = result.degrees_of_freedom;
  }
  if (options.num_bootstrap > 0) {
    json["bootstrap"] = {{"num", options.num_bootstrap},
                         {"num_without_fit", result.num_without_fit},
                         {"seed", options.seed}};
  }
  return json;
}

/// The JSON of one fit, or of all groups under `fits`, with what was left out of the file.
nlohmann::ordered_json document_of(const FitGlmmOptions& options, const GlmmResults& results) {
  using Json = nlohmann::ordered_json;
  Json json;
  if (options.group_by.empty()) {
    json = document_of(options, results.groups.front());
  } else {
    json["fits"] = Json::array();
    for (const GlmmResult& result : results.groups) {
      Json one = {{"group", Json::object()}};
      for (const auto& [column, cell] : result.group) one["group"][column] = cell;
      one.update(document_of(options, result));
      one["notes"] = result.notes;
      json["fits"].push_back(std::move(one));
    }
  }
  const analysis::TrialTable& file =
      options.group_by.empty() ? results.groups.front().table : results.table;
  json["num_rows_in_file"] = file.num_rows_in_file;
  json["num_rows_elsewhere"] = file.num_elsewhere;
  json["num_rows_missing"] = Json(file.num_missing);
  json["notes"] = options.group_by.empty() ? results.groups.front().notes : results.notes;
  return json;
}

void print_groups(const FitGlmmOptions& options, const GlmmResults& results) {
  for (const GlmmResult& result : results.groups) {
    if (!result.group.empty()) fmt::print("{}\n", heading_of(result.group));
    print_glmm(options, result);
  }
  if (options.group_by.empty()) return;
  for (const std::string& note : results.notes) fmt::print("note: {}\n", note);
}

int fit_glmm(const FitGlmmOptions& options) {
  require_glmm_options(options);
  const GlmmResults results = glmm_results(options);
  const GlmmResult& first = results.groups.front();
  if (options.json) {
    fmt::print("{}\n", json_text(document_of(options, results)));
  } else if (!options.script.empty()) {
    fmt::print("{}", glmm_script(options, first));
  } else {
    print_groups(options, results);
  }
  std::size_t num_lacking = 0;
  std::string reason;
  for (const GlmmResult& result : results.groups) {
    if (result.fit.status != FitStatus::kOk && num_lacking++ == 0) reason = result.fit.reason;
  }
  if (num_lacking == 0) {
    if (!options.figure.empty()) draw_glmm(options, first, options.figure);
    return kDone;
  }
  if (options.group_by.empty()) {
    fmt::print(stderr, "jnd: {}: expected answers that have a mixed model, found none: {}\n",
               options.csv, reason);
  } else {
    fmt::print(stderr,
               "jnd: {}: expected a mixed model in every group, found none in {} of {}: {}\n",
               options.csv, num_lacking, results.groups.size(), reason);
  }
  return kHasProblems;
}

}  // namespace

void add_fit_glmm(CLI::App& fit, Invocation& invocation) {
  const auto options = std::make_shared<FitGlmmOptions>();
  CLI::App& command = *fit.add_subcommand(
      "glmm",
      "Generalised linear mixed model of yes and no: P(yes) = guess + (1 - guess - lapse) "
      "F(eta), eta being the fixed effects plus random effects, normal between groups");
  invocation.examples[&command] = {
      {"jnd fit glmm --csv trials.csv --yes answer --fixed \"u * condition\" --random \"1 + u "
       "| participant\" --stimulus u",
       "a mixed model by formula"},
      {"jnd fit glmm --csv trials.csv --yes answer --fixed u --random \"1 + u || participant\" "
       "--group-by block",
       "the linear model of fit hierarchical, a fit for each block"}};
  add_answer_columns(command, *options);
  command
      .add_option("--group-by", options->group_by,
                  "columns, which no formula names; one fit for each of their values")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("COLUMN[,COLUMN,..]");
  command
      .add_option(
          "--fixed", options->fixed,
          "right side of a formula as R has it: + of terms, a:b for their product, a*b "
          "for a + b + a:b, (a + b)^2, 0 or -1 for no intercept; a column of numbers is "
          "a covariate, any other or factor(column) a factor; log, log2, log10, exp, "
          "sqrt, abs, scale and center of a column; names in backquotes")
      ->required()
      ->option_text("FORMULA REQUIRED");
  command
      .add_option("--random", options->random,
                  "effects that differ between groups: \"1 + u | participant\", correlated, or "
                  "with || not; a:b or a/b for groups within groups; several times, or "
                  "\"(1 | person) + (1 | item)\"")
      ->required()
      ->allow_extra_args(false)
      ->option_text("FORMULA REQUIRED");
  command
      .add_option("--link", options->link,
                  "F: probit Phi(eta); logit 1 / (1 + exp(-eta)); cloglog 1 - exp(-exp(eta))")
      ->check(CLI::IsMember({"probit", "logit", "cloglog"}))
      ->capture_default_str();
  command
      .add_option("--guess", options->guess, "lower end of the curve, 1/2 of two alternatives")
      ->transform(rate())
      ->option_text("RATE [0]");
  command.add_option("--lapse", options->lapse, "distance of the upper end from 1")
      ->transform(rate())
      ->option_text("RATE [0]");
  command
      .add_option("--contrasts", options->contrasts,
                  "of factors: each level against the first, or, sum, against the mean of all")
      ->check(CLI::IsMember({"treatment", "sum"}))
      ->capture_default_str();
  command
      .add_option("--nodes", options->num_nodes,
                  "of adaptive Gauss-Hermite quadrature in each dimension, for one grouping; 1 "
                  "is Laplace's approximation, for any number")
      ->check(whole_number(1, 61))
      ->capture_default_str();
  command
      .add_option(
          "--stimulus", options->stimulus,
          "covariate of which PSE, JND and Weber fraction are told in each combination "
          "of the factors' levels, with their differences: eta = a + b x has PSE = "
          "(q(1/2) - a) / b, JND = |q(at) - q(1/2)| / |b| and Weber fraction JND / PSE; "
          "eta = a + b ln x has PSE = exp((q(1/2) - a) / b) and Weber fraction = "
          "|exp((q(at) - q(1/2)) / b) - 1|; q is the inverse of F")
      ->option_text("COLUMN");
  command.add_option("--jnd-at", options->jnd_at, "level of F, from 0 to 1, of the JND")
      ->option_text("LEVEL [0.75]");
  command
      .add_option("--terms", options->terms,
                  "history: adds the stimulus and the answer of the row before of the same "
                  "group of the first --random, as previous_COLUMN and previous_answer")
      ->check(CLI::IsMember({"history"}));
  command
      .add_option("--bootstrap", options->num_bootstrap,
                  "refits of answers drawn from the model, random effects anew among them, for "
                  "intervals beside those of the delta method")
      ->check(whole_number(0, 1'000'000));
  command.add_option("--seed", options->seed, "of the bootstrap")
      ->check(seed_number())
      ->capture_default_str();
  command
      .add_option("--script", options->script,
                  "print a script that repeats the fit by lme4 in R")
      ->check(CLI::IsMember({"r", "python"}));
  add_figure_option(command, options->figure);
  command.add_flag("--json", options->json, "print one JSON document");
  command.callback([&invocation, &command, options] {
    options->says_guess = command.count("--guess") > 0;
    invocation.run = [options] { return fit_glmm(*options); };
  });
}

}  // namespace jnd::app
