#pragma once

#include <string>

#include "analysis/data/study_data.h"
#include "analysis/results/deviation.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// How the present results were computed, where that is a choice.
struct AnalysisChoices {
  bool delivered = false;  ///< They are about delivered intensities.
  /// They leave out people who answer the wrong way round.
  bool inverted_out = false;
  bool with_pilots = false;  ///< Pilot sessions are included.
  /// Blocks that were asked for by --compare; "" for none.
  std::string compared;
};

/// Compares the study with its preregistration; the result is empty if it registered nothing.
/// It looks at the study file of every session, the number of complete sessions (if looks ended
/// the study, of those that the looks used), results that were unsealed before that, sessions
/// from before the registration, sessions that were not finished or belong to people who took
/// part before, trials that were set aside, withdrawals, the device, the version of the
/// program, the time of unblinding, and `choices`. Throws `Error` if the stored text is no
/// preregistration.
[[nodiscard]] analysis::PreregisteredStudy preregistered_study(
    const core::StudyStore& store, const analysis::StudyData& data,
    const AnalysisChoices& choices = {});

}  // namespace jnd::app
