#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/commands/release_stop_option.h"
#include "app/commissioning/asked_bench.h"
#include "app/commissioning/commissioned_profile.h"
#include "app/commissioning/commissioning.h"
#include "app/commissioning/commissioning_json.h"
#include "app/commissioning/commissioning_report.h"
#include "app/commissioning/daily_check.h"
#include "app/operator/remembered_stop.h"
#include "app/profile/known_profile.h"
#include "app/profile/profile_choice.h"
#include "app/session/device_checks.h"
#include "core/error.h"
#include "device/registry/device_registry.h"
#include "experiments/device_profile/profile_writer.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

struct CommissionOptions {
  std::string device;
  std::string record;
  std::string out;
  std::string profile;
  std::string marks;
  std::vector<double> loads_kg = {0.1, 0.2, 0.4};
  double load_uncertainty_ratio = 0.002;
  std::vector<std::string> again;
  std::vector<std::string> only;
  double rate_hz = 1000.0;
  std::uint64_t seed = 1;
  std::string operator_name;
  bool allow_no_realtime = false;
  bool releases_stop = false;
  bool daily = false;
  bool json = false;
};

CommissioningStep step_of(const std::string& option, const std::string& name) {
  if (const auto step = step_named(name)) return *step;
  std::string known;
  for (const CommissioningStep step : kCommissioningSteps) {
    known += (known.empty() ? "" : ", ") + std::string(words_of(step).name);
  }
  throw UsageError(fmt::format("{}: expected one of {}, found {}", option, known, name));
}

/// Reads one mark from each line: x, y and z in metres, separated by commas.
std::vector<Eigen::Vector3d> marks_in(const std::string& file) {
  std::vector<Eigen::Vector3d> marks_m;
  if (file.empty()) return marks_m;
  std::ifstream in(file);
  if (!in) throw UsageError(fmt::format("--marks {}: expected a file that can be read", file));
  std::string line;
  int number = 0;
  while (std::getline(in, line)) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    Eigen::Vector3d mark_m;
    char end = 0;
    if (std::sscanf(line.c_str(), "%lf ,%lf ,%lf %c", &mark_m.x(), &mark_m.y(), &mark_m.z(),
                    &end) != 3 ||
        !mark_m.allFinite() || mark_m.norm() > 10.0) {
      throw core::Error(fmt::format("{}:{}: expected x,y,z of a mark in metres, found \"{}\"",
                                    file, number, line));
    }
    marks_m.push_back(mark_m);
  }
  return marks_m;
}

/// Says what has to be done, and waits for Enter.
void ask_in_terminal(const std::string& to_do) {
  std::cerr << to_do << " Then press Enter. " << std::flush;
  std::string line;
  if (std::getline(std::cin, line)) return;
  throw core::Error(
      "stdin: expected an answer to each step, found its end; run it again with somebody at "
      "the "
      "keyboard, and it goes on with the steps that are left");
}

void print_step(CommissioningStep step, const CommissioningResults& results) {
  fmt::print("{}\n", words_of(step).title);
  for (const FoundLine& line : found_in(step, results)) {
    fmt::print("  {:<52} {} {}\n", line.what, line.value, line.unit);
  }
  std::fflush(stdout);
}

void print_check(const CheckedQuantity& quantity) {
  fmt::print("  {:<6} {:<44} {} {}, expected {}\n", quantity.passed() ? "passed" : "FAILED",
             quantity.what, found_words(quantity), quantity.shown_unit,
             expected_words(quantity));
}

nlohmann::ordered_json check_json(const CheckedQuantity& quantity) {
  return {{"name", quantity.name},
          {"unit", quantity.unit},
          {"expected", quantity.expected},
          {"least", quantity.least},
          {"most", quantity.most},
          {"found", quantity.found.value},
          {"ci95", {quantity.found.ci95_low, quantity.found.ci95_high}},
          {"passed", quantity.passed()}};
}

/// The last act before a real device is measured, for which it is armed.
void forget_released_stop(const CommissionOptions& options,
                          const device::HapticDevice& device) {
  if (!options.releases_stop || device.capabilities().simulated) return;
  forget_stop(stops_folder(), options.device);
}

/// Compares the device with its profile, and stores the result in the profile.
int run_daily(const CommissionOptions& options, const MeasuringPlan& plan,
              device::HapticDevice& device, device::Bench& bench) {
  const bool is_simulated = device.capabilities().simulated;
  std::vector<fs::path> folders = profile_folders();
  // The profile of a simulated device was written to this folder.
  if (is_simulated || !options.out.empty()) {
    folders.insert(folders.begin(),
                   folder_for_profile(options.out, options.record, is_simulated));
  }
  const KnownProfile known = profile_to_check(device_of_profile(options.device, device),
                                              options.profile, folders, today());
  if (!options.json) {
    fmt::print("{}{}, profile {}, {}\n", options.device, is_simulated ? " (SIMULATED)" : "",
               known.place, age_words(known.profile, today()));
    if (device.bench() == nullptr) fmt::print("{}\n", daily_check_to_do());
    std::fflush(stdout);
  }
  forget_released_stop(options, device);
  const DailyCheckResult result = [&] {
    ProgressBar bar("daily");
    return check_daily(device, bench, plan, known.profile,
                       std::max(today(), experiments::last_checked_on(known.profile)),
                       [&](double done, const std::string&) { bar.show(done); });
  }();
  experiments::add_daily_check(known.place, result.kept);
  if (options.json) {
    nlohmann::ordered_json out = {{"device", options.device},
                                  {"model", known.profile.device.model},
                                  {"serial", known.profile.device.serial},
                                  {"simulated", is_simulated},
                                  {"profile", known.place},
                                  {"checked_on", result.kept.checked_on},
                                  {"passed", result.passed()},
                                  {"quantities", nlohmann::ordered_json::array()}};
    for (const CheckedQuantity& quantity : result.quantities) {
      out["quantities"].push_back(check_json(quantity));
    }
    fmt::print("{}\n", json_text(out));
  } else {
    for (const CheckedQuantity& quantity : result.quantities) print_check(quantity);
    fmt::print(
        "{}\n",
        result.passed()
            ? "passed: the device is as its profile says"
            : "FAILED: no session begins with this profile until a check is passed; look "
              "for the reason, then check again or measure the device anew");
  }
  return result.passed() ? kDone : kHasProblems;
}

int run_commission(const CommissionOptions& options) {
  require_device(options.device);
  if (options.daily && (!options.again.empty() || !options.only.empty())) {
    throw UsageError(
        "--daily: expected neither --again nor --only, for a daily check has no steps, found "
        "one of them");
  }
  if (!options.daily && !options.profile.empty()) {
    throw UsageError(
        "--profile: expected with --daily, for otherwise a profile is written, found without");
  }
  const MeasuringPlan plan{.rate_hz = options.rate_hz,
                           .marks_m = marks_in(options.marks),
                           .loads_kg = options.loads_kg,
                           .load_uncertainty_ratio = options.load_uncertainty_ratio,
                           .seed = options.seed,
                           .allow_no_realtime = options.allow_no_realtime,
                           .operator_name = options.operator_name};
  std::vector<CommissioningStep> again, only;
  for (const std::string& name : options.again) again.push_back(step_of("--again", name));
  for (const std::string& name : options.only) only.push_back(step_of("--only", name));
  stop_on_signals();

  const std::unique_ptr<device::HapticDevice> device =
      device::make_device(options.device, options.rate_hz);
  if (!device->capabilities().simulated && options.json) {
    throw UsageError(
        "--json: expected a simulated device, for a real one asks what to do, found " +
        options.device);
  }
  if (!device->capabilities().simulated) {
    require_stop_released(stops_folder(), options.device, options.releases_stop);
  }
  AskedBench asked(ask_in_terminal);
  device::Bench* bench = device->bench() != nullptr ? device->bench() : &asked;
  if (options.daily) return run_daily(options, plan, *device, *bench);
  Commissioning commissioning(
      options.record.empty() ? usual_record(options.device) : fs::path(options.record),
      {.name = options.device, .identity = device->identity(), .can = device->capabilities()},
      plan);
  for (const CommissioningStep step : again) commissioning.undo(step);

  if (!options.json) {
    fmt::print("{}{}, record {}\n", options.device,
               device->capabilities().simulated ? " (SIMULATED)" : "",
               commissioning.record().string());
  }
  bool has_measured = false;
  for (const CommissioningStep step : kCommissioningSteps) {
    const bool is_wanted =
        only.empty() || std::find(only.begin(), only.end(), step) != only.end();
    if (is_wanted && !commissioning.results().has(step)) {
      if (device->bench() == nullptr) {
        fmt::print("\n{}\n{}\n", words_of(step).title, words_of(step).to_do);
        std::fflush(stdout);
      }
      if (!has_measured) forget_released_stop(options, *device);
      ProgressBar bar(std::string(words_of(step).name));
      commissioning.measure(step, *device, *bench,
                            [&](double done, const std::string&) { bar.show(done); });
      has_measured = true;
    }
    if (!options.json && commissioning.results().has(step)) {
      print_step(step, commissioning.results());
    }
  }
  CommissioningFiles files;
  if (!commissioning.next_step() && (has_measured || !options.out.empty())) {
    files = write_commissioning_files(
        commissioning, device->identity(),
        folder_for_profile(options.out, options.record, device->capabilities().simulated),
        JND_VERSION, today());
    for (const std::string& problem : files.report.problems) {
      std::fprintf(stderr, "jnd: %s\n", problem.c_str());
    }
    if (!options.json) {
      fmt::print("profile: {}\nreport: {}{}\n", files.profile.string(),
                 files.report.html.string(), files.report.pdf.empty() ? "" : " and report.pdf");
    }
  }
  if (options.json) {
    nlohmann::ordered_json out = {{"device", options.device},
                                  {"model", commissioning.device().identity.model},
                                  {"serial", commissioning.device().identity.serial},
                                  {"simulated", commissioning.device().can.simulated},
                                  {"record", commissioning.record().string()},
                                  {"complete", !commissioning.next_step().has_value()},
                                  {"profile", files.profile.string()},
                                  {"report", files.report.html.string()},
                                  {"report_pdf", files.report.pdf.string()},
                                  {"steps", results_json(commissioning.results())}};
    fmt::print("{}\n", json_text(out));
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_commission() { return {HelpGroup::kApparatus, 50}; }

void add_commission(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<CommissionOptions>();
  CLI::App* command = program.add_subcommand(
      "commission",
      "Measures a device before a hand is in it, and writes its profile and a report of it");
  invocation.examples[command] = {{"jnd commission twin:seed=7",
                                   "measures a simulated device with the faults of real ones"}};
  command->add_option("device", options->device, "As after --device")->required();
  command->add_flag("--daily", options->daily,
                    "Check that the device is still as its profile says, in about two minutes, "
                    "and keep that in the profile; exit 1 where it is not");
  command->add_option("--profile", options->profile,
                      "With --daily: the profile, NAME.device.json (default: the device's own, "
                      "where it is found)");
  command->add_option("--record", options->record,
                      "File that keeps every measurement; one that is there is gone on with "
                      "(default: DEVICE.commissioning.jsonl)");
  command->add_option(
      "--out", options->out,
      "Folder for the profile, NAME.device.json, and the report, NAME.report (default: where "
      "sessions look for profiles; of a simulated device, beside the record)");
  command->add_option("--again", options->again, "Steps to measure anew, commas between")
      ->delimiter(',');
  command->add_option("--only", options->only, "Steps to measure now, commas between")
      ->delimiter(',');
  command->add_option("--marks", options->marks,
                      "CSV file of the marks to touch, x,y,z in metres a line (default: the "
                      "corners of a box of 20 cm)");
  command->add_option("--loads-kg", options->loads_kg, "Known weights to hang from the tool")
      ->delimiter(',')
      ->check(number_between(0.001, 5.0))
      ->capture_default_str();
  command
      ->add_option("--load-uncertainty", options->load_uncertainty_ratio,
                   "Standard uncertainty of these weights, over them")
      ->check(number_between(0.0, 0.5))
      ->capture_default_str();
  command->add_option("--rate-hz", options->rate_hz, "Ticks a second")
      ->check(number_between(100.0, 10'000.0))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of where the ways begin")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("--operator", options->operator_name,
                      "Who measures, for the record and the report");
  command->add_flag("--allow-no-realtime", options->allow_no_realtime,
                    "A real device also without real-time priority");
  add_release_stop_option(*command, options->releases_stop);
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_commission(*options); };
  });
}

}  // namespace jnd::app
