#pragma once

#include <string>

#include "analysis/data/study_data.h"
#include "analysis/results/deviation.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// How the results at hand were computed, where that is a choice.
struct AnalysisChoices {
  bool delivered = false;     ///< Of delivered intensities.
  bool inverted_out = false;  ///< Without those who answer the wrong way round.
  bool with_pilots = false;   ///< Pilot sessions among the others.
  std::string compared;       ///< Blocks that were asked for with --compare; "" none.
};

/// The study beside what it registered before: nothing where it registered nothing. Looks at
/// the study file of every session, the number of complete sessions (where looks ended the
/// study, of those they rest on), results that were unsealed before that, sessions from before
/// the registration, sessions that were not finished or are of people who took part before,
/// trials that were set aside, withdrawals, the device, the version of the program, when the
/// study was unblinded, and at `choices`. Throws `Error` where what is kept is no
/// preregistration.
[[nodiscard]] analysis::PreregisteredStudy preregistered_study(
    const core::StudyStore& store, const analysis::StudyData& data,
    const AnalysisChoices& choices = {});

}  // namespace jnd::app
