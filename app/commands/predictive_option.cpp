#include "app/commands/predictive_option.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>

#include "analysis/results/published.h"
#include "app/command_line/command.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/results/predictive_studies.h"
#include "app/session/shipped_files.h"
#include "app/session/stored_session.h"
#include "core/error.h"

namespace jnd::app {
namespace {

// CLI11 gives this text for an option without its value.
constexpr char kWithoutNumber[] = "true";

/// An invalid number is refused before anything is simulated.
int number_of(const std::string& typed) {
  if (typed == kWithoutNumber) return kUsualPredictivePeople;
  std::string text = typed;
  const std::string problem = whole_number(kFewestPredictivePeople, 100000)(text);
  if (!problem.empty()) throw UsageError("--predictive: " + problem);
  return std::stoi(text);
}

void keep(const analysis::PredictivePeople& people, const std::string& folder) {
  const std::filesystem::path file =
      std::filesystem::path(folder) / predictive_file_name(people.key);
  std::ofstream stream(file, std::ios::binary);
  stream << to_text(people);
  if (!stream.flush()) {
    throw core::Error(file.string() + ": expected a file that can be written, found none");
  }
}

}  // namespace

void add_predictive_option(CLI::App& command, PredictiveOption& option) {
  command
      .add_option(
          "--predictive", option.num_people,
          "Compare published values with studies drawn from N simulated people, usually "
          "260 (a second each, or less); shipped laboratories have theirs stored")
      ->expected(0, 1)
      ->type_name("[N]");
  command
      .add_option("--predictive-out", option.keep_folder,
                  "Folder to keep these people in, for whoever ships a laboratory")
      ->check(CLI::ExistingDirectory)
      ->needs("--predictive");
}

void require_number_of_people(const PredictiveOption& option) {
  if (option.is_given()) (void)number_of(option.num_people);
}

std::optional<analysis::PredictivePeople> people_asked_for(const PredictiveOption& option,
                                                           const core::StudyStore& store,
                                                           const analysis::StudyData& data) {
  if (!option.is_given()) return std::nullopt;
  const int num_people = number_of(option.num_people);
  if (analysis::published_for(data.study, shipped_folder() / "data" / "published")
          .values.empty()) {
    throw UsageError("--predictive: expected a study that something is published of, found " +
                     data.study);
  }
  if (!data.simulated || data.laboratory_text.empty() || data.device.empty()) {
    throw UsageError(
        "--predictive: expected a study whose participants were simulated, all on one device, "
        "found another; what persons' studies would come to is not known");
  }
  const experiments::Study study = stored_study(store, store.sessions().front().session);
  const experiments::Laboratory laboratory = experiments::parse_laboratory(
      data.laboratory_text, store.folder().string() + ": laboratory");
  stop_on_signals();
  ProgressBar bar(study.name + ": simulated people");
  analysis::PredictivePeople people =
      simulate_people({.study = study,
                       .laboratory = laboratory,
                       .device = data.device,
                       .num_people = num_people,
                       .jobs = option.jobs,
                       .on_progress = [&bar](double done) { bar.show(done); },
                       .is_cancelled = [] { return stop_requested(); }});
  if (!option.keep_folder.empty()) keep(people, option.keep_folder);
  return people;
}

}  // namespace jnd::app
