#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/stop_signals.h"
#include "app/session/device_checks.h"
#include "app/session/device_run.h"
#include "core/error.h"
#include "core/safety/fault.h"
#include "device/registry/device_registry.h"
#include "device/simulated_hand.h"

namespace jnd::app {
namespace {

struct LoopOptions {
  double rate_hz = 1000.0;
  double seconds = 5.0;
  std::string device = "lumped";
  int cpu = -1;
  bool json = false;
};

struct Percentiles {
  double p50, p99, p999, max;
};

Percentiles percentiles_us(const device::DurationHistogram& durations) {
  const auto at = [&durations](double ratio) {
    return 1e-3 * static_cast<double>(durations.percentile_ns(ratio));
  };
  return {at(0.5), at(0.99), at(0.999), 1e-3 * static_cast<double>(durations.max_ns())};
}

nlohmann::ordered_json json_of(const Percentiles& us) {
  return {{"p50", us.p50}, {"p99", us.p99}, {"p999", us.p999}, {"max", us.max}};
}

void print_line(const char* what, const Percentiles& us) {
  fmt::print("  {:<12} {:>10.1f} {:>10.1f} {:>10.1f} {:>10.1f}\n", what, us.p50, us.p99,
             us.p999, us.max);
}

/// Everything that there is to tell about a run.
struct LoopOutcome {
  const LoopOptions& options;
  const device::LoopTiming& timing;
  const device::RealtimeReport& report;
  const device::ThreadUse& use;
  const device::DeviceCapabilities& can;
  core::ForceCounts forces{};
  std::int64_t num_samples = 0;  ///< Measurements that were new.
  std::int64_t num_moved = 0;    ///< Of them, with another position than the one before.
  std::uint64_t num_dropped_samples = 0;

  [[nodiscard]] double cpu_time_ratio() const {
    const auto num_ticks = static_cast<double>(timing.num_ticks() + timing.missed_ticks());
    return num_ticks > 0.0 ? use.cpu_time_s * options.rate_hz / num_ticks : 0.0;
  }
};

/// New measurements, and those that moved.
class MovedSamples {
 public:
  void feed(const core::Sample& sample) {
    const bool is_new = !last_ || sample.device_time_ns != last_->device_time_ns ||
                        sample.tip_position_m != last_->tip_position_m;
    if (!is_new) return;
    ++num_samples_;
    num_moved_ += last_ && sample.tip_position_m != last_->tip_position_m ? 1 : 0;
    last_ = sample;
  }
  [[nodiscard]] std::int64_t num_samples() const noexcept { return num_samples_; }
  [[nodiscard]] std::int64_t num_moved() const noexcept { return num_moved_; }

 private:
  std::optional<core::Sample> last_;
  std::int64_t num_samples_ = 0, num_moved_ = 0;
};

/// What this run cannot know of the device, a part of a sentence each: a loop that is punctual
/// says nothing of these.
std::vector<std::string> not_measured(const LoopOutcome& outcome) {
  std::vector<std::string> lacks;
  if (outcome.num_moved == 0) {
    lacks.emplace_back(
        "movement (no measurement differed from the one before; move the device meanwhile)");
  }
  if (outcome.forces.num_acted == 0) {
    lacks.emplace_back(outcome.can.simulated
                           ? "force (none acted)"
                           : "force (a real device gets none here; `jnd commission` measures "
                             "how it gives forces)");
  }
  if (!outcome.can.tells_acting_force &&
      (outcome.can.has_own_clock || !outcome.can.simulated)) {
    lacks.emplace_back(
        "which force acts (the device does not tell, and a real one is then never armed)");
  }
  if (!outcome.can.simulated) {
    lacks.emplace_back(
        "the delay of the closed loop, from a force to its effect (`jnd commission` measures "
        "it)");
  }
  return lacks;
}

std::string punctuality(const LoopOutcome& outcome, bool is_all_measured) {
  if (outcome.timing.missed_ticks() > 0) {
    return fmt::format(
        "Not fit for a person: {} ticks were missed. Close other programs, or give "
        "the loop a CPU of its own (--cpu).",
        outcome.timing.missed_ticks());
  }
  if (outcome.num_dropped_samples > 0) {
    return fmt::format("Not fit for a person: {} samples were lost. Close other programs.",
                       outcome.num_dropped_samples);
  }
  if (!outcome.report.realtime_scheduler || !outcome.report.memory_locked) {
    return "Fit for simulated devices alone: " + outcome.report.lacks + ".";
  }
  const double period_us = 1e6 / outcome.options.rate_hz;
  if (percentiles_us(outcome.timing.lateness()).p999 > 0.2 * period_us) {
    return "Usable, but one tick in a thousand came later than a fifth of its period.";
  }
  return is_all_measured ? "Fit for a person: no tick was missed and every force came in time."
                         : "Punctual enough for a person: no tick was missed. Whether the "
                           "device is fit for one, this does not say.";
}

std::string verdict(const LoopOutcome& outcome) {
  const std::vector<std::string> lacks = not_measured(outcome);
  std::string words = punctuality(outcome, lacks.empty());
  if (lacks.empty()) return words;
  return fmt::format("{} Not measured: {}.", words, fmt::join(lacks, "; "));
}

void print_for_people(const LoopOutcome& outcome) {
  const device::RealtimeReport& report = outcome.report;
  fmt::print("{} ticks at {:g} Hz on {}, {} missed; {} samples lost\n",
             outcome.timing.num_ticks(), outcome.options.rate_hz, outcome.options.device,
             outcome.timing.missed_ticks(), outcome.num_dropped_samples);
  fmt::print(
      "{} on CPU {}, memory {}, {} page faults, {:.0f} % of a CPU used, idle CPUs {}\n\n",
      report.scheduler, fmt::join(report.cpus, " or "),
      report.memory_locked ? "locked" : "not locked", outcome.use.num_page_faults,
      100.0 * outcome.cpu_time_ratio(), report.cpus_kept_awake ? "kept awake" : "may sleep");
  fmt::print("  {:<12} {:>10} {:>10} {:>10} {:>10}\n", "us", "p50", "p99", "p99.9", "max");
  print_line("lateness", percentiles_us(outcome.timing.lateness()));
  print_line("tick cost", percentiles_us(outcome.timing.tick_cost()));
  fmt::print("\n{} new measurements, {} of them moved; a force acted in {} ticks\n",
             outcome.num_samples, outcome.num_moved, outcome.forces.num_acted);
  fmt::print("\n{}\n", verdict(outcome));
}

void print_json(const LoopOutcome& outcome) {
  nlohmann::ordered_json out;
  out["rate_hz"] = outcome.options.rate_hz;
  out["num_ticks"] = outcome.timing.num_ticks();
  out["missed_ticks"] = outcome.timing.missed_ticks();
  out["lateness_us"] = json_of(percentiles_us(outcome.timing.lateness()));
  out["tick_cost_us"] = json_of(percentiles_us(outcome.timing.tick_cost()));
  out["scheduler"] = outcome.report.scheduler;
  out["memory_locked"] = outcome.report.memory_locked;
  out["priority"] = outcome.report.priority;
  out["cpus"] = outcome.report.cpus;
  out["cpus_kept_awake"] = outcome.report.cpus_kept_awake;
  out["cpu_time_ratio"] = outcome.cpu_time_ratio();
  out["num_page_faults"] = outcome.use.num_page_faults;
  out["num_dropped_samples"] = outcome.num_dropped_samples;
  out["device"] = outcome.options.device;
  out["num_new_samples"] = outcome.num_samples;
  out["num_moved_samples"] = outcome.num_moved;
  out["num_ticks_with_force"] = outcome.forces.num_acted;
  out["not_measured"] = not_measured(outcome);
  out["verdict"] = verdict(outcome);
  fmt::print("{}\n", json_text(out));
}

std::unique_ptr<device::HapticDevice> device_of(const LoopOptions& options) {
  try {
    return device::make_device(options.device, options.rate_hz);
  } catch (const device::DeviceUnreachable&) {
    throw;
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
}

std::unique_ptr<DeviceRun> started(device::HapticDevice& device, const LoopOptions& options) {
  try {
    return std::make_unique<DeviceRun>(
        device, DeviceRun::Parameters{.rate_hz = options.rate_hz, .cpu = options.cpu});
  } catch (const core::Error& error) {
    throw EnvironmentError(error.what());
  }
}

int run_loop(const LoopOptions& options) {
  if (!(options.seconds > 0.0 && options.seconds <= 86'400.0)) {
    throw UsageError(fmt::format("--seconds: expected a number > 0 and at most 86400, found {}",
                                 options.seconds));
  }
  if (!(options.rate_hz > 0.0 && options.rate_hz <= 100'000.0)) {
    throw UsageError(fmt::format(
        "--rate-hz: expected a number > 0 and at most 100000, found {}", options.rate_hz));
  }
  require_device(options.device);
  const std::unique_ptr<device::HapticDevice> device = device_of(options);
  stop_on_signals();
  const std::unique_ptr<DeviceRun> run = started(*device, options);
  // A simulated hand strokes through water, so that a tick contains everything. A real device
  // stays in free space and has no force.
  if (device->capabilities().simulated) run->render(core::water({}));
  if (device::SimulatedHand* hand = device->simulated_hand()) {
    hand->begin_strokes({}, core::RandomStream(1, "loop"));
  }
  MovedSamples moved;
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
  while (std::chrono::steady_clock::now() < end && !stop_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    run->take([&](const core::Sample& sample) { moved.feed(sample); });
  }
  // Known while it is open.
  const std::string said_by_device = device->words_of_fault();
  const bool device_answers = device->answers();
  run->stop();

  const device::DeviceCapabilities can = device->capabilities();
  const LoopOutcome outcome{.options = options,
                            .timing = run->thread().timing(),
                            .report = run->thread().report(),
                            .use = run->thread().use(),
                            .can = can,
                            .forces = run->telemetry().force_counts,
                            .num_samples = moved.num_samples(),
                            .num_moved = moved.num_moved(),
                            .num_dropped_samples = run->num_dropped_samples()};
  if (options.json) {
    print_json(outcome);
  } else {
    print_for_people(outcome);
  }
  const core::Fault fault = run->telemetry().fault;
  const bool was_ended = fault == core::Fault::kEmergencyStop && stop_requested();
  if (!core::is_failure(fault) || was_ended) return kDone;
  fmt::print(stderr, "jnd: {}\n", fault_words(fault, said_by_device, device_answers));
  return kHasProblems;
}

}  // namespace

HelpPlace place_of_loop() { return {HelpGroup::kApparatus, 20}; }

void add_loop(CLI::App& program, Invocation& invocation) {
  auto options = std::make_shared<LoopOptions>();
  CLI::App* command =
      program.add_subcommand("loop", "Runs the haptic loop and tells how punctual it is");
  invocation.examples[command] = {{"jnd loop --seconds 10", "how punctual this machine is"}};
  command->add_option("--rate-hz", options->rate_hz, "Ticks a second (default 1000)");
  command->add_option("--seconds", options->seconds, "How long (default 5)");
  command->add_option("--device", options->device, "As `jnd devices` lists them");
  command->add_option("--cpu", options->cpu, "Pin the loop to this CPU")
      ->check(whole_number(0, 1023));
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback(
      [options, &invocation] { invocation.run = [options] { return run_loop(*options); }; });
}

}  // namespace jnd::app
