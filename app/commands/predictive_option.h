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

/// The option `--predictive [N]` of commands that compare with published values.
struct PredictiveOption {
  std::string num_people;  ///< As typed; "" without the option.
  int jobs = 2;
  /// The folder that stores the simulated people; "" for none.
  std::string keep_folder;

  [[nodiscard]] bool is_given() const { return !num_people.empty(); }
};
void add_predictive_option(CLI::App& command, PredictiveOption& option);

/// Throws `UsageError` for an invalid number of people, so that a command can refuse it before
/// it begins.
void require_number_of_people(const PredictiveOption& option);

/// The people that the option asks for, simulated with the study and the laboratory of the
/// folder's sessions while a progress bar is shown; none without the option. Throws
/// `UsageError` for an invalid number, for a study about which nothing was published, and for a
/// study that was not simulated.
[[nodiscard]] std::optional<analysis::PredictivePeople> people_asked_for(
    const PredictiveOption& option, const core::StudyStore& store,
    const analysis::StudyData& data);

}  // namespace jnd::app
