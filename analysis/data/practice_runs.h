#pragma once

#include "analysis/data/stored_studies.h"
#include "analysis/data/study_data.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// Adds how the practice of each session of each participant ended to `StudyData::practice`.
void add_practice_runs(StudyData& data, const core::StudyStore& store, StoredStudies& studies);

}  // namespace jnd::analysis
