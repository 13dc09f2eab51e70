#pragma once

#include "analysis/data/study_data.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// A study as `analysis::load_study` reads it, with what the rules of its adaptive blocks make
/// of the answers (`runs`, `practice`): rules are in the study file, which analysis cannot
/// read.
[[nodiscard]] analysis::StudyData load_study_data(const core::StudyStore& store,
                                                  bool with_pilots = false);

}  // namespace jnd::app
