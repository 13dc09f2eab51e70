#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/storage/study_store.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// Runs sessions that were added, up to `jobs` at once, with progress on the terminal.
struct Batch {
  const experiments::Study& study;
  const experiments::Laboratory& laboratory;
  core::StudyStore& store;
  std::vector<std::int64_t> sessions;
  int jobs = 1;
  std::function<void(double)> on_progress;  ///< 0 to 1, from several threads; may be empty.
  std::function<bool()> is_cancelled;       ///< Leaves sessions open; may be empty.
};
/// Throws the first error of any session, after the others have come to an end. Returns the
/// simulated ticks of all.
std::int64_t run_batch(const Batch& batch);

}  // namespace jnd::app
