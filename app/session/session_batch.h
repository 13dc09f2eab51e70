#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/storage/study_store.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// Runs the sessions that were added, up to `jobs` at once.
struct Batch {
  const experiments::Study& study;
  const experiments::Laboratory& laboratory;
  core::StudyStore& store;
  std::vector<std::int64_t> sessions;
  int jobs = 1;
  /// Called with 0 to 1 from several threads; may be empty.
  std::function<void(double)> on_progress;
  /// If it returns true, sessions are left open; may be empty.
  std::function<bool()> is_cancelled;
};
/// Throws the first error of any session after the others have ended. Returns the simulated
/// ticks of all sessions.
std::int64_t run_batch(const Batch& batch);

}  // namespace jnd::app
