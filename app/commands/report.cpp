#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/commands/compare_option.h"
#include "app/commands/inverted_option.h"
#include "app/results/study_report.h"

namespace jnd::app {
namespace {

struct ReportOptions {
  std::string folder;
  std::string out;
  bool pilot = false;
  bool json = false;
  int jobs = 2;
  std::vector<std::string> compare;  ///< "group_d,group_e"
  std::string inverted;              ///< "in", "out"
  analysis::ResultsOptions results;
};

nlohmann::json report_json(const analysis::StudyResults& results, const ReportOptions& options,
                           const analysis::ReportOutcome& outcome) {
  nlohmann::json figures = nlohmann::json::array();
  for (std::size_t i = 0; i < outcome.figures.size(); ++i) {
    const analysis::Figure& figure = outcome.figures[i];
    figures.push_back({{"name", figure.name},
                       {"title", figure.title},
                       {"section", figure.section},
                       {"thesis", figure.thesis},
                       {"drawn", !outcome.drawn[i].svg.empty()},
                       {"problem", outcome.drawn[i].problem}});
  }
  return {{"study", results.study},
          {"simulated", results.simulated},
          {"out", options.out},
          {"html", outcome.html.string()},
          {"pdf", outcome.pdf.empty() ? nlohmann::json(nullptr)
                                      : nlohmann::json(outcome.pdf.string())},
          {"figures", std::move(figures)},
          {"problems", outcome.problems}};
}

StudyReport written(const ReportOptions& options) {
  analysis::ResultsOptions results = options.results;
  results.compared = compared_names(options.compare);
  ProgressBar bar("report");
  return write_study_report({.folder = options.folder,
                             .out = options.out,
                             .pilot = options.pilot,
                             .jobs = options.jobs,
                             .results = std::move(results),
                             .leaves_out_inverted = options.inverted == "out",
                             .on_progress = [&bar](double done) { bar.show(done); }});
}

int run_report(const ReportOptions& options) {
  const StudyReport report = written(options);
  const analysis::StudyResults& results = report.results;
  const analysis::ReportOutcome& outcome = report.outcome;
  for (const std::string& problem : outcome.problems) {
    std::fprintf(stderr, "jnd: %s\n", problem.c_str());
  }
  if (options.json) {
    std::puts(json_text(report_json(results, options, outcome)).c_str());
    return kDone;
  }
  std::printf("%s: report of %d participants%s with %zu figures written to %s%s\n",
              options.folder.c_str(), results.num_participants,
              results.simulated ? ", SIMULATED," : "", outcome.figures.size(),
              outcome.html.c_str(), outcome.pdf.empty() ? "" : " and report.pdf");
  return kDone;
}

}  // namespace

void add_report(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "report", "Everything a study shows, as HTML and PDF with figures, for a paper");
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", options->out, "Folder to write to: new or empty")->required();
  command->add_flag("--pilot", options->pilot, "Pilot sessions as well");
  command
      ->add_option("--resamples", options->results.num_resamples,
                   "Resampled participants for group intervals")
      ->check(whole_number(100, 1000000))
      ->capture_default_str();
  add_compare_option(*command, options->compare);
  add_inverted_option(*command, options->inverted);
  command->add_option("--seed", options->results.seed, "Of the resampling")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Figures and recordings at once")
      ->check(whole_number(1, 1024))
      ->capture_default_str();
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_report(*options); }; });
}

}  // namespace jnd::app
