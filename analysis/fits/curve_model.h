#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/fits/psychometric_model.h"
#include "analysis/fits/sigmoid.h"

namespace jnd::analysis {

/// The distributions F that a psychometric function rises by.
enum class CurveFamily {
  kNormal,
  kLogistic,
  kWeibull,
  kGumbel,
  kReversedGumbel,
  kHyperbolicSecant,
};

struct CurveFamilyTraits {
  CurveFamily family;
  std::string_view name;     ///< "reversed_gumbel"
  std::string_view formula;  ///< With {} for x or ln x.
  Sigmoid sigmoid;
  double at_location;  ///< F at its location.
};

[[nodiscard]] const std::vector<CurveFamilyTraits>& curve_families();
[[nodiscard]] const CurveFamilyTraits& traits_of(CurveFamily family);

/// "1 / (1 + exp(-(ln x - location) / scale))"
[[nodiscard]] std::string formula_words(CurveFamily family, bool log_axis);

/// What is fitted: P(yes) = guess + (1 - guess - lapse) S(x), S being F, or 1 - F for a curve
/// that falls; with symmetric lapses lapse + (1 - 2 lapse) S without guesses, and guess + lapse
/// + (1 - guess - 2 lapse) F with them.
struct CurveModel {
  CurveFamily family = CurveFamily::kNormal;
  /// Over ln x, for intensities >= 0. Weibull's distribution is one of x, whose logarithm is
  /// the abscissa, whatever this says.
  bool log_axis = false;
  double guess_rate = 0.0;  ///< [0, 1), where it is not free.
  double lapse_rate = 0.0;  ///< The same.
  bool free_guess = false, free_lapse = false;
  bool symmetric = false;  ///< Not with a free guess rate; falling only without guesses.
  bool falling = false;

  [[nodiscard]] bool is_logarithmic() const noexcept {
    return log_axis || family == CurveFamily::kWeibull;
  }
  [[nodiscard]] int num_parameters() const noexcept {
    return 2 + (free_guess ? 1 : 0) + (free_lapse ? 1 : 0);
  }
};

/// The levels as the engine takes them, which knows rising curves alone: a curve that falls is
/// one of "no" that rises, between ends that have changed places.
[[nodiscard]] PsychometricLevels levels_of(const std::vector<AnswerCount>& rows,
                                           const CurveModel& model);

/// At most so many levels, each of neighbours within one step of the abscissa at their mean
/// place: for what is searched over many curves. What that changes is of second order in the
/// step.
[[nodiscard]] PsychometricLevels binned(const PsychometricLevels& levels, std::size_t most);

/// A number that a curve has.
struct CurveQuantity {
  enum class Kind {
    kThreshold,  ///< Intensity where F is `level`.
    kLocation,   ///< As the family's formula has it: that of ln x on a logarithmic axis.
    kScale,      ///< As the family's formula has it.
    kDistance,   ///< In intensity, from F = 0.5 to F = `level`, > 0.
    kSlope,      ///< Of P(yes) by intensity where F is `level`; < 0 of a curve that falls.
    kThresholdOfProportion,  ///< Intensity where P(yes) is `level`.
    kSlopeOfProportion,      ///< Of P(yes) by intensity there.
    kGuess,
    kLapse,
  };
  Kind kind = Kind::kThreshold;
  double level = 0.5;  ///< Of F, or P(yes), in (0, 1).
};

/// F where P(yes) is `proportion`; not within (0, 1) where the curve never has that.
[[nodiscard]] double level_of_proportion(const CurveModel& model,
                                         const PsychometricLevels& levels,
                                         const PsychometricCurve& curve, double proportion);

/// Its value; infinite or NaN where the curve has left the range of numbers. Where a curve
/// never has a proportion its threshold is beyond all intensities, on the side of that end.
[[nodiscard]] double value_of(const CurveQuantity& quantity, const CurveModel& model,
                              const PsychometricLevels& levels, const PsychometricCurve& curve);

/// The guess and lapse rate of the model, which the engine's curve may have exchanged.
struct CurveRates {
  double guess = 0.0, lapse = 0.0;
};
[[nodiscard]] CurveRates rates_of(const CurveModel& model, const PsychometricLevels& levels,
                                  const PsychometricCurve& curve);

}  // namespace jnd::analysis
