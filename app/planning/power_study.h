#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/planning/power_run.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// The request for simulated studies by which a study is planned.
struct PowerRequest {
  std::vector<int> sizes;     ///< Numbers of participants, ascending, each >= 1.
  std::int64_t num_runs = 0;  ///< At least 1.
  std::uint64_t seed = 1;
  /// The names of two blocks to compare; without them, the first two blocks that can be
  /// compared, if any.
  std::optional<std::pair<std::string, std::string>> compare;
  bool free_pse = true;
  bool hierarchical = false;
  bool null_hypothesis = false;  ///< Simulates a laboratory in which both blocks are alike.
};

/// The expected duration of a study of some size, by its plan.
struct PlannedDuration {
  double mean_s = 0.0;   ///< The mean duration of a participant's session.
  double total_s = 0.0;  ///< The sum of all participants' durations.
};

/// Everything that says what the runs are about, so that shards of one study recognise each
/// other.
struct PowerDesign {
  std::string study, study_sha256;
  std::string laboratory, laboratory_sha256;
  std::string program_version;
  PowerRequest request;  ///< With `compare` as it was chosen.
  analysis::PlannedAnalysis analysis;
  std::vector<PlannedDuration> durations;  ///< One for each of `request.sizes`.
  /// Blocks that count for durations only, such as "threshold (staircase, yes_no)".
  std::vector<std::string> left_out;
};

/// The part of one of N machines: the runs i, counted from 0, with i % count == index.
struct PowerShard {
  int index = 0, count = 1;

  [[nodiscard]] std::vector<std::int64_t> runs_of(std::int64_t num_runs) const;
};

/// Simulates studies without a device. Run i is the study that `jnd simulate` would store with
/// `run_seed(seed, i)`, except for what `AnswerSimulator` leaves out; a study of N people is
/// its first N. So a run depends only on the study, the laboratory, the seed and i.
class PowerStudy {
 public:
  /// Both must outlive this object. Throws `UsageError` for a study without blocks to plan for,
  /// and for blocks that cannot be compared.
  PowerStudy(const experiments::Study& study, const experiments::Laboratory& laboratory,
             const PowerRequest& request);

  [[nodiscard]] const PowerDesign& design() const noexcept { return design_; }

  struct Work {
    PowerShard shard;
    int jobs = 1;
    /// Called with 0 to 1 from any of the jobs; may be empty.
    std::function<void(double)> on_progress;
    /// If it returns true, `Error` is thrown; may be empty.
    std::function<bool()> is_cancelled;
  };
  /// Returns the shard's runs in the order of their numbers, whatever the number of jobs.
  [[nodiscard]] std::vector<analysis::PlannedRun> run(const Work& work) const;

 private:
  const experiments::Study& study_;
  /// The laboratory of the null hypothesis, if that was asked for.
  experiments::Laboratory laboratory_;
  PowerDesign design_;
};

/// The seed of the study for run i.
[[nodiscard]] std::uint64_t run_seed(std::uint64_t seed, std::int64_t run);

}  // namespace jnd::app
