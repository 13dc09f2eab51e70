#include "app/commissioning/commissioning_record.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commissioning/commissioning_json.h"
#include "core/error.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// True for the beginning of a JSON document whose end is missing.
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

/// Goes through the lines and finds out which of them count.
class RecordReplay {
 public:
  void begin(const json& entry) {
    record_.device = entry.value("device", std::string());
    record_.identity = {.model = entry.at("model").get<std::string>(),
                        .serial = entry.at("serial").get<std::string>(),
                        .firmware = entry.value("firmware", std::string())};
    record_.simulated = entry.value("simulated", false);
    record_.begun_at = entry.value("begun_at", std::string());
  }

  void take(const json& entry, int line) {
    RecordedEntry& told = record_.entries.emplace_back();
    told.line = line;
    told.at = entry.value("at", std::string());
    if (entry.contains("conditions")) {
      told.operator_name = entry.at("conditions").value("operator_name", std::string());
    }
    if (entry.contains("failed")) {
      told.step = entry.at("failed").get<std::string>();
      told.fate = RecordedFate::kFailed;
      told.why = entry.value("why", std::string());
      return;
    }
    const bool takes_back = entry.contains("undone");
    told.step =
        takes_back ? entry.at("undone").get<std::string>() : entry.value("step", std::string());
    if (takes_back) told.fate = RecordedFate::kTakesBack;
    const std::optional<CommissioningStep> step = step_named(told.step);
    if (!step) return;
    end_of(*step, takes_back ? RecordedFate::kUndone : RecordedFate::kSuperseded);
    if (!takes_back) measure(*step, entry);
  }

  [[nodiscard]] CommissioningRecord record() && { return std::move(record_); }

 private:
  /// The measurement that counted so far no longer counts, nor does anything that rests on it.
  void end_of(CommissioningStep step, RecordedFate fate) {
    record_.results.measured_at[static_cast<std::size_t>(step)].clear();
    forget_after(record_.results, step);
    for (const CommissioningStep one : kCommissioningSteps) {
      auto& place = counts_[static_cast<std::size_t>(one)];
      if (!place || record_.results.has(one)) continue;
      record_.entries[*place].fate = one == step ? fate : RecordedFate::kRestsOnOld;
      place.reset();
    }
  }

  void measure(CommissioningStep step, const json& entry) {
    const auto place = static_cast<std::size_t>(step);
    CommissioningResults& results = record_.results;
    read_step_json(step, entry.at("found"), results);
    // Records of older programs contain no points.
    if (entry.contains("points")) read_points_json(step, entry.at("points"), results);
    results.conditions[place].reset();
    if (entry.contains("conditions")) {
      results.conditions[place] = conditions_in(entry.at("conditions"));
    }
    results.measured_at[place] = entry.at("at").get<std::string>();
    counts_[place] = record_.entries.size() - 1;
    record_.entries.back().found = found_in(step, results);
  }

  CommissioningRecord record_;
  std::array<std::optional<std::size_t>, kCommissioningSteps.size()> counts_;
};

}  // namespace

CommissioningRecord read_commissioning_record(const fs::path& file) {
  std::ifstream in(file);
  if (!in) {
    throw core::Error(file.string() + ": expected the record of a commissioning, found none");
  }
  RecordReplay replay;
  std::string line;
  int number = 0;
  try {
    while (std::getline(in, line)) {
      ++number;
      // The program died while it wrote this line; whoever continued began a new line.
      if (is_torn(line)) continue;
      const json entry = json::parse(line);
      if (number == 1) {
        replay.begin(entry);
      } else {
        replay.take(entry, number);
      }
    }
  } catch (const json::exception& error) {
    throw core::Error(fmt::format("{}:{}: expected a line of a commissioning, found {}",
                                  file.string(), number, error.what()));
  }
  if (number == 0) {
    throw core::Error(file.string() +
                      ": expected the record of a commissioning, found an empty file");
  }
  return std::move(replay).record();
}

void forget_after(CommissioningResults& results, CommissioningStep changed) {
  for (const CommissioningStep step : kCommissioningSteps) {
    for (const CommissioningStep before : steps_before(step)) {
      if (before == changed) results.measured_at[static_cast<std::size_t>(step)].clear();
    }
  }
}

}  // namespace jnd::app
