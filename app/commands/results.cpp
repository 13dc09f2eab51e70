#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/movement/delivered_intensity.h"
#include "analysis/movement/recorded_results.h"
#include "analysis/results/inverted_answers.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/commands/compare_option.h"
#include "app/commands/inverted_option.h"
#include "app/commands/predictive_option.h"
#include "app/preregistration/deviations.h"
#include "app/results/measured_devices.h"
#include "app/results/results_output.h"
#include "app/session/stored_session.h"

namespace jnd::app {
namespace {

struct ResultsOptions {
  std::string folder;
  bool json = false;
  bool delivered = false;
  bool movement = false;
  std::vector<std::string> compare;  ///< Such as "group_d,group_e".
  std::string inverted;              ///< "in" or "out".
  PredictiveOption predictive;
  analysis::ResultsOptions results;
};

/// Such as "group_d, group_e; group_d, group_f".
std::string compared_words(const std::vector<analysis::BlockNames>& compared) {
  std::string words;
  for (const auto& [first, second] : compared) {
    words += (words.empty() ? "" : "; ") + first + ", " + second;
  }
  return words;
}

/// Which intensities the fits use.
nlohmann::json basis_of(const analysis::DeliveredStudy& study) {
  return {{"basis", "delivered"},
          {"force", analysis::name(study.force_source)},
          {"num_trials", study.num_replaced},
          {"num_left_out", study.num_left_out}};
}

const char* force_words(analysis::ForceSource source) {
  if (source == analysis::ForceSource::kSent) return "force as it was sent";
  if (source == analysis::ForceSource::kMeasured) return "force that sensors measured";
  return "force that sensors measured, and as it was sent where there were none";
}

int run_results(ResultsOptions options) {
  options.results.compared = compared_names(options.compare);
  const core::StudyStore store(options.folder, core::StudyStore::Mode::kReadOnly);
  require_results_open(store);
  const analysis::StudyData as_commanded = analysis::load_study(store);
  const MeasuredDevices devices =
      options.delivered ? measured_devices(store, as_commanded) : MeasuredDevices();
  const bool leaves_out = options.inverted == "out";
  const auto intensities = [&](const analysis::DeviceParts& parts) {
    if (options.delivered) return delivered_study(store, as_commanded, parts, leaves_out);
    analysis::DeliveredStudy study{.data = as_commanded};
    if (leaves_out) analysis::leave_out_inverted(study.data);
    return study;
  };
  const analysis::DeliveredStudy study = intensities(devices.parts);
  const std::optional<analysis::PredictivePeople> people =
      people_asked_for(options.predictive, store, study.data);
  analysis::StudyResults results = [&] {
    ProgressBar bar("results");
    options.results.on_progress = [&bar](double done) { bar.show(done); };
    const analysis::PredictivePeople* const others = people ? &*people : nullptr;
    return results_of_data(study.data, options.results, others);
  }();
  options.results.on_progress = {};
  results.preregistration =
      preregistered_study(store, as_commanded,
                          {.delivered = options.delivered,
                           .inverted_out = leaves_out,
                           .compared = compared_words(options.results.compared)});
  if (!devices.parts.empty()) {
    tell_device_part(results, store, as_commanded, devices, options.results, leaves_out);
  }
  if (options.movement) {
    results.sections.push_back(
        analysis::recorded_results(analysis::analyse_movement(store, {.explored = false})));
  }
  if (options.json) {
    nlohmann::json document = results_json(results);
    if (options.delivered) {
      document["intensities"] = basis_of(study);
      if (!devices.parts.empty()) {
        document["intensities"]["num_sessions_with_profile"] = devices.parts.size();
      }
    }
    std::puts(json_text(document).c_str());
    return kDone;
  }
  if (options.delivered) {
    std::printf("intensities: as delivered (%s), in %lld trials; %lld left out\n",
                force_words(study.force_source), static_cast<long long>(study.num_replaced),
                static_cast<long long>(study.num_left_out));
    if (!devices.parts.empty()) {
      std::printf("devices: gain and own damping as their profiles say, in %zu sessions\n",
                  devices.parts.size());
    }
  }
  std::fputs(to_table(results).c_str(), stdout);
  std::fputs(device_part_table(results).c_str(), stdout);
  return kDone;
}

}  // namespace

HelpPlace place_of_results() { return {HelpGroup::kResults, 10}; }

void add_results(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "results", "Every fit and comparison that a study's design calls for");
  invocation.examples[command] = {
      {"jnd results my_study.study --json", "every fit and comparison as one JSON document"}};
  const auto options = std::make_shared<ResultsOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
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
  command->add_flag("--delivered", options->delivered,
                    "Fit on what the device delivered instead of what was commanded");
  command->add_flag("--movement", options->movement,
                    "What the recordings say of movement as well; reads every sample");
  add_predictive_option(*command, options->predictive);
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_results(*options); }; });
}

}  // namespace jnd::app
