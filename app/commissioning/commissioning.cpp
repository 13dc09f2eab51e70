#include "app/commissioning/commissioning.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/commissioning/commissioning_json.h"
#include "app/commissioning/commissioning_record.h"
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

bool ends_a_line(const fs::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in || in.tellg() == std::streampos(0)) return true;
  in.seekg(-1, std::ios::end);
  return in.get() == '\n';
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
  CommissioningRecord record = read_commissioning_record(record_);
  const device::DeviceIdentity& is = record.identity;
  if (is.model != device_.identity.model || is.serial != device_.identity.serial) {
    throw core::Error(fmt::format(
        "{}: expected the record of {} with serial \"{}\", found that of {} with serial "
        "\"{}\"; give another file by --record",
        record_.string(), device_.identity.model, device_.identity.serial, is.model,
        is.serial));
  }
  for (const RecordedEntry& entry : record.entries) {
    if (!step_named(entry.step)) {
      throw core::Error(
          fmt::format("{}:{}: expected a step that this program knows, found one called \"{}\"",
                      record_.string(), entry.line, entry.step));
    }
  }
  results_ = std::move(record.results);
}

fs::path usual_record(std::string_view device) {
  std::string name;
  for (const char letter : device) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    name += is_plain ? letter : '_';
  }
  return name + ".commissioning.jsonl";
}

void Commissioning::append(const std::string& line) {
  if (!fs::exists(record_)) {
    core::make_private_file(record_);
    core::sync_folder(record_.has_parent_path() ? record_.parent_path() : fs::path("."));
  }
  const int file = ::open(record_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  const std::string whole = (ends_a_line(record_) ? "" : "\n") + line + "\n";
  // A single write makes the line either complete or absent.
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
      case CommissioningStep::kHoming:
        measured.homing = measure_homing(device, bench, plan_, progress);
        break;
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
    append(ordered_json({{"failed", words_of(step).name},
                         {"at", now_text()},
                         {"why", error.what()},
                         {"conditions", conditions_json(plan_)}})
               .dump());
    throw;
  }
  const std::string at = now_text();
  append(ordered_json({{"step", words_of(step).name},
                       {"at", at},
                       {"conditions", conditions_json(plan_)},
                       {"found", step_json(step, measured)},
                       {"points", points_json(step, measured)}})
             .dump());
  results_ = std::move(measured);
  forget_after(results_, step);
  const auto place = static_cast<std::size_t>(step);
  results_.measured_at[place] = at;
  results_.conditions[place] = conditions_in(conditions_json(plan_));
}

void Commissioning::undo(CommissioningStep step) {
  if (!results_.has(step)) return;
  append(ordered_json({{"undone", words_of(step).name}, {"at", now_text()}}).dump());
  results_.measured_at[static_cast<std::size_t>(step)].clear();
  forget_after(results_, step);
}

std::optional<CommissioningStep> Commissioning::next_step() const noexcept {
  for (const CommissioningStep step : kCommissioningSteps) {
    if (!results_.has(step)) return step;
  }
  return std::nullopt;
}

}  // namespace jnd::app
