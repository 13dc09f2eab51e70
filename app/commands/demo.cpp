#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "analysis/data/study_data.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/open_window.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/commands/predictive_option.h"
#include "app/commands/profile_option.h"
#include "app/results/results_output.h"
#include "app/session/device_checks.h"
#include "app/session/pseudonym.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "app/session/shipped_files.h"
#include "core/error.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

constexpr int kParticipants = 13;
constexpr const char* kStudies[] = {"magnitude_of_virtual_water", "viscosity_discrimination"};

struct DemoOptions {
  bool fast = false;
  std::string out;
  std::uint64_t seed = 1;
  std::string laboratory;  ///< "" for the default of the device.
  int jobs = 2;
  std::string device = "lumped";
  std::string profile;  ///< A profile's file; "" for none.
  PredictiveOption predictive;
  bool json = false;
};

/// The results of a folder, compared with the simulated people that were asked for, or with the
/// shipped ones.
analysis::StudyResults compared_results(const fs::path& folder,
                                        const PredictiveOption& predictive) {
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  const analysis::StudyData data = analysis::load_study(store);
  const std::optional<analysis::PredictivePeople> people =
      people_asked_for(predictive, store, data);
  return results_of_data(data, {}, people ? &*people : nullptr);
}

fs::path fresh_folder() {
  for (int number = 1;; ++number) {
    fs::path folder = "demo-" + std::to_string(number);
    if (!fs::exists(folder)) return folder;
  }
}

int run_demo(const DemoOptions& options) {
  require_number_of_people(options.predictive);
  require_device(options.device);
  require_device_moves_by_itself(options.device, "--device " + options.device);
  require_device_keeps_pace(options.device, "--device " + options.device);
  require_device_starts(options.device, 1000.0);
  const fs::path out = options.out.empty() ? fresh_folder() : fs::path(options.out);
  for (const char* name : kStudies) {
    const fs::path folder = out / (std::string(name) + ".study");
    if (fs::exists(folder)) {
      throw UsageError(
          folder.string() +
          ": expected a folder that does not exist yet, found one; nothing is ever "
          "overwritten, choose another --out");
    }
  }
  const experiments::Laboratory laboratory = experiments::read_laboratory(user_or_shipped(
      options.laboratory.empty() ? default_laboratory(options.device) : options.laboratory,
      "data/laboratories"));
  nlohmann::json document = {{"out", out.string()}, {"studies", nlohmann::json::array()}};
  const auto start = std::chrono::steady_clock::now();
  double simulated_s = 0.0;
  bool has_simulated_studies = false;
  for (const char* name : kStudies) {
    const fs::path file = user_or_shipped(name, "protocols");
    const experiments::Study study = experiments::read_study(file);
    const std::optional<KnownProfile> profile =
        profile_for(options.device, options.profile, study);
    const fs::path folder = out / (std::string(name) + ".study");
    {
      core::StudyStore store(folder, core::StudyStore::Mode::kCreate,
                             core::Durability::kAtClose);
      const std::vector<std::int64_t> sessions =
          add_sessions(store,
                       {.study = study,
                        .laboratory = &laboratory,
                        .study_file = file,
                        .device = options.device,
                        .profile = profile ? &*profile : nullptr,
                        .seed = options.seed,
                        .record = !options.fast},
                       next_participants(store, kParticipants));
      ProgressBar bar(name);
      simulated_s += static_cast<double>(
                         run_batch({.study = study,
                                    .laboratory = laboratory,
                                    .store = store,
                                    .sessions = sessions,
                                    .jobs = options.jobs,
                                    .on_progress = [&bar](double done) { bar.show(done); }})) /
                     study.device.rate_hz;
    }
    const analysis::StudyResults results = compared_results(folder, options.predictive);
    has_simulated_studies = results.predictive.num_studies > 0;
    if (options.json) {
      document["studies"].push_back(results_json(results));
    } else {
      std::printf("%s\n", to_comparison_table(results).c_str());
    }
  }
  const double elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (options.json) {
    document["simulated_s"] = simulated_s;
    document["elapsed_s"] = elapsed_s;
    std::puts(json_text(document).c_str());
    return kDone;
  }
  std::printf(
      "All values are SIMULATED, beside those of Schmidt (2018), each by the statistic that "
      "was\n"
      "published. ");
  std::fputs(
      has_simulated_studies
          ? "Simulated studies: of as many people as were published, by the same\n"
            "laboratory; median (middle 95 %). tail: the share of them that is as far on the\n"
            "published value's side, as one more of which the published study is taken; se: "
            "its\n"
            "standard error, for the simulated people are finitely many.\n"
          : "Intervals: 95 %, over resampled participants; of means of the\n"
            "participants by Student's t. z: of means, ours less the published one in units "
            "of\n"
            "both standard errors.\n",
      stdout);
  std::printf(
      "%d sessions, %.0f s at the device in %.1f s; every answer%s is in %s\n"
      "Next: jnd results %s/%s.study\n",
      2 * kParticipants, simulated_s, elapsed_s, options.fast ? "" : " and sample",
      out.string().c_str(), out.string().c_str(), kStudies[1]);
  if (!has_display()) return kDone;
  std::fflush(stdout);
  return open_window(
      {.study_folder = out / (std::string(kStudies[1]) + ".study"), .shows_results = true});
}

}  // namespace

HelpPlace place_of_demo() { return {HelpGroup::kFirstLook, 10}; }

void add_demo(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "demo",
      "Both studies of the thesis with simulated participants, beside the published values");
  invocation.examples[command] = {
      {"jnd demo --fast --out first_look",
       "two studies of 13 simulated participants each, in the folder first_look"},
      {"jnd demo --device exoskeleton",
       "the same on the whole simulated robot; some twenty minutes"}};
  const auto options = std::make_shared<DemoOptions>();
  command->add_flag("--fast", options->fast,
                    "Same sessions and answers; recordings reduced to summaries of strokes");
  command->add_option("--out", options->out, "Folder to make; default: a fresh demo-N");
  command->add_option("--seed", options->seed, "Of everything that is drawn")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("--laboratory", options->laboratory,
                      "Laboratory file, or a shipped one; default: thesis, or "
                      "thesis_exoskeleton with that device");
  command->add_option("--jobs", options->jobs, "Sessions at once")
      ->check(whole_number(1, 1024))
      ->capture_default_str();
  command->add_option("--device", options->device, "Simulated device")->capture_default_str();
  add_profile_option(*command, options->profile);
  add_predictive_option(*command, options->predictive);
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback([&invocation, options] {
    options->predictive.jobs = options->jobs;
    invocation.run = [options] { return run_demo(*options); };
  });
}

}  // namespace jnd::app
