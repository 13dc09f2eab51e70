#include "app/session/session_batch.h"

#include <atomic>

#include "app/session/laboratory_run.h"
#include "core/parallel.h"

namespace jnd::app {

std::int64_t run_batch(const Batch& batch) {
  std::vector<std::atomic<double>> progress(batch.sessions.size());
  std::atomic<std::int64_t> num_ticks{0};
  const auto report = [&] {
    if (!batch.on_progress) return;
    double sum = 0.0;
    for (const std::atomic<double>& one : progress) sum += one.load(std::memory_order_relaxed);
    batch.on_progress(sum / static_cast<double>(progress.size()));
  };
  core::for_each_index(batch.sessions.size(), batch.jobs, [&](std::size_t i) {
    if (batch.is_cancelled && batch.is_cancelled()) return;
    const LaboratoryRunResult result =
        run_laboratory({.study = batch.study,
                        .laboratory = batch.laboratory,
                        .store = batch.store,
                        .session = batch.sessions[i],
                        .durability = core::Durability::kAtClose,
                        .on_progress =
                            [&, i](double done) {
                              progress[i].store(done, std::memory_order_relaxed);
                              report();
                            },
                        .is_cancelled = batch.is_cancelled});
    progress[i].store(1.0);
    num_ticks += result.num_ticks;
  });
  return num_ticks;
}

}  // namespace jnd::app
