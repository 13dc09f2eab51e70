#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace jnd::experiments {

/// A text in the languages of the study: language code ("en", "de") to words.
using Text = std::map<std::string, std::string>;

/// Something that a study varies on purpose. Within people its levels are those of blocks;
/// between people it has the name of a `one_of` counterbalance or of a participant field.
struct DesignFactor {
  std::string name;                 ///< Unique in the study; not "block".
  std::vector<std::string> levels;  ///< At least two.
};

/// The factor that every study has: each block is a level of its own.
inline constexpr char kBlockFactor[] = "block";

/// Name of a factor to name of one of its levels.
using Levels = std::map<std::string, std::string>;

/// Of the family of a contrast.
enum class Correction { kHolm, kBonferroni, kNone };

/// What a contrast is expected to be; which of its sides a test looks at.
enum class ContrastDirection { kEither, kGreater, kLess };

/// What a contrast compares conditions in. Of an exponent, a rating and the answers to a
/// question the effect is a difference, of all others a ratio.
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
  Text hypothesis;  ///< What is expected, in words; may be empty.
  ContrastMeasure measure = ContrastMeasure::kWeberFraction;
  std::string question{};  ///< Of `kQuestion`: name of the question; else "".
  /// Factor to its levels to their weights, as written.
  std::map<std::string, std::map<std::string, double>> weights;
  bool primary = false;
  ContrastDirection direction = ContrastDirection::kEither;
  /// Smallest effect of interest: a ratio > 1 or, where the effect is one, a difference > 0.
  std::optional<double> smallest_effect;
  double alpha = 0.05;
  std::string family;  ///< Contrasts that are adjusted together.
  Correction correction = Correction::kHolm;
};

/// How the alpha of a sequential study is spent over its looks.
enum class AlphaSpending { kObrienFleming, kPocock };

/// When a study is looked at before all have taken part, and what ends it.
struct SequentialPlan {
  std::string contrast;  ///< Name of the primary contrast that decides.
  std::vector<int>
      looks;  ///< Numbers of complete sessions, ascending; the last ends the study.
  AlphaSpending spending = AlphaSpending::kObrienFleming;
};

/// As the study file writes it: "weber_fraction".
[[nodiscard]] std::string to_string(ContrastMeasure measure);
/// As the study file writes them: "holm", "greater", "obrien_fleming".
[[nodiscard]] std::string to_string(Correction correction);
[[nodiscard]] std::string to_string(ContrastDirection direction);
[[nodiscard]] std::string to_string(AlphaSpending spending);
/// As a sentence has it: "O'Brien-Fleming".
[[nodiscard]] std::string spending_words(AlphaSpending spending);
/// As a sentence has it: "Weber fraction", "answer to the question confidence".
[[nodiscard]] std::string measure_words(const PlannedContrast& plan);
/// In the order of `ContrastMeasure`.
[[nodiscard]] const std::vector<ContrastMeasure>& contrast_measures();
/// Whether an effect is a ratio, tested on its logarithm; else it is a difference.
[[nodiscard]] bool is_ratio(ContrastMeasure measure) noexcept;

}  // namespace jnd::experiments
