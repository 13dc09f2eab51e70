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
  int num_people = 0;      ///< >= `kFewestPredictivePeople`
  std::uint64_t seed = 1;  ///< Of everybody; those of `jnd simulate` are others.
  int jobs = 1;
  std::function<void(double)> on_progress;  ///< 0 to 1, from several threads; may be empty.
  std::function<bool()> is_cancelled;       ///< Then `Error` is thrown; may be empty.
};

/// Two groups of twice as many as a study of 13 has; usually five of four times as many.
inline constexpr int kFewestPredictivePeople = 52;
inline constexpr int kUsualPredictivePeople = 260;

/// Whole sessions in closed loop, whose strokes alone are kept, as `--fast` does: a second a
/// person or less. In groups of 52, at least two. Everybody
/// depends on nothing but study, laboratory, device, seed, and their place. Not real time.
[[nodiscard]] analysis::PredictivePeople simulate_people(const PredictiveRequest& request);

/// Simulated people that are shipped for this study, laboratory and device.
[[nodiscard]] std::optional<analysis::PredictivePeople> shipped_people(
    const analysis::PredictiveKey& key);

/// The name of the file that holds them: "thesis-viscosity_discrimination.json".
[[nodiscard]] std::string predictive_file_name(const analysis::PredictiveKey& key);

}  // namespace jnd::app
