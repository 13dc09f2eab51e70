#pragma once

#include <filesystem>
#include <string>

#include "app/commissioning/commissioning.h"
#include "device/twin/twin_device.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {

/// Begins to commission the twin in a record, or goes on with it.
inline Commissioning begun_with_twin(const std::filesystem::path& record,
                                     device::TwinDevice& twin) {
  return {record,
          {.name = "twin:seed=7", .identity = twin.identity(), .can = twin.capabilities()},
          {.operator_name = "A. Person"}};
}

/// The record of all steps of commissioning the twin that is drawn with seed 7. A process
/// measures it once, because that takes seconds; a test that needs it goes on with a copy.
inline const std::string& record_of_all_steps() {
  static const std::string all = [] {
    const test_support::TemporaryFolder folder;
    const std::filesystem::path record = folder.path() / "twin.commissioning.jsonl";
    device::TwinDevice twin(device::drawn_twin(7));
    Commissioning commissioning = begun_with_twin(record, twin);
    for (const CommissioningStep step : kCommissioningSteps) {
      commissioning.measure(step, twin, *twin.bench(), [](double, const std::string&) {});
    }
    return test_support::read_file(record);
  }();
  return all;
}

}  // namespace jnd::app
