#pragma once

#include <optional>
#include <string>

#include "analysis/data/study_data.h"
#include "analysis/results/predictive_people.h"
#include "core/storage/study_store.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// `--predictive [N]` of commands that compare with published values.
struct PredictiveOption {
  std::string num_people;  ///< As typed; "" without the option.
  int jobs = 2;
  std::string keep_folder;  ///< Where the simulated people are kept; "": nowhere.

  [[nodiscard]] bool is_given() const { return !num_people.empty(); }
};
void add_predictive_option(CLI::App& command, PredictiveOption& option);

/// Throws `UsageError` for a number of people that is none, so that a command can refuse it
/// before it begins.
void require_number_of_people(const PredictiveOption& option);

/// The people that the option asks for, of the study and the laboratory that the folder's
/// sessions had, with a progress bar; nothing without the option. Throws `UsageError` for a
/// number that is none, for a study that nothing is published of, and for one that was not
/// simulated.
[[nodiscard]] std::optional<analysis::PredictivePeople> people_asked_for(
    const PredictiveOption& option, const core::StudyStore& store,
    const analysis::StudyData& data);

}  // namespace jnd::app
