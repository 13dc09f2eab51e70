#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/fits/psychometric_model.h"
#include "analysis/fits/sigmoid.h"

namespace jnd::analysis {

/// The distributions F that give a psychometric function its shape.
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
  std::string_view name;     ///< For example "reversed_gumbel".
  std::string_view formula;  ///< The formula, with {} in place of x or ln x.
  Sigmoid sigmoid;
  double at_location;  ///< The value of F at its location.
};

[[nodiscard]] const std::vector<CurveFamilyTraits>& curve_families();
[[nodiscard]] const CurveFamilyTraits& traits_of(CurveFamily family);

/// For example "1 / (1 + exp(-(ln x - location) / scale))".
[[nodiscard]] std::string formula_words(CurveFamily family, bool log_axis);

/// The model that is fitted: P(yes) = guess + (1 - guess - lapse) S(x). S is F, or 1 - F for a
/// curve that falls. With symmetric lapses it is lapse + (1 - 2 lapse) S without guesses, and
/// guess + lapse + (1 - guess - 2 lapse) F with guesses.
struct CurveModel {
  CurveFamily family = CurveFamily::kNormal;
  /// Whether the curve is one of ln x, for intensities >= 0. The Weibull family always uses the
  /// logarithm as its abscissa, whatever this field says.
  bool log_axis = false;
  double guess_rate = 0.0;  ///< The guess rate if it is not free, in [0, 1).
  double lapse_rate = 0.0;  ///< The lapse rate if it is not free, in [0, 1).
  bool free_guess = false, free_lapse = false;
  /// Symmetric lapses exclude a free guess rate. A falling curve may have them only without
  /// guesses.
  bool symmetric = false;
  bool falling = false;

  [[nodiscard]] bool is_logarithmic() const noexcept {
    return log_axis || family == CurveFamily::kWeibull;
  }
  [[nodiscard]] int num_parameters() const noexcept {
    return 2 + (free_guess ? 1 : 0) + (free_lapse ? 1 : 0);
  }
};

/// The levels in the form that the engine expects. The engine knows only rising curves, so a
/// falling curve becomes a rising curve of "no" with exchanged ends.
[[nodiscard]] PsychometricLevels levels_of(const std::vector<AnswerCount>& rows,
                                           const CurveModel& model);

/// Reduces the levels to at most `most` bins of equal width on the abscissa, each at its
/// levels' mean place. It is meant for searches over many curves. The error is of second order
/// in the width of a bin.
[[nodiscard]] PsychometricLevels binned(const PsychometricLevels& levels, std::size_t most);

/// A number that describes a curve.
struct CurveQuantity {
  enum class Kind {
    kThreshold,  ///< The intensity where F is `level`.
    /// The location in the family's formula; on a logarithmic axis it is a location of ln x.
    kLocation,
    kScale,     ///< The scale in the family's formula.
    kDistance,  ///< The distance in intensity from F = 0.5 to F = `level`, > 0.
    /// The slope of P(yes) by intensity where F is `level`; < 0 for a falling curve.
    kSlope,
    kThresholdOfProportion,  ///< The intensity where P(yes) is `level`.
    kSlopeOfProportion,      ///< The slope of P(yes) by intensity at that place.
    kGuess,
    kLapse,
  };
  Kind kind = Kind::kThreshold;
  double level = 0.5;  ///< A level of F or of P(yes), in (0, 1).
};

/// The value of F where P(yes) is `proportion`. It lies outside (0, 1) if the curve never
/// reaches that proportion.
[[nodiscard]] double level_of_proportion(const CurveModel& model,
                                         const PsychometricLevels& levels,
                                         const PsychometricCurve& curve, double proportion);

/// The value of a quantity. It is infinite or NaN where the curve has left the range of
/// numbers. If a curve never reaches a proportion, the threshold is infinite, on the side of
/// the end that is too low or too high.
[[nodiscard]] double value_of(const CurveQuantity& quantity, const CurveModel& model,
                              const PsychometricLevels& levels, const PsychometricCurve& curve);

/// The guess and lapse rate of the model. The engine's curve may have them exchanged.
struct CurveRates {
  double guess = 0.0, lapse = 0.0;
};
[[nodiscard]] CurveRates rates_of(const CurveModel& model, const PsychometricLevels& levels,
                                  const PsychometricCurve& curve);

}  // namespace jnd::analysis
