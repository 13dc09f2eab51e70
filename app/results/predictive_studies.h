#pragma once

#include <functional>
#include <optional>
#include <string>

#include "analysis/results/predictive_people.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// Simulated people for predictive distributions, as asked for.
struct PredictiveRequest {
  const experiments::Study& study;
  const experiments::Laboratory& laboratory;
  std::string device = "lumped";
  int num_people = 0;  ///< At least `kFewestPredictivePeople`.
  /// The seed of everybody; `jnd simulate` has other people.
  std::uint64_t seed = 1;
  int jobs = 1;
  /// Called with 0 to 1 from several threads; may be empty.
  std::function<void(double)> on_progress;
  std::function<bool()> is_cancelled;  ///< If it returns true, `Error` is thrown; may be empty.
};

/// The least number makes two groups of 26, twice as many as a study of 13 people has. The
/// usual number makes five groups of 52, four times as many.
inline constexpr int kFewestPredictivePeople = 52;
inline constexpr int kUsualPredictivePeople = 260;

/// Simulates whole sessions in closed loop, and keeps only their strokes, as `--fast` does; it
/// takes a second a person or less. The people form groups of 52, but at least two groups. Each
/// person depends only on study, laboratory, device, seed and their place. Not real time.
[[nodiscard]] analysis::PredictivePeople simulate_people(const PredictiveRequest& request);

/// The simulated people that the program ships for this study, laboratory and device; none if
/// it ships none.
[[nodiscard]] std::optional<analysis::PredictivePeople> shipped_people(
    const analysis::PredictiveKey& key);

/// The name of the file with these people, such as "thesis-viscosity_discrimination.json".
[[nodiscard]] std::string predictive_file_name(const analysis::PredictiveKey& key);

}  // namespace jnd::app
