#include "app/commissioning/commissioning.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/commissioning/commissioning_json.h"
#include "core/error.h"
#include "core/storage/files.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

std::string now_text() {
  const std::time_t now =
      std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  (void)gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  (void)std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

/// The beginning of a JSON document that has no end.
bool is_torn(const std::string& line) {
  try {
    [[maybe_unused]] const json whole = json::parse(line);
  } catch (const json::parse_error& error) {
    return error.byte > line.size();
  } catch (const json::exception&) {
    return false;
  }
  return false;
}

bool ends_a_line(const fs::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in || in.tellg() == std::streampos(0)) return true;
  in.seekg(-1, std::ios::end);
  return in.get() == '\n';
}

std::string& measured_at(CommissioningResults& results, CommissioningStep step) {
  return results.measured_at[static_cast<std::size_t>(step)];
}

/// What rests on a step that is measured anew, or taken back.
void forget_after(CommissioningResults& results, CommissioningStep changed) {
  for (const CommissioningStep step : kCommissioningSteps) {
    for (const CommissioningStep before : steps_before(step)) {
      if (before == changed) measured_at(results, step).clear();
    }
  }
}

}  // namespace

Commissioning::Commissioning(fs::path record, CommissionedDevice device, MeasuringPlan plan)
    : record_(std::move(record)), device_(std::move(device)), plan_(std::move(plan)) {
  if (fs::exists(record_)) {
    read_record();
    return;
  }
  append(ordered_json({{"commissioning", 1},
                       {"device", device_.name},
                       {"model", device_.identity.model},
                       {"serial", device_.identity.serial},
                       {"firmware", device_.identity.firmware},
                       {"simulated", device_.can.simulated},
                       {"begun_at", now_text()}})
             .dump());
}

void Commissioning::read_record() {
  std::ifstream in(record_);
  std::string line;
  int number = 0;
  try {
    while (std::getline(in, line)) {
      ++number;
      // Of a program that died in the middle of it; whoever went on began another line.
      if (is_torn(line)) continue;
      const json entry = json::parse(line);
      if (number == 1) {
        const std::string model = entry.at("model").get<std::string>();
        const std::string serial = entry.at("serial").get<std::string>();
        if (model != device_.identity.model || serial != device_.identity.serial) {
          throw core::Error(fmt::format(
              "{}: expected the record of {} with serial \"{}\", found that of {} with serial "
              "\"{}\"; give another file by --record",
              record_.string(), device_.identity.model, device_.identity.serial, model,
              serial));
        }
        continue;
      }
      if (entry.contains("failed")) continue;
      const std::string name = entry.value("undone", entry.value("step", std::string()));
      const std::optional<CommissioningStep> step = step_named(name);
      if (!step) throw core::Error("a step called \"" + name + "\"");
      measured_at(results_, *step).clear();
      forget_after(results_, *step);
      if (entry.contains("undone")) continue;
      read_step_json(*step, entry.at("found"), results_);
      measured_at(results_, *step) = entry.at("at").get<std::string>();
    }
  } catch (const json::exception& error) {
    throw core::Error(fmt::format("{}:{}: expected a line of a commissioning, found {}",
                                  record_.string(), number, error.what()));
  }
}

void Commissioning::append(const std::string& line) {
  if (!fs::exists(record_)) {
    core::make_private_file(record_);
    core::sync_folder(record_.has_parent_path() ? record_.parent_path() : fs::path("."));
  }
  const int file = ::open(record_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  const std::string whole = (ends_a_line(record_) ? "" : "\n") + line + "\n";
  // One write, so that a line is there or not.
  const bool is_kept =
      file >= 0 &&
      ::write(file, whole.data(), whole.size()) == static_cast<ssize_t>(whole.size()) &&
      ::fsync(file) == 0;
  const int problem = errno;
  if (file >= 0) ::close(file);
  if (!is_kept) {
    throw core::Error(fmt::format("{}: expected to keep what was measured, found: {}",
                                  record_.string(), std::strerror(problem)));
  }
}

void Commissioning::measure(CommissioningStep step, device::HapticDevice& device,
                            device::Bench& bench, const StepProgress& progress) {
  for (const CommissioningStep before : steps_before(step)) {
    if (!results_.has(before)) {
      throw core::Error(
          fmt::format("{}: expected the step {} to be measured before, found that it "
                      "is not",
                      words_of(step).name, words_of(before).name));
    }
  }
  CommissioningResults measured = results_;
  try {
    switch (step) {
      case CommissioningStep::kNoise:
        measured.noise = measure_noise(device, bench, plan_, progress);
        break;
      case CommissioningStep::kFrame:
        measured.frame = measure_frame(device, bench, plan_, progress);
        break;
      case CommissioningStep::kDelay:
        measured.delay = measure_delay(device, bench, plan_, *results_.force, progress);
        break;
      case CommissioningStep::kForce:
        measured.force = measure_force(device, bench, plan_, *results_.frame, progress);
        break;
      case CommissioningStep::kStability:
        measured.stability = measure_stability(device, bench, plan_, *results_.noise,
                                               *results_.force, *results_.delay, progress);
        break;
    }
  } catch (const core::Error& error) {
    append(ordered_json(
               {{"failed", words_of(step).name}, {"at", now_text()}, {"why", error.what()}})
               .dump());
    throw;
  }
  const std::string at = now_text();
  append(ordered_json(
             {{"step", words_of(step).name}, {"at", at}, {"found", step_json(step, measured)}})
             .dump());
  results_ = std::move(measured);
  forget_after(results_, step);
  measured_at(results_, step) = at;
}

void Commissioning::undo(CommissioningStep step) {
  if (!results_.has(step)) return;
  append(ordered_json({{"undone", words_of(step).name}, {"at", now_text()}}).dump());
  measured_at(results_, step).clear();
  forget_after(results_, step);
}

std::optional<CommissioningStep> Commissioning::next_step() const noexcept {
  for (const CommissioningStep step : kCommissioningSteps) {
    if (!results_.has(step)) return step;
  }
  return std::nullopt;
}

}  // namespace jnd::app
