#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/session/device_checks.h"
#include "app/session/stability_limits.h"
#include "core/error.h"
#include "core/parallel.h"

namespace jnd::app {
namespace {

struct StabilityOptions {
  std::string device = "exoskeleton";
  std::vector<double> rates_hz = {833.0, 1000.0, 2000.0};
  std::vector<double> delays_s = {0.0, 0.001, 0.002, 0.003};
  int jobs = 2;
  std::string out;
  bool json = false;
};

/// Fills in the rows; a row is the same whichever thread measures it.
void measure(std::vector<StabilityRow>& rows, int jobs) {
  ProgressBar bar("stability");
  std::atomic<std::size_t> num_done{0};
  core::for_each_index(rows.size(), jobs, [&](std::size_t i) {
    rows[i].limits = device::measure_stability(rows[i].measured_case, [] {
      if (!stop_requested()) return;
      throw core::Error("stability: stopped before the map was complete; nothing was kept");
    });
    bar.show(static_cast<double>(++num_done) / static_cast<double>(rows.size()));
  });
}

void print(const StabilityMap& map) {
  fmt::print(
      "Stable up to, on {}. The loop was told that every point is attached, whatever is true: "
      "this\nis what the limiter's knowledge of attachment protects from.\n\n"
      "{:>8} {:>14}  {:<10} {:>18} {:>20}\n",
      map.device, "rate, Hz", "more delay, ms", "contact", "viscosity", "stiffness");
  for (const StabilityRow& row : map.rows) {
    fmt::print("{:>8g} {:>14g}  {:<10} {:>18} {:>20}\n", row.measured_case.rate_hz,
               1e3 * row.measured_case.extra_delay_s,
               device::kContactNames[static_cast<std::size_t>(row.measured_case.contact)],
               words_of(row.limits.viscosity_pa_s, "Pa s"),
               words_of(row.limits.stiffness_n_per_m, "N/m"));
  }
}

void write(const std::string& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text << '\n';
  stream.close();
  if (!stream) {
    throw core::Error(file +
                      ": expected a file that can be written, found that it cannot; "
                      "look at its folder and disk");
  }
}

int run_stability(const StabilityOptions& options) {
  require_device(options.device);
  if (options.device != "exoskeleton") {
    throw UsageError(
        "--device: expected a device whose mechanics are simulated, exoskeleton, "
        "found " +
        options.device);
  }
  StabilityMap map{.device = options.device};
  for (const double rate_hz : options.rates_hz) {
    for (const double delay_s : options.delays_s) {
      for (const device::Contact contact :
           {device::Contact::kAttached, device::Contact::kSlipping,
            device::Contact::kDetached}) {
        map.rows.push_back({.measured_case = {rate_hz, delay_s, contact}});
      }
    }
  }
  stop_on_signals();
  measure(map.rows, options.jobs);
  const std::string document = json_text(to_json(map));
  if (!options.out.empty()) write(options.out, document);
  if (options.json) {
    fmt::print("{}\n", document);
  } else {
    print(map);
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_stability() { return {HelpGroup::kApparatus, 70}; }

void add_stability(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "stability", "Up to which viscosity and stiffness a simulated device is stable");
  invocation.examples[command] = {
      {"jnd stability --device exoskeleton",
       "the thickest fluid and the stiffest plane that stay stable"}};
  const auto options = std::make_shared<StabilityOptions>();
  command->add_option("--device", options->device, "exoskeleton")->capture_default_str();
  command->add_option("--rate-hz", options->rates_hz, "Rates of the loop, R,...")
      ->delimiter(',')
      ->check(number_between(100.0, 10000.0))
      ->capture_default_str();
  command->add_option("--delay-s", options->delays_s, "More delays of the force, S,...")
      ->delimiter(',')
      ->check(number_between(0.0, 0.02))
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Cases at once")
      ->check(whole_number(1, 1024))
      ->capture_default_str();
  command->add_option("--out", options->out, "File that takes the map as JSON");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_stability(*options); };
  });
}

}  // namespace jnd::app
