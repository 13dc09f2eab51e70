#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/stop_signals.h"
#include "app/command_line/usage_message.h"
#include "app/commands/release_stop_option.h"
#include "app/operator/remembered_stop.h"
#include "app/session/device_checks.h"
#include "core/error.h"
#include "device/check/driver_check.h"
#include "device/check/network_check.h"
#include "device/network/network_options.h"
#include "device/network/udp_port.h"
#include "device/realtime_report.h"
#include "device/realtime_thread.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

using device::RuleOutcome;
using Verdict = RuleOutcome::Verdict;

struct DeviceCheckOptions {
  std::string device;
  double rate_hz = 1000.0;
  bool with_force = false;
  bool releases_stop = false;
  bool by_hand = false;
  double step_s = 4.0;
  bool json = false;

  [[nodiscard]] std::optional<double> by_hand_step_s() const {
    return by_hand ? std::optional(step_s) : std::nullopt;
  }
};

/// For people and programs alike: on stderr, a line when a step begins and every second after.
void print_prompt(const device::HandPrompt& prompt) {
  fmt::print(stderr, "PROMPT {}: {} ({:.0f} s left)\n", prompt.step, prompt.text,
             std::ceil(prompt.left_s));
  std::fflush(stderr);
}

/// The table, line by line as outcomes come in.
class Outcomes {
 public:
  explicit Outcomes(bool json) : json_(json) {}

  void add(const RuleOutcome& outcome) {
    ++counts_[static_cast<std::size_t>(outcome.verdict)];
    const bool is_broken = outcome.verdict == Verdict::kFailed;
    if (json_) {
      rules_.push_back({{"rule", outcome.rule.name},
                        {"verdict", device::name(outcome.verdict)},
                        {"demand", outcome.rule.demand},
                        {"found", outcome.found},
                        {"advice", is_broken ? outcome.rule.advice : ""}});
      return;
    }
    fmt::print("{:<5} {:<16} {}\n", device::name(outcome.verdict), outcome.rule.name,
               outcome.rule.demand);
    if (!outcome.found.empty()) fmt::print("{:22} found: {}\n", "", outcome.found);
    if (is_broken) fmt::print("{:22} to do: {}\n", "", outcome.rule.advice);
    std::fflush(stdout);
  }

  void end(const std::string& device, bool is_real, bool is_by_hand) const {
    const auto count = [&](Verdict verdict) {
      return counts_[static_cast<std::size_t>(verdict)];
    };
    if (json_) {
      nlohmann::ordered_json out;
      out["device"] = device;
      out["simulated"] = !is_real;
      out["num_passed"] = count(Verdict::kPassed);
      out["num_failed"] = count(Verdict::kFailed);
      out["num_skipped"] = count(Verdict::kSkipped);
      out["rules"] = rules_;
      fmt::print("{}\n", json_text(out));
      return;
    }
    if (!is_by_hand) {
      fmt::print(
          "Directions, order of points, buttons and workspace are tried by a person who moves "
          "the device: --by-hand.\n");
    }
    fmt::print("{} rules kept, {} broken, {} not tried\n", count(Verdict::kPassed),
               count(Verdict::kFailed), count(Verdict::kSkipped));
    if (is_real) {
      fmt::print(
          "This says nothing of the robot's own safety: its watchdog, its limits and its "
          "emergency stop are to be tried by hand.\n");
    }
  }

 private:
  bool json_;
  std::array<int, 3> counts_{};
  nlohmann::ordered_json rules_ = nlohmann::ordered_json::array();
};

/// Follows the options behind the address, but does not believe a device that calls itself
/// simulated.
int check_network(const DeviceCheckOptions& options, Outcomes& outcomes) {
  device::NetworkOptions network;
  std::optional<device::DeviceKey> key;
  device::Address server;
  try {
    network = device::network_options(device::argument_of(options.device));
    server = device::resolved(network.endpoint);
    if (!network.key_name.empty()) {
      key = device::read_device_key(device::device_key_file(network.key_name));
    }
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  if (!key && !device::is_loopback(server)) {
    throw UsageError(
        "--device: expected a key for a device on a network where others are, found "
        "none; write HOST:PORT,key=NAME");
  }
  const bool believes_simulated = network.is_simulated.value_or(false);
  if (options.with_force && !believes_simulated) {
    require_stop_released(stops_folder(), options.device, options.releases_stop);
    if (options.releases_stop) forget_stop(stops_folder(), options.device);
  }
  const bool is_kept = device::check_network_device(
      {.open_port = [&] { return device::UdpPort::connected_to(server); },
       .server = server,
       .key = key,
       .pushes = options.with_force,
       .believes_simulated = believes_simulated,
       .by_hand_step_s = options.by_hand_step_s(),
       .prompt = print_prompt},
      [&](const RuleOutcome& outcome) { outcomes.add(outcome); });
  outcomes.end(options.device, !believes_simulated, options.by_hand);
  return is_kept ? kDone : kHasProblems;
}

int check_local(const DeviceCheckOptions& options, const device::RealtimeReport& report,
                Outcomes& outcomes) {
  std::unique_ptr<device::HapticDevice> device;
  require_device(options.device);
  try {
    device = device::make_device(options.device, options.rate_hz);
  } catch (const device::DeviceUnreachable&) {
    throw;
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  try {
    // Opening the device may turn its motors on.
    device::require_realtime(*device, report,
                             /*allow_no_realtime=*/device->capabilities().simulated);
  } catch (const core::Error& error) {
    throw EnvironmentError(error.what());
  }
  if (options.with_force && !options.by_hand && !device->capabilities().simulated) {
    require_stop_released(stops_folder(), options.device, options.releases_stop);
    if (options.releases_stop) forget_stop(stops_folder(), options.device);
  }
  stop_on_signals();
  const bool is_kept =
      device::check_driver(*device,
                           {.pushes = options.with_force,
                            .is_cancelled = stop_requested,
                            .by_hand_step_s = options.by_hand_step_s(),
                            .prompt = print_prompt},
                           [&](const RuleOutcome& outcome) { outcomes.add(outcome); });
  outcomes.end(options.device, !device->capabilities().simulated, options.by_hand);
  return is_kept ? kDone : kHasProblems;
}

int run_device_check(const DeviceCheckOptions& options) {
  if (options.by_hand && options.with_force) {
    throw UsageError(
        "--by-hand: expected no --with-force beside it, for a hand is in the device, found "
        "both; run one after the other");
  }
  Outcomes outcomes(options.json);
  device::RealtimeReport report;
  device::obtain_scheduler(80, report);
  device::obtain_locked_memory(report);
  device::prefault_stack();
  if (device::kind_of(options.device) == "network") return check_network(options, outcomes);
  return check_local(options, report, outcomes);
}

}  // namespace

HelpPlace place_of_device_check() { return {HelpGroup::kApparatus, 40}; }

void add_device_check(CLI::App& program, Invocation& invocation) {
  auto options = std::make_shared<DeviceCheckOptions>();
  CLI::App* command = program.add_subcommand(
      "device-check",
      "Tries a device of yours, across the network or by a plug-in, rule by rule");
  invocation.examples[command] = {
      {"jnd device-check plugin:./my_driver.so", "does a driver of yours keep the rules?"}};
  command
      ->add_option("device", options->device,
                   "As after --device: network:HOST:PORT,key=NAME or plugin:PATH")
      ->required();
  command->add_flag(
      "--with-force", options->with_force,
      "Push a real device by 0.5 N for moments: take every hand out of it before. "
      "A simulation is always pushed");
  command
      ->add_option("--rate-hz", options->rate_hz, "Ticks a second of a plug-in (default 1000)")
      ->check(number_between(10.0, 10'000.0));
  add_release_stop_option(*command, options->releases_stop);
  command->add_flag("--by-hand", options->by_hand,
                    "Ask you to move the device, to see that directions, points, buttons and "
                    "workspace are told truly; it is not pushed, whatever it is");
  command
      ->add_option("--step-s", options->step_s,
                   "With --by-hand, how long you have for each prompt (default 4)")
      ->check(number_between(0.5, 60.0));
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback([options, &invocation] {
    invocation.run = [options] { return run_device_check(*options); };
  });
}

}  // namespace jnd::app
