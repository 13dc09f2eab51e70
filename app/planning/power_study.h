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

/// Simulated studies to plan with, as asked for.
struct PowerRequest {
  std::vector<int> sizes;     ///< Numbers of participants, ascending, >= 1.
  std::int64_t num_runs = 0;  ///< >= 1
  std::uint64_t seed = 1;
  /// Names of two blocks; none: the first two that can be compared, if there are.
  std::optional<std::pair<std::string, std::string>> compare;
  bool free_pse = true;
  bool hierarchical = false;
  bool null_hypothesis = false;  ///< In a laboratory where both blocks are alike.
};

/// Expected length of a study of a size, by the plan.
struct PlannedDuration {
  double mean_s = 0.0;   ///< Mean duration of a participant's session.
  double total_s = 0.0;  ///< Durations of all participants together.
};

/// Everything that says what runs are about, so that shards of one study know each other.
struct PowerDesign {
  std::string study, study_sha256;
  std::string laboratory, laboratory_sha256;
  std::string program_version;
  PowerRequest request;  ///< `compare` as chosen.
  analysis::PlannedAnalysis analysis;
  std::vector<PlannedDuration> durations;  ///< By size.
  /// Blocks that count in durations alone: "threshold (staircase, yes_no)".
  std::vector<std::string> left_out;
};

/// One of N machines' part: the runs i, from 0, with i % count == index.
struct PowerShard {
  int index = 0, count = 1;

  [[nodiscard]] std::vector<std::int64_t> runs_of(std::int64_t num_runs) const;
};

/// Simulated studies without a device. Run i is the study that `jnd simulate` would store with
/// `run_seed(seed, i)`, but for what is left out in `AnswerSimulator`; a study of N people is
/// its first N. So a run depends on nothing but the study, the laboratory, the seed and i.
class PowerStudy {
 public:
  /// Both must outlive it. Throws `UsageError` for a study without blocks or blocks that cannot
  /// be compared.
  PowerStudy(const experiments::Study& study, const experiments::Laboratory& laboratory,
             const PowerRequest& request);

  [[nodiscard]] const PowerDesign& design() const noexcept { return design_; }

  struct Work {
    PowerShard shard;
    int jobs = 1;
    std::function<void(double)> on_progress;  ///< 0 to 1, from any of the jobs; may be empty.
    std::function<bool()> is_cancelled;       ///< Then `Error` is thrown; may be empty.
  };
  /// The shard's runs in the order of their numbers, whatever the number of jobs.
  [[nodiscard]] std::vector<analysis::PlannedRun> run(const Work& work) const;

 private:
  const experiments::Study& study_;
  experiments::Laboratory laboratory_;  ///< That of the null hypothesis, where asked for.
  PowerDesign design_;
};

/// Of a study that stands for run i.
[[nodiscard]] std::uint64_t run_seed(std::uint64_t seed, std::int64_t run);

}  // namespace jnd::app
