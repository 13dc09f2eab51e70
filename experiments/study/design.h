#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace jnd::experiments {

/// A text in the languages of the study: language code ("en", "de") to words.
using Text = std::map<std::string, std::string>;

/// Something that a study varies on purpose. Within people, its levels are those of blocks.
/// Between people, it has the name of a `one_of` counterbalance or of a participant field.
struct DesignFactor {
  std::string name;                 ///< Unique in the study, and not "block".
  std::vector<std::string> levels;  ///< At least two.
};

/// The factor of every study in which each block is a level.
inline constexpr char kBlockFactor[] = "block";

/// Name of a factor to name of one of its levels.
using Levels = std::map<std::string, std::string>;

/// Correction for multiple tests within the family of a contrast.
enum class Correction { kHolm, kBonferroni, kNone };

/// The expected direction of a contrast, which determines the side of its test.
enum class ContrastDirection { kEither, kGreater, kLess };

/// The measure in which a contrast compares conditions. The effect on an exponent, a rating or
/// the answers to a question is a difference. All other effects are ratios.
enum class ContrastMeasure {
  kWeberFraction,
  kPse,
  kExponent,
  kMagnitude,
  kMatch,
  kRating,
  kQuestion,  ///< One of the questions after the trials of a block.
  kResponseTime
};

/// A comparison of conditions that was planned before anybody took part.
struct PlannedContrast {
  std::string name;
  Text hypothesis;  ///< The expectation in words; may be empty.
  ContrastMeasure measure = ContrastMeasure::kWeberFraction;
  std::string question{};  ///< Name of the question for `kQuestion`; otherwise "".
  /// Factors, their levels and the levels' weights, as in the file.
  std::map<std::string, std::map<std::string, double>> weights;
  bool primary = false;
  ContrastDirection direction = ContrastDirection::kEither;
  /// Smallest effect of interest: a ratio > 1, or a difference > 0.
  std::optional<double> smallest_effect;
  double alpha = 0.05;
  std::string family;  ///< Contrasts of a family are corrected together.
  Correction correction = Correction::kHolm;
};

/// How the alpha of a sequential study is spent over its looks.
enum class AlphaSpending { kObrienFleming, kPocock };

/// When the data of a study are looked at before all have taken part, and what ends the study.
struct SequentialPlan {
  std::string contrast;  ///< Name of the primary contrast that decides.
  std::vector<int>
      looks;  ///< Numbers of complete sessions, ascending; the last one ends the study.
  AlphaSpending spending = AlphaSpending::kObrienFleming;
};

/// Returns the spelling of the study file: "weber_fraction".
[[nodiscard]] std::string to_string(ContrastMeasure measure);
/// Return the spelling of the study file: "holm", "greater", "obrien_fleming".
[[nodiscard]] std::string to_string(Correction correction);
[[nodiscard]] std::string to_string(ContrastDirection direction);
[[nodiscard]] std::string to_string(AlphaSpending spending);
/// Returns words for a sentence: "O'Brien-Fleming".
[[nodiscard]] std::string spending_words(AlphaSpending spending);
/// Returns words for a sentence: "Weber fraction", "answer to the question confidence".
[[nodiscard]] std::string measure_words(const PlannedContrast& plan);
/// Returns all measures in the order of `ContrastMeasure`.
[[nodiscard]] const std::vector<ContrastMeasure>& contrast_measures();
/// Whether an effect is a ratio, which is tested on its logarithm. Otherwise it is a
/// difference.
[[nodiscard]] bool is_ratio(ContrastMeasure measure) noexcept;

}  // namespace jnd::experiments
