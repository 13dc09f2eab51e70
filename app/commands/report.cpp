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
#include "app/commissioning/commissioning_report.h"
#include "app/results/study_report.h"

namespace jnd::app {
namespace {

struct ReportOptions {
  std::string folder;
  std::string commissioning;  ///< A commissioning's record; "" for the report of a study.
  std::string profile;        ///< With a record, its profile; "" if it has to be looked for.
  /// With a record, the person who measured; "" leaves it to the record.
  std::string operator_name;
  std::string out;
  bool pilot = false;
  bool json = false;
  std::string language = "en";
  int jobs = 2;
  std::vector<std::string> compare;  ///< Such as "group_d,group_e".
  std::string inverted;              ///< "in" or "out".
  analysis::ResultsOptions results;
};

nlohmann::json figures_json(const analysis::ReportOutcome& outcome) {
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
  return figures;
}

nlohmann::json file_json(const std::filesystem::path& file) {
  return file.empty() ? nlohmann::json(nullptr) : nlohmann::json(file.string());
}

nlohmann::json report_json(const analysis::StudyResults& results, const ReportOptions& options,
                           const analysis::ReportOutcome& outcome) {
  return {{"study", results.study},
          {"simulated", results.simulated},
          {"out", options.out},
          {"html", outcome.html.string()},
          {"pdf", file_json(outcome.pdf)},
          {"figures", figures_json(outcome)},
          {"supplement_html", file_json(outcome.supplement_html)},
          {"supplement_pdf", file_json(outcome.supplement_pdf)},
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

/// Writes the report of a device instead of a study.
int run_commissioning_report(const ReportOptions& options) {
  const std::string on_day = today();
  analysis::ReportOptions tools = analysis::installed_report_tools();
  tools.jobs = options.jobs;
  const analysis::ReportOutcome outcome = write_commissioning_report(
      {.record = options.commissioning,
       .profile = profile_of_record(options.commissioning, options.profile, on_day),
       .operator_name = options.operator_name,
       .program_version = JND_VERSION,
       .written_on = on_day,
       .out = options.out,
       .tools = tools});
  for (const std::string& problem : outcome.problems) {
    std::fprintf(stderr, "jnd: %s\n", problem.c_str());
  }
  if (options.json) {
    const nlohmann::json document = {
        {"record", options.commissioning},  {"out", options.out},
        {"html", outcome.html.string()},    {"pdf", file_json(outcome.pdf)},
        {"figures", figures_json(outcome)}, {"problems", outcome.problems}};
    std::puts(json_text(document).c_str());
    return kDone;
  }
  std::printf("%s: report of the commissioning with %zu figures written to %s%s\n",
              options.commissioning.c_str(), outcome.figures.size(), outcome.html.c_str(),
              outcome.pdf.empty() ? "" : " and report.pdf");
  return kDone;
}

int run_report(const ReportOptions& options) {
  if (options.folder.empty() == options.commissioning.empty()) {
    throw UsageError(
        "report: expected a study folder or --commissioning RECORD, found neither of them");
  }
  if (!options.commissioning.empty()) return run_commissioning_report(options);
  write_reports_in(options.language);
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
              outcome.html.c_str(),
              outcome.pdf.empty() ? "; all else is in supplement.html"
                                  : " and report.pdf; all else is in supplement.html and .pdf");
  return kDone;
}

}  // namespace

HelpPlace place_of_report() { return {HelpGroup::kResults, 20}; }

void add_report(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "report",
      "Everything a study shows, as HTML and PDF with figures, for a paper; or what was "
      "measured of a device");
  invocation.examples[command] = {
      {"jnd report my_study.study --out my_report", "what a paper needs, with every figure"}};
  const auto options = std::make_shared<ReportOptions>();
  CLI::Option* const folder =
      command->add_option("DIR", options->folder, "Study folder, NAME.study")
          ->check(CLI::ExistingDirectory);
  CLI::Option* const record =
      command
          ->add_option("--commissioning", options->commissioning,
                       "Instead of a study: the record of a device, DEVICE.commissioning.jsonl")
          ->check(CLI::ExistingFile)
          ->excludes(folder);
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
  // Options about the analysis of a study have no meaning for a device.
  for (CLI::Option* const option : command->get_options()) {
    const std::string name = option->get_name();
    if (name == "--pilot" || name == "--resamples" || name == "--compare" ||
        name == "--inverted" || name == "--seed") {
      option->excludes(record);
    }
  }
  command
      ->add_option("--profile", options->profile,
                   "With --commissioning: its profile, NAME.device.json; default: the newest "
                   "of the device beside the record or where sessions look for it")
      ->needs(record);
  command
      ->add_option("--operator", options->operator_name,
                   "With --commissioning: who measured; default: as the record says")
      ->needs(record);
  CLI::Option* const json =
      command->add_flag("--json", options->json, "One JSON document on stdout, in English");
  command
      ->add_option(
          "--language", options->language,
          "Of a study's report: en, or de for German; its tables of numbers stay English")
      ->excludes(record)
      ->excludes(json)
      ->capture_default_str();
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_report(*options); }; });
}

}  // namespace jnd::app
