#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/commands/effect_option.h"
#include "app/commands/field_options.h"
#include "app/commands/profile_option.h"
#include "app/session/device_checks.h"
#include "app/session/pseudonym.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "app/session/shipped_files.h"
#include "core/error.h"
#include "experiments/participants/abilities.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace {

struct SimulateOptions {
  std::string file;
  int participants = 0;
  std::string folder;
  std::string laboratory;  ///< "" for the default of the device.
  std::uint64_t seed = 1;
  int jobs = 2;
  std::string device = "lumped";
  std::string profile;               ///< A profile's file; "" for none.
  std::vector<std::string> fields;   ///< Such as "sex=female".
  std::vector<std::string> effects;  ///< See `add_effect_option`.
  bool fast = false;
  bool json = false;
};

int run_simulate(const SimulateOptions& options) {
  require_device(options.device);
  require_device_moves_by_itself(options.device, "--device " + options.device);
  require_device_keeps_pace(options.device, "--device " + options.device);
  const std::filesystem::path file = user_or_shipped(options.file, "protocols");
  const experiments::Study study = experiments::read_study(file);
  experiments::FieldValues fields = fields_or_none(study, options.fields);
  require_device_starts(options.device, study.device.rate_hz);
  const std::optional<KnownProfile> profile =
      profile_for(options.device, options.profile, study);
  const experiments::Laboratory laboratory = laboratory_with_effects(
      options.laboratory.empty() ? default_laboratory(options.device) : options.laboratory,
      options.effects);
  // Checked before the folder is made.
  experiments::require_abilities(laboratory, study);
  core::StudyStore store(options.folder, core::StudyStore::Mode::kCreate,
                         core::Durability::kAtClose);
  const std::size_t num_before = store.sessions().size();
  const std::vector<std::string> participants = next_participants(store, options.participants);
  const std::vector<std::int64_t> sessions =
      add_sessions(store,
                   {.study = study,
                    .laboratory = &laboratory,
                    .study_file = file,
                    .device = options.device,
                    .profile = profile ? &*profile : nullptr,
                    .seed = options.seed,
                    .record = !options.fast,
                    .fields = std::move(fields)},
                   participants);
  stop_on_signals();
  const auto start = std::chrono::steady_clock::now();
  std::int64_t num_ticks = 0;
  {
    ProgressBar bar(study.name);
    num_ticks = run_batch({.study = study,
                           .laboratory = laboratory,
                           .store = store,
                           .sessions = sessions,
                           .jobs = options.jobs,
                           .on_progress = [&bar](double done) { bar.show(done); },
                           .is_cancelled = [] { return stop_requested(); }});
  }
  if (stop_requested()) {
    throw core::Error(options.folder +
                      ": stopped, and some of its sessions are open; `jnd resume " +
                      options.folder + " --headless --session N` goes on with each");
  }
  const double simulated_s = static_cast<double>(num_ticks) / study.device.rate_hz;
  const double elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (options.json) {
    const nlohmann::json document = {{"study", study.name},          {"folder", options.folder},
                                     {"participants", participants}, {"num_ticks", num_ticks},
                                     {"simulated_s", simulated_s},   {"elapsed_s", elapsed_s}};
    std::puts(json_text(document).c_str());
  } else {
    const std::string beside =
        num_before == 0 ? "" : ", beside " + std::to_string(num_before) + " from before";
    std::printf(
        "%s: %d simulated sessions, %.0f s at the device (no breaks, no talk) in %.1f s, "
        "stored in %s%s\n",
        study.name.c_str(), options.participants, simulated_s, elapsed_s,
        options.folder.c_str(), beside.c_str());
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_simulate() { return {HelpGroup::kRunning, 20}; }

void add_simulate(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("simulate", "Whole sessions with simulated participants");
  invocation.examples[command] = {
      {"jnd simulate my_study.json --participants 8 --study my_study.study",
       "eight whole sessions, faster than real time"}};
  const auto options = std::make_shared<SimulateOptions>();
  command->add_option("FILE", options->file, "Study file, or the name of a shipped study")
      ->required();
  command->add_option("--participants", options->participants, "How many")
      ->required()
      ->check(whole_number(1, 100000));
  command->add_option("--study", options->folder, "Study folder to store in, made if absent")
      ->required();
  command->add_option("--laboratory", options->laboratory,
                      "Laboratory file, or a shipped one; default: thesis, or "
                      "thesis_exoskeleton with that device");
  add_effect_option(*command, options->effects);
  command->add_option("--seed", options->seed, "Of everything that is drawn")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Sessions at once")
      ->check(whole_number(1, 1024))
      ->capture_default_str();
  command->add_option("--device", options->device, "Simulated device")->capture_default_str();
  add_profile_option(*command, options->profile);
  add_field_option(*command, options->fields,
                   "What all of them bring; default: drawn for each");
  command->add_flag("--fast", options->fast, "Keep summaries of strokes instead of samples");
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_simulate(*options); };
  });
}

}  // namespace jnd::app
