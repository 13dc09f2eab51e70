#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// The number of presentations of one kind, and how many of them hold a whole stroke. Only
/// those give width and speed. Strokes that were too slow to be completed are missing, so if
/// many are missing the rest is a selection.
struct PresentationUse {
  std::string block, interval;
  std::optional<double> intensity;  ///< Absent if people set the intensity themselves.
  int num_presented = 0, num_used = 0;
  /// The number of participants with at least one presentation that is used.
  int num_participants = 0;
  /// Means over the presentations that are used.
  std::optional<double> stroke_width_m, max_speed_m_per_s;

  [[nodiscard]] double missing_ratio() const noexcept {
    return num_presented == 0 ? 0.0 : 1.0 - static_cast<double>(num_used) / num_presented;
  }
};

/// The uses by block, interval and level. Free space between stimuli is left out.
/// Not real time.
[[nodiscard]] std::vector<PresentationUse> presentation_uses(const StudyData& data);

/// Whether width and speed of this presentation are used.
[[nodiscard]] bool is_used(const core::PresentationRow& row);

}  // namespace jnd::analysis
