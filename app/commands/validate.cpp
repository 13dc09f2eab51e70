#include "app/commands/validate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/commands/device_problems.h"
#include "app/profile/profile_choice.h"
#include "app/session/device_checks.h"
#include "app/session/device_limits.h"
#include "app/session/shipped_files.h"
#include "experiments/device_profile/profile_reader.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace {

struct ValidateOptions {
  std::vector<std::string> files;
  std::string device;  ///< "" checks the study alone.
  /// The file of the device's profile; if "", a real device's own is looked for.
  std::string profile;
  double speed_m_per_s = 0.5;
  bool json = false;
};

bool is_profile(const std::filesystem::path& file) {
  return file.filename().string().ends_with(experiments::kDeviceProfileEnding);
}

std::vector<experiments::StudyProblem> problems_of(const std::filesystem::path& file,
                                                   const ValidateOptions& options,
                                                   const std::optional<KnownProfile>& profile) {
  if (is_profile(file)) return experiments::device_profile_problems(file);
  std::vector<experiments::StudyProblem> found = experiments::study_problems(file);
  if (!found.empty() || options.device.empty()) return found;
  return device_problems(file, options.device, profile, options.speed_m_per_s);
}

/// What is said of a file without a problem.
std::string praise(const std::filesystem::path& file, const ValidateOptions& options,
                   const std::string& own_limit) {
  if (is_profile(file)) {
    const experiments::DeviceProfile profile = experiments::read_device_profile(file);
    return fmt::format(
        "no problem; `{}`{}{}, measured on {}, valid until {}", profile.device.model,
        profile.device.serial.empty() ? "" : " " + profile.device.serial,
        profile.simulated ? ", SIMULATED" : "", profile.measured_on, profile.valid_until);
  }
  return options.device.empty()
             ? "no problem; --device NAME tells whether that device can render it"
             : "no problem on " + options.device + (own_limit.empty() ? "" : "; " + own_limit);
}

int run_validate(const ValidateOptions& options) {
  std::optional<KnownProfile> profile;
  std::string own_limit;
  if (!options.device.empty()) {
    require_device(options.device);
    constexpr double kAnyRateHz = 1000.0;
    profile = choose_profile(device_of_profile(options.device, kAnyRateHz), options.profile,
                             profile_folders(), today())
                  .known;
    own_limit = own_limit_words(options.device,
                                limits_of_device(options.device, kAnyRateHz, profile).can);
  }
  std::vector<experiments::StudyProblem> problems, doubts;
  const auto add = [](auto& all, std::vector<experiments::StudyProblem> found) {
    all.insert(all.end(), std::make_move_iterator(found.begin()),
               std::make_move_iterator(found.end()));
  };
  for (const std::string& name : options.files) {
    const std::filesystem::path file = user_or_shipped(name, "protocols", /*keep_near=*/true);
    std::vector<experiments::StudyProblem> found = problems_of(file, options, profile);
    if (!options.json && found.empty()) {
      fmt::print("{}: {}\n", name, praise(file, options, own_limit));
    }
    const bool is_sound_study = found.empty() && !is_profile(file);
    add(problems, std::move(found));
    if (!is_profile(file)) add(doubts, experiments::study_doubts(file));
    if (is_sound_study && options.device.empty()) {
      add(doubts, force_doubts(file, options.speed_m_per_s));
    }
  }
  if (options.json) {
    nlohmann::ordered_json document = problems_json(problems);
    document["warnings"] = problems_json(doubts)["problems"];
    fmt::print("{}\n", json_text(document));
  } else {
    for (const experiments::StudyProblem& problem : problems) {
      fmt::print("{}\n", to_string(problem));
    }
    for (experiments::StudyProblem doubt : doubts) {
      doubt.message = "warning: " + doubt.message;
      fmt::print("{}\n", to_string(doubt));
    }
  }
  if (problems.empty()) return kDone;
  fmt::print(stderr, "jnd: {} problem{} found\n", problems.size(),
             problems.size() == 1 ? "" : "s");
  return kHasProblems;
}

}  // namespace

nlohmann::ordered_json problems_json(const std::vector<experiments::StudyProblem>& problems) {
  auto list = nlohmann::ordered_json::array();
  for (const experiments::StudyProblem& problem : problems) {
    list.push_back({{"file", problem.file},
                    {"line", problem.line},
                    {"column", problem.column},
                    {"pointer", problem.pointer},
                    {"message", problem.message}});
  }
  return {{"problems", std::move(list)}};
}

std::string error_json(const core::Error& error) {
  if (const auto* protocol = dynamic_cast<const experiments::ProtocolError*>(&error)) {
    return json_text(problems_json(protocol->problems()));
  }
  return json_text(nlohmann::ordered_json{{"error", error.what()}});
}

HelpPlace place_of_validate() { return {HelpGroup::kWriting, 10}; }

void add_validate(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "validate", "Tell every problem of study files and device profiles");
  invocation.examples[command] = {
      {"jnd validate my_study.json", "every problem at its line, and levels to look at again"},
      {"jnd validate my_study.json --device exoskeleton",
       "also every stimulus that the device cannot render"}};
  const auto options = std::make_shared<ValidateOptions>();
  command
      ->add_option("FILE", options->files,
                   "Study files, or names of shipped studies; device profiles "
                   "(NAME.device.json)")
      ->required();
  command->add_option(
      "--device", options->device,
      "Also whether it can render every stimulus, and stably; see `jnd devices`");
  command
      ->add_option("--profile", options->profile,
                   "What was measured of the device, NAME.device.json, with --device; default: "
                   "a real device's own, where it is found")
      ->needs("--device");
  command
      ->add_option("--speed-m-per-s", options->speed_m_per_s,
                   "Speed of the hand that forces are expected at")
      ->check(number_between(0.001, 10.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_validate(*options); };
  });
}

}  // namespace jnd::app
