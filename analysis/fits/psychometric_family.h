#pragma once

#include <optional>
#include <string_view>

#include "analysis/fits/sigmoid.h"

namespace jnd::analysis {

enum class PsychometricFamily {
  kWeber,    ///< Phi(ln(x / pse) / ln(1 + w))
  kGauss,    ///< Phi((x - mean) / standard_deviation)
  kWeibull,  ///< 1 - exp(-(x / scale)^shape)
};

/// The meaning of a Weber fraction for every family. It refers to the sigmoid without its
/// lapses.
inline constexpr std::string_view kWeberFractionMeaning =
    "(x84.13 - pse) / pse, where the curve, lapses aside, is 50 % at the pse and "
    "Phi(1) = 84.13 % at x84.13";

/// The meaning of a Weber fraction if guesses are right at this rate.
[[nodiscard]] constexpr std::string_view weber_fraction_meaning(double guess_rate) noexcept {
  return guess_rate > 0.0
             ? "(x84.13 - pse) / pse, where the curve, guesses and lapses aside, is "
               "50 % at the pse and Phi(1) = 84.13 % at x84.13"
             : kWeberFractionMeaning;
}

/// A family: a sigmoid over the intensity or its logarithm.
struct PsychometricFamilyTraits {
  PsychometricFamily family;
  std::string_view name;
  std::string_view formula;
  Sigmoid sigmoid;
  bool logarithmic;
  /// Whether the pse is always free because no curve of the family is tied to a reference.
  bool always_free_pse;
};

[[nodiscard]] const PsychometricFamilyTraits& traits_of(PsychometricFamily family) noexcept;

/// The names are "weber", "gauss" and "weibull".
[[nodiscard]] std::optional<PsychometricFamily> psychometric_family_named(
    std::string_view name) noexcept;

}  // namespace jnd::analysis
