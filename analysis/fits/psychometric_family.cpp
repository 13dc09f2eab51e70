#include "analysis/fits/psychometric_family.h"

#include <array>

namespace jnd::analysis {
namespace {

constexpr std::array<PsychometricFamilyTraits, 3> kFamilies = {{
    {.family = PsychometricFamily::kWeber,
     .name = "weber",
     .formula = "Phi(ln(x / pse) / ln(1 + w))",
     .sigmoid = Sigmoid::kNormal,
     .logarithmic = true,
     .always_free_pse = false},
    {.family = PsychometricFamily::kGauss,
     .name = "gauss",
     .formula = "Phi((x - mean) / standard_deviation)",
     .sigmoid = Sigmoid::kNormal,
     .logarithmic = false,
     .always_free_pse = true},
    {.family = PsychometricFamily::kWeibull,
     .name = "weibull",
     .formula = "1 - exp(-(x / scale)^shape)",
     .sigmoid = Sigmoid::kWeibull,
     .logarithmic = true,
     .always_free_pse = true},
}};

}  // namespace

const PsychometricFamilyTraits& traits_of(PsychometricFamily family) noexcept {
  for (const PsychometricFamilyTraits& traits : kFamilies) {
    if (traits.family == family) return traits;
  }
  return kFamilies[0];
}

std::optional<PsychometricFamily> psychometric_family_named(std::string_view name) noexcept {
  for (const PsychometricFamilyTraits& traits : kFamilies) {
    if (traits.name == name) return traits.family;
  }
  return std::nullopt;
}

}  // namespace jnd::analysis
