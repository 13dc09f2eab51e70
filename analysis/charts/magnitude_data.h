#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/charts/figure_source.h"
#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// What a block of magnitudes left, as figures show it. Estimation: magnitudes (ratio to the
/// modulus) at intensities. Production: intensities at magnitudes that were asked for.
struct MagnitudeData {
  struct Own {
    std::string participant;
    /// By repetition; estimation alone, where each repetition has every intensity once.
    std::map<std::int64_t, std::map<double, double>> repetitions;
    std::map<double, std::vector<double>> values;  ///< At each x every answer.
    [[nodiscard]] std::map<double, double> means() const;
  };
  std::string block, title, quantity;
  bool is_production = false;
  std::vector<Own> participants;  ///< Participants who answered.

  /// At each x the means of those participants who have one there.
  [[nodiscard]] std::map<double, std::vector<std::pair<std::string, double>>> by_x() const;
};

[[nodiscard]] MagnitudeData magnitude_data(const FigureSource& source,
                                           const BlockDesign& block);

/// Each participant's mean at each x: columns series, participant, intensity, magnitude, and
/// low and high of what was answered, one standard deviation of this person's answers away.
[[nodiscard]] FigureTable own_means_table(const MagnitudeData& data);
/// Mean and standard deviation between participants: intensity, magnitude, low, high (of what
/// was answered), num_participants.
[[nodiscard]] FigureTable group_means_table(const MagnitudeData& data);

}  // namespace jnd::analysis
