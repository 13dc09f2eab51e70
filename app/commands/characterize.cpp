#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/session/device_checks.h"
#include "app/session/device_run.h"
#include "app/session/person_bench.h"
#include "core/error.h"
#include "device/exoskeleton/characterization.h"
#include "device/exoskeleton/simulated_bench.h"
#include "device/registry/device_registry.h"
#include "device/simulated_hand.h"

namespace jnd::app {
namespace {

using nlohmann::ordered_json;

constexpr double kRate_hz = 1000.0;
constexpr double kStroking_s = 20.0;
constexpr std::array kJoints = {"abduction", "extension", "proximal"};

struct CharacterizeOptions {
  std::string device = "exoskeleton";
  std::string finger = "index";
  int repetitions = 10;
  std::uint64_t seed = 1;
  bool allow_no_realtime = false;
  bool json = false;
};

struct CharacterizeOutcome {
  device::FingerCharacter finger;
  device::FreeSpaceRegression free_space;
};

void stop_if_requested() {
  if (stop_requested()) throw core::Error("characterize: stopped; nothing was kept");
}

int point_named(const std::string& finger) {
  const auto* found =
      std::find(core::kContactPointNames.begin(), core::kContactPointNames.end(), finger);
  if (found != core::kContactPointNames.end()) {
    return static_cast<int>(found - core::kContactPointNames.begin());
  }
  throw UsageError(fmt::format("--finger: expected one of {}, found {}",
                               fmt::join(core::kContactPointNames, ", "), finger));
}

/// Takes the samples of the next `duration_s`.
void measure(DeviceRun& run, double duration_s,
             const std::function<void(const core::Sample&)>& take) {
  // Drops samples from before.
  run.take([](const core::Sample&) {});
  const auto wanted = static_cast<std::int64_t>(duration_s * kRate_hz);
  for (std::int64_t taken = 0; taken < wanted;) {
    stop_if_requested();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (const core::Fault fault = run.telemetry().fault; core::is_failure(fault)) {
      throw core::Error("device: " + std::string(core::words(fault)));
    }
    run.take([&](const core::Sample& sample) {
      if (taken++ < wanted) take(sample);
    });
  }
}

std::unique_ptr<DeviceRun> started(device::HapticDevice& device,
                                   const CharacterizeOptions& options) {
  try {
    return std::make_unique<DeviceRun>(
        device, DeviceRun::Parameters{.rate_hz = kRate_hz,
                                      .allow_no_realtime = options.allow_no_realtime});
  } catch (const core::Error& error) {
    throw EnvironmentError(error.what());
  }
}

CharacterizeOutcome measured_on_model(const CharacterizeOptions& options) {
  ProgressBar bar("characterize");
  const auto part = [&bar](double from, double to) {
    return [&bar, from, to](double done) {
      stop_if_requested();
      bar.show(from + done * (to - from));
    };
  };
  device::SimulatedBench bench({.rate_hz = kRate_hz,
                                .point = point_named(options.finger),
                                .seed = options.seed,
                                .sensor_seed = options.seed});
  device::FingerCharacter finger =
      device::characterize_finger(bench, options.repetitions, part(0.0, 0.9));
  return {std::move(finger),
          device::stroke_in_free_space(kRate_hz, options.seed, part(0.9, 1.0))};
}

CharacterizeOutcome measured_by_person(const CharacterizeOptions& options,
                                       device::HapticDevice& device) {
  const std::unique_ptr<DeviceRun> run = started(device, options);
  const auto measure_on_it = [&run](double duration_s,
                                    const std::function<void(const core::Sample&)>& take) {
    measure(*run, duration_s, take);
  };
  PersonBench bench(std::cin, std::cerr, point_named(options.finger), options.repetitions,
                    measure_on_it);
  CharacterizeOutcome outcome;
  outcome.finger = device::characterize_finger(bench, options.repetitions,
                                               [](double) { stop_if_requested(); });
  if (device::SimulatedHand* hand = device.simulated_hand()) {
    hand->begin_strokes({}, core::RandomStream(options.seed, "stroke"));
  } else {
    bench.wait_for(fmt::format(
        "Put a hand on the device, press Enter and move it to and fro for {:g} s, now slowly, "
        "now fast",
        kStroking_s));
  }
  measure(*run, kStroking_s,
          [&outcome](const core::Sample& sample) { outcome.free_space.add(sample); });
  return outcome;
}

CharacterizeOutcome outcome_of(const CharacterizeOptions& options) {
  if (options.device == "exoskeleton") return measured_on_model(options);
  const auto device = device::make_device(options.device, kRate_hz);
  if (device->capabilities().num_joints != core::kNumJoints) {
    throw EnvironmentError(fmt::format(
        "--device {}: expected a device that tells of its joints, found one that does not; "
        "characterise the exoskeleton, or one across the network",
        options.device));
  }
  return measured_by_person(options, *device);
}

ordered_json json_of(const device::MeanAndSpread& value) {
  return {{"mean", value.mean}, {"sd", value.sd}};
}

ordered_json json_of(const CharacterizeOutcome& outcome, const CharacterizeOptions& options) {
  auto poses = ordered_json::array();
  for (const device::BreakAway& entry : outcome.finger.break_away) {
    poses.push_back({{"pose", device::kFingerPoseNames[static_cast<std::size_t>(entry.pose)]},
                     {"joint", kJoints[static_cast<std::size_t>(joint_of(entry.pose))]},
                     {"force_n", entry.force_n}});
  }
  auto sensors = ordered_json::array();
  for (const device::SensorAccuracy& sensor : outcome.finger.sensors) {
    auto weights = ordered_json::array();
    const auto joint = static_cast<std::size_t>(sensor.joint);
    for (std::size_t i = 0; i < sensor.readings.size(); ++i) {
      weights.push_back({{"weight_kg", outcome.finger.weight_kg[i]},
                         {"measured_n_m", sensor.readings[i].measured_n_m[joint]},
                         {"expected_n_m", sensor.readings[i].expected_n_m[joint]}});
    }
    sensors.push_back({{"joint", kJoints[joint]},
                       {"mean_relative_error_ratio", sensor.mean_relative_error_ratio},
                       {"weights", std::move(weights)}});
  }
  return {{"device", options.device},
          {"finger", options.finger},
          {"num_repetitions", options.repetitions},
          {"break_away", std::move(poses)},
          {"break_away_extension_n", json_of(outcome.finger.extension_n)},
          {"break_away_abduction_n", json_of(outcome.finger.abduction_n)},
          {"torque_sensors", std::move(sensors)},
          {"free_space",
           {{"viscosity_n_s_per_m", outcome.free_space.viscosity_n_s_per_m()},
            {"friction_n", outcome.free_space.friction_n()},
            {"num_samples", outcome.free_space.num_samples()}}}};
}

void print(const CharacterizeOutcome& outcome, const CharacterizeOptions& options) {
  fmt::print("{}, finger `{}`\n\nForce at the tip that moves it, {} times each\n",
             options.device, options.finger, options.repetitions);
  for (const device::BreakAway& entry : outcome.finger.break_away) {
    const device::MeanAndSpread force_n = device::mean_and_spread(entry.force_n);
    fmt::print("  {:<12} {:<10} {:5.2f} +- {:.2f} N\n",
               device::kFingerPoseNames[static_cast<std::size_t>(entry.pose)],
               kJoints[static_cast<std::size_t>(joint_of(entry.pose))], force_n.mean,
               force_n.sd);
  }
  fmt::print("  {:<23} {:5.2f} +- {:.2f} N\n  {:<23} {:5.2f} +- {:.2f} N\n", "extension, all",
             outcome.finger.extension_n.mean, outcome.finger.extension_n.sd, "abduction, all",
             outcome.finger.abduction_n.mean, outcome.finger.abduction_n.sd);
  fmt::print(
      "\nTorque sensors with weights of {:.0f} to {:.0f} g, mean error without the first\n",
      1e3 * outcome.finger.weight_kg.front(), 1e3 * outcome.finger.weight_kg.back());
  for (const device::SensorAccuracy& sensor : outcome.finger.sensors) {
    fmt::print("  {:<23} {:5.2f} %\n", kJoints[static_cast<std::size_t>(sensor.joint)],
               100.0 * sensor.mean_relative_error_ratio);
  }
  if (outcome.free_space.num_samples() < 2) {
    fmt::print("\nFree space: not measured, for no hand moved with all five points on it\n");
    return;
  }
  fmt::print(
      "\nFree space, from the torque sensors: {:.2f} N s/m, and {:.2f} N at any speed "
      "({} samples)\n",
      outcome.free_space.viscosity_n_s_per_m(), outcome.free_space.friction_n(),
      outcome.free_space.num_samples());
}

int run_characterize(const CharacterizeOptions& options) {
  require_device(options.device);
  (void)point_named(options.finger);
  stop_on_signals();
  const CharacterizeOutcome outcome = outcome_of(options);
  if (options.json) {
    fmt::print("{}\n", json_text(json_of(outcome, options)));
  } else {
    print(outcome, options);
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_characterize() { return {HelpGroup::kApparatus, 80}; }

void add_characterize(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "characterize",
      "Measures friction, torque sensors and free-space viscosity of a device with joints");
  invocation.examples[command] = {
      {"jnd characterize --device exoskeleton",
       "break-away forces, errors of the sensors, viscosity in free space"}};
  const auto options = std::make_shared<CharacterizeOptions>();
  command->add_option("--device", options->device, "exoskeleton, or network:HOST:PORT")
      ->capture_default_str();
  command->add_option("--finger", options->finger, "The one that weights hang on")
      ->capture_default_str();
  command->add_option("--repetitions", options->repetitions, "Of each break-away force")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of everything that is drawn on the model")
      ->check(seed_number())
      ->capture_default_str();
  command->add_flag("--allow-no-realtime", options->allow_no_realtime,
                    "A real device also without real-time priority");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_characterize(*options); };
  });
}

}  // namespace jnd::app
