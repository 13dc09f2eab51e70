#include "app/commands/fit_detection.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/fits/detection_fit.h"
#include "analysis/fits/same_different_fit.h"
#include "analysis/fits/signal_detection.h"
#include "analysis/report/single_figure.h"
#include "analysis/statistics/json_values.h"
#include "app/command_line/json_text.h"
#include "app/commands/answer_options.h"
#include "app/commands/fit_figures.h"
#include "app/curves/fit_words.h"

namespace jnd::app {
namespace {

using analysis::AnswerCount;
using analysis::FitStatus;
using analysis::SignalDetection;
namespace values = analysis::json_values;
using DetectionJson = nlohmann::ordered_json;

constexpr char kCorrection[] =
    "log-linear (Hautus 1995): half an answer is added to every number of yes, one trial to "
    "every number of trials";

/// One group's answers, and their results.
struct DetectionResult {
  FitStatus status = FitStatus::kDegenerate;
  std::string reason;
  analysis::DetectionCounts counts;  ///< All stimuli together.
  SignalDetection all;
  struct Level {
    double intensity = 0.0;
    analysis::DetectionCounts counts;
    SignalDetection found;
  };
  std::vector<Level> levels;  ///< By intensity.
  analysis::DetectionFit threshold;
};

DetectionResult detection_of(const std::vector<AnswerCount>& rows) {
  DetectionResult result;
  std::map<double, analysis::DetectionCounts> by_intensity;
  for (const AnswerCount& row : rows) {
    if (row.intensity == 0.0) {
      result.counts.num_false_alarms += row.num_yes;
      result.counts.num_catch += row.num_trials;
      continue;
    }
    result.counts.num_hits += row.num_yes;
    result.counts.num_signals += row.num_trials;
    by_intensity[row.intensity].num_hits += row.num_yes;
    by_intensity[row.intensity].num_signals += row.num_trials;
  }
  if (result.counts.num_catch == 0) {
    result.reason = "no catch trials: d' needs rows at intensity 0, where there is nothing";
  } else if (result.counts.num_signals == 0) {
    result.reason = "no stimuli: d' needs rows at intensities above 0";
  } else {
    result.status = FitStatus::kOk;
    result.all = analysis::signal_detection(result.counts);
    for (auto& [intensity, counts] : by_intensity) {
      if (counts.num_signals == 0) continue;
      counts.num_false_alarms = result.counts.num_false_alarms;
      counts.num_catch = result.counts.num_catch;
      result.levels.push_back({intensity, counts, analysis::signal_detection(counts)});
    }
  }
  result.threshold = analysis::fit_detection(rows);
  return result;
}

DetectionJson pair_json(const std::pair<double, double>& ends) {
  return DetectionJson::array({ends.first, ends.second});
}

void add_sensitivity(DetectionJson& json, const SignalDetection& found) {
  json["hit_rate"] = found.hit_rate;
  json["false_alarm_rate"] = found.false_alarm_rate;
  json["d_prime"] = found.d_prime;
  json["d_prime_ci95"] = pair_json(found.d_prime_ci95());
  json["criterion"] = found.criterion;
  json["criterion_ci95"] = pair_json(found.criterion_ci95());
  json["a_prime"] = found.a_prime;
}

DetectionJson json_of(const DetectionResult& result) {
  DetectionJson json = {{"status", to_string(result.status)},
                        {"reason", values::sentence(result.reason)},
                        {"num_hits", result.counts.num_hits},
                        {"num_signals", result.counts.num_signals},
                        {"num_false_alarms", result.counts.num_false_alarms},
                        {"num_catch", result.counts.num_catch},
                        {"correction", kCorrection}};
  if (result.status == FitStatus::kOk) {
    add_sensitivity(json, result.all);
  } else {
    for (const char* key : {"hit_rate", "false_alarm_rate", "d_prime", "d_prime_ci95",
                            "criterion", "criterion_ci95", "a_prime"}) {
      json[key] = nullptr;
    }
  }
  json["levels"] = DetectionJson::array();
  for (const DetectionResult::Level& level : result.levels) {
    DetectionJson one = {{"intensity", level.intensity},
                         {"num_hits", level.counts.num_hits},
                         {"num_signals", level.counts.num_signals}};
    add_sensitivity(one, level.found);
    json["levels"].push_back(std::move(one));
  }
  const analysis::DetectionFit& fit = result.threshold;
  json["threshold"] = {{"status", to_string(fit.status)},
                       {"reason", values::sentence(fit.reason)},
                       {"value", values::number(fit.threshold)},
                       {"ci95", values::interval(fit.threshold_ci95)},
                       {"spread_ln", values::number(fit.spread_ln)},
                       {"spread_ln_ci95", values::interval(fit.spread_ln_ci95)},
                       {"false_alarm_rate", values::number(fit.false_alarm_rate)},
                       {"log_likelihood", values::number(fit.log_likelihood)}};
  return json;
}

std::string pair_words(const std::pair<double, double>& ends) {
  return fmt::format("95 % {:.4g} to {:.4g}", ends.first, ends.second);
}

void print_sensitivity(const SignalDetection& found, const char* indent) {
  fmt::print("{}d'              {:<9.4g} {}\n", indent, found.d_prime,
             pair_words(found.d_prime_ci95()));
  fmt::print("{}criterion c     {:<9.4g} {}\n", indent, found.criterion,
             pair_words(found.criterion_ci95()));
  fmt::print("{}A'              {:<9.4g}\n", indent, found.a_prime);
}

void print_detection(const DetectionResult& result) {
  fmt::print("  {} yes of {} stimuli, {} yes of {} catch trials\n", result.counts.num_hits,
             result.counts.num_signals, result.counts.num_false_alarms,
             result.counts.num_catch);
  if (result.status != FitStatus::kOk) {
    fmt::print("  no d': {}\n", result.reason);
  } else {
    fmt::print("  rates {:.4g} and {:.4g}, corrected: {}\n", result.all.hit_rate,
               result.all.false_alarm_rate, kCorrection);
    print_sensitivity(result.all, "  ");
    if (result.levels.size() > 1) {
      for (const DetectionResult::Level& level : result.levels) {
        fmt::print("  intensity {:.6g}: {} yes of {}\n", level.intensity, level.counts.num_hits,
                   level.counts.num_signals);
        print_sensitivity(level.found, "    ");
      }
    }
  }
  const analysis::DetectionFit& fit = result.threshold;
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no threshold: {}\n", fit.reason);
    return;
  }
  fmt::print(
      "  threshold       {:<9} 95 % {}  felt in half of the trials, less the false alarms\n",
      number(fit.threshold), whole_range(fit.threshold_ci95));
  fmt::print("  spread          {:<9} 95 % {}  standard deviation of ln intensity\n",
             number(fit.spread_ln), whole_range(fit.spread_ln_ci95));
}

DetectionJson json_of(const analysis::SameDifferentFit& fit) {
  return {{"status", to_string(fit.status)},
          {"reason", values::sentence(fit.reason)},
          {"weber_fraction", values::number(fit.weber_fraction)},
          {"weber_fraction_ci95", values::interval(fit.weber_fraction_ci95)},
          {"criterion_ln", values::number(fit.criterion_ln)},
          {"criterion_ln_ci95", values::interval(fit.criterion_ln_ci95)},
          {"false_alarm_rate", values::number(fit.false_alarm_rate)},
          {"log_likelihood", values::number(fit.log_likelihood)}};
}

void print_detection(const analysis::SameDifferentFit& fit) {
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no Weber fraction: {}\n", fit.reason);
    return;
  }
  fmt::print("  Weber fraction  {:<9} 95 % {}\n", number(fit.weber_fraction),
             whole_range(fit.weber_fraction_ci95));
  fmt::print("  criterion       {:<9} 95 % {}  of ln intensity\n", number(fit.criterion_ln),
             whole_range(fit.criterion_ln_ci95));
  fmt::print("  \"different\" of pairs that are the same: {}\n", number(fit.false_alarm_rate));
  fmt::print("  log-likelihood  {}\n", number(fit.log_likelihood));
}

struct DetectionOptions : AnswerRequest {
  std::string figure;
  std::string answer_name = "Proportion yes";
};

struct SameDifferentOptions : DetectionOptions {
  double reference = 0.0;
};

/// Fits each group, and tells whether each of them has a value. `what` names the value that may
/// be missing. `draw` makes a curve from a group's name, rows and result.
template <typename Fit, typename Draw>
int tell_groups(const DetectionOptions& options, const char* what, const Fit& fit,
                const Draw& draw) {
  if (!options.figure.empty()) analysis::require_figure_file(options.figure);
  const analysis::AnswerFile file = read_answers(options, /*signed_intensities=*/false);
  const std::vector<std::string> notes = notes_of(file, options);
  DetectionJson all = DetectionJson::array();
  std::size_t num_lacking = 0;
  std::string reason;
  std::vector<analysis::DrawnCurve> curves;
  for (const analysis::AnswerGroup& group : file.groups) {
    const std::vector<AnswerCount> rows = rows_of(group);
    const auto result = fit(rows);
    curves.push_back(draw(words_of(group), rows, result));
    if (result.status != FitStatus::kOk && num_lacking++ == 0) reason = result.reason;
    if (options.json) {
      DetectionJson json;
      json["group"] = DetectionJson::object();
      for (const auto& [column, value] : group.key) json["group"][column] = value;
      json.update(json_of(result));
      all.push_back(std::move(json));
      continue;
    }
    if (!group.key.empty()) fmt::print("{}\n", words_of(group));
    print_detection(result);
  }
  if (options.json) {
    const DetectionJson document = {{"fits", std::move(all)},
                                    {"num_rows", file.num_rows},
                                    {"num_rows_elsewhere", file.num_elsewhere},
                                    {"num_rows_missing", DetectionJson(file.num_missing)},
                                    {"notes", notes}};
    fmt::print("{}\n", json_text(document));
  } else {
    for (const std::string& note : notes) fmt::print("note: {}\n", note);
  }
  if (!options.figure.empty()) {
    analysis::write_single_figure(
        analysis::curve_figure(
            curves, {.intensity_name = options.intensity, .answer_name = options.answer_name}),
        options.figure);
  }
  if (num_lacking == 0 && file.num_rows > 0) return kDone;
  fmt::print(stderr, "jnd: {}: expected answers that have a {}, found none in {} of {}: {}\n",
             options.csv, what, num_lacking, file.groups.size(),
             file.num_rows == 0 ? "there are no rows" : reason);
  return kHasProblems;
}

int fit_same_different_groups(const SameDifferentOptions& options) {
  if (!(options.reference > 0.0 && std::isfinite(options.reference))) {
    throw UsageError(fmt::format(
        "--reference: expected a number > 0 in the unit of the intensities, found {}",
        options.reference));
  }
  return tell_groups(
      options, "Weber fraction",
      [&](const std::vector<AnswerCount>& rows) {
        return analysis::fit_same_different(rows, options.reference);
      },
      [&](const std::string& name, const std::vector<AnswerCount>& rows,
          const analysis::SameDifferentFit& fit) {
        return drawn_curve(name, rows, fit, options.reference);
      });
}

}  // namespace

void add_fit_detection(CLI::App& fit, Invocation& invocation) {
  const auto detection = std::make_shared<DetectionOptions>();
  CLI::App& command = *fit.add_subcommand("detection",
                                          "d', criterion and A' of yes and no, with catch "
                                          "trials at intensity 0; and the threshold");
  invocation.examples[&command] = {
      {"jnd fit detection --csv answers.csv --intensity level --yes said_yes",
       "catch trials are those at intensity 0"}};
  add_answer_options(command, *detection);
  add_figure_option(command, detection->figure);
  command.add_flag("--json", detection->json, "print one JSON document");
  command.callback([&invocation, detection] {
    invocation.run = [detection] {
      return tell_groups(
          *detection, "d'",
          [](const std::vector<AnswerCount>& rows) { return detection_of(rows); },
          [](const std::string& name, const std::vector<AnswerCount>& rows,
             const DetectionResult& result) {
            return drawn_curve(name, rows, result.threshold);
          });
    };
  });

  const auto same = std::make_shared<SameDifferentOptions>();
  same->answer_name = "Proportion different";
  CLI::App& pairs = *fit.add_subcommand(
      "same-different",
      R"(Weber fraction and criterion of "same" and "different", a yes being "different")");
  invocation.examples[&pairs] = {
      {"jnd fit same-different --csv answers.csv --yes different --reference 10",
       "every pair has the stimulus 10"}};
  add_answer_options(pairs, *same);
  pairs.add_option("--reference", same->reference, "the other stimulus of every pair, > 0")
      ->required();
  add_figure_option(pairs, same->figure);
  pairs.add_flag("--json", same->json, "print one JSON document");
  pairs.callback([&invocation, same] {
    invocation.run = [same] { return fit_same_different_groups(*same); };
  });
}

}  // namespace jnd::app
