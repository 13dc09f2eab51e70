#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/charts/figure_source.h"
#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// The answers of a block of magnitudes, as figures show them. Estimation gives magnitudes
/// (ratios to the modulus) at intensities. Production gives intensities at the requested
/// magnitudes.
struct MagnitudeData {
  struct Own {
    std::string participant;
    /// The values by repetition. Only estimation has them, because there each repetition has
    /// every intensity once.
    std::map<std::int64_t, std::map<double, double>> repetitions;
    std::map<double, std::vector<double>> values;  ///< Every answer at each x.
    [[nodiscard]] std::map<double, double> means() const;
  };
  std::string block, title, quantity;
  bool is_production = false;
  std::vector<Own> participants;  ///< The participants who answered.

  /// At each x, the means of the participants who have one there.
  [[nodiscard]] std::map<double, std::vector<std::pair<std::string, double>>> by_x() const;
};

[[nodiscard]] MagnitudeData magnitude_data(const FigureSource& source,
                                           const BlockDesign& block);

/// Each participant's mean at each x, in the columns series, participant, intensity and
/// magnitude. The columns low and high lie one standard deviation of this person's answers
/// away.
[[nodiscard]] FigureTable own_means_table(const MagnitudeData& data);
/// The mean between participants, in the columns intensity and magnitude. The columns low and
/// high lie one standard deviation of the answers away; num_participants is the number of
/// participants.
[[nodiscard]] FigureTable group_means_table(const MagnitudeData& data);

}  // namespace jnd::analysis
