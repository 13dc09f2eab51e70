#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// Presentations of one kind: how many there were, and how many hold a whole stroke, on which
/// alone width and speed rest. Strokes too slow to be finished are missing, so what is left is
/// a selection wherever many are.
struct PresentationUse {
  std::string block, interval;
  std::optional<double> intensity;  ///< Absent where people set it themselves.
  int num_presented = 0, num_used = 0;
  int num_participants = 0;  ///< With at least one that is used.
  /// Means over the presentations that are used.
  std::optional<double> stroke_width_m, max_speed_m_per_s;

  [[nodiscard]] double missing_ratio() const noexcept {
    return num_presented == 0 ? 0.0 : 1.0 - static_cast<double>(num_used) / num_presented;
  }
};

/// By block, interval and level; free space between stimuli is left out. Not real time.
[[nodiscard]] std::vector<PresentationUse> presentation_uses(const StudyData& data);

/// Whether width and speed of this presentation are used.
[[nodiscard]] bool is_used(const core::PresentationRow& row);

}  // namespace jnd::analysis
