#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "analysis/statistics/sequential_estimate.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

/// How people's own contrasts scatter about the effect.
enum class Spread { kNormal, kFitted, kSkewed, kHeavyTails };

const char* words_of(Spread spread) {
  return spread == Spread::kNormal   ? "normal"
         : spread == Spread::kFitted ? "own fits"
         : spread == Spread::kSkewed ? "skewed"
                                     : "heavy tails";
}

/// Contrasts of very many people's own fits in two conditions, in ln ln(1 + w), for Weber
/// fractions 0.6 and 0.4 and five answers at each of eight hard levels. They are shifted and
/// scaled to mean 0 and sd 1.
const std::vector<double>& fitted_contrasts() {
  static const std::vector<double> kAll = [] {
    constexpr int kPeople = 20000;
    RandomStream random(2018, "contrasts of own fits");
    std::vector<double> contrasts;
    double sum = 0.0, squares = 0.0;
    while (std::ssize(contrasts) < kPeople) {
      const double slope_z = random.normal();
      std::optional<double> numbers[2];
      for (const int condition : {0, 1}) {
        Person person = Population{.weber_fraction = condition == 0 ? 0.6 : 0.4,
                                   .spread_ln = 0.3,
                                   .place_sd_ln = 0.15}
                            .person(slope_z, random.normal());
        person.slope *= std::exp(0.2 * random.normal());
        numbers[condition] = own_number(answers_of(person, kHardLevels, 5, random));
      }
      if (!numbers[0] || !numbers[1]) continue;
      contrasts.push_back(*numbers[0] - *numbers[1]);
      sum += contrasts.back();
      squares += contrasts.back() * contrasts.back();
    }
    const double mean = sum / kPeople, sd = std::sqrt(squares / kPeople - mean * mean);
    for (double& one : contrasts) one = (one - mean) / sd;
    return contrasts;
  }();
  return kAll;
}

/// Draws a number with mean 0 and sd 1: normal; like people's own fits; lognormal with sigma
/// 0.5 (skewness 1.75); or Student's t with 5 degrees of freedom (kurtosis 9).
double drawn(Spread spread, RandomStream& random) {
  if (spread == Spread::kFitted) {
    const std::vector<double>& all = fitted_contrasts();
    return all[random.below(all.size())];
  }
  const double z = random.normal();
  if (spread == Spread::kNormal) return z;
  if (spread == Spread::kSkewed) {
    constexpr double kSigma = 0.5;
    const double mean = std::exp(0.5 * kSigma * kSigma);
    const double sd = mean * std::sqrt(std::expm1(kSigma * kSigma));
    return (std::exp(kSigma * z) - mean) / sd;
  }
  constexpr int kDegreesOfFreedom = 5;
  double squares = 0.0;
  for (int i = 0; i < kDegreesOfFreedom; ++i) {
    const double one = random.normal();
    squares += one * one;
  }
  return z / std::sqrt(squares / kDegreesOfFreedom) *
         std::sqrt((kDegreesOfFreedom - 2.0) / kDegreesOfFreedom);
}

struct LookedDesign {
  std::vector<int> looks;
  SpendingFunction spending = SpendingFunction::kObrienFleming;
  Tail tail = Tail::kTwoSided;
  double effect = 0.0;  ///< The effect in standard deviations of people's contrasts.
  Spread spread = Spread::kNormal;
  std::size_t num_groups = 1;
};

struct LookedStudy {
  SequentialOutcome outcome;
  int num_people = 0;
};

LookedStudy study_of(const LookedDesign& design, const SequentialBoundaries& boundaries,
                     RandomStream& random) {
  std::vector<std::optional<PersonScore>> people;
  const auto groups = static_cast<double>(design.num_groups);
  for (int person = 0; person < design.looks.back(); ++person) {
    const auto group = static_cast<std::size_t>(person) % design.num_groups;
    // The effect is the sum over the groups.
    people.push_back(PersonScore{group, design.effect / groups + drawn(design.spread, random)});
  }
  std::vector<std::optional<EffectEstimate>> estimates;
  for (const int look : design.looks) {
    estimates.push_back(
        estimate_of_first(people, static_cast<std::size_t>(look), design.num_groups));
  }
  LookedStudy study{.outcome = sequential_outcome(boundaries, estimates)};
  study.num_people = design.looks[study.outcome.estimates.size() - 1];
  return study;
}

std::string share_words(std::int64_t num, std::int64_t of) {
  char text[48];
  const double share = static_cast<double>(num) / static_cast<double>(of);
  std::snprintf(text, sizeof text, "%.2f %% (%.2f)", 100.0 * share,
                100.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(of)));
  return text;
}

std::string plain_percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100.0 * share);
  return text;
}

std::string signed_words(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%+.3f", value);
  return text;
}

std::vector<std::string> cells_of(const LookedDesign& design) {
  std::string looks;
  for (const int look : design.looks) {
    looks += (looks.empty() ? "" : ", ") + std::to_string(look);
  }
  char effect[16];
  std::snprintf(effect, sizeof effect, "%.1f", design.effect);
  return {looks + (design.num_groups > 1 ? ", two groups" : ""),
          design.spending == SpendingFunction::kPocock ? "Pocock" : "O'Brien-Fleming",
          design.tail == Tail::kTwoSided ? "two" : "one", words_of(design.spread), effect};
}

std::string cover_level(const LookedDesign& design, std::int64_t num_studies,
                        std::uint64_t seed) {
  const SequentialBoundaries boundaries =
      boundaries_of({.looks = design.looks, .spending = design.spending, .tail = design.tail});
  std::vector<std::string> cells = cells_of(design);
  RandomStream random(seed, "level of looks " + row_of(cells));
  std::int64_t num_significant = 0, num_fixed = 0;
  for (std::int64_t i = 0; i < num_studies; ++i) {
    const LookedStudy study = study_of(design, boundaries, random);
    num_significant += study.outcome.significant ? 1 : 0;
  }
  // The same test without looks shows what the test itself contributes.
  LookedDesign fixed = design;
  fixed.looks = {design.looks.back()};
  const SequentialBoundaries at_once =
      boundaries_of({.looks = fixed.looks, .tail = design.tail});
  for (std::int64_t i = 0; i < num_studies; ++i) {
    num_fixed += study_of(fixed, at_once, random).outcome.significant ? 1 : 0;
  }
  cells.pop_back();
  cells.push_back(share_words(num_significant, num_studies));
  cells.push_back(share_words(num_fixed, num_studies));
  return row_of(cells);
}

std::string cover_estimate(const LookedDesign& design, int num_sets, std::uint64_t seed) {
  const SequentialBoundaries boundaries =
      boundaries_of({.looks = design.looks, .spending = design.spending, .tail = design.tail});
  std::vector<std::string> cells = cells_of(design);
  RandomStream random(seed, "estimates after looks " + row_of(cells));
  Coverage ordinary, adjusted;
  int num_significant = 0, num_above = 0, num_ordinary_above = 0, num_without = 0;
  double people = 0.0, bias = 0.0, ordinary_bias = 0.0;
  for (int set = 0; set < num_sets; ++set) {
    const LookedStudy study = study_of(design, boundaries, random);
    num_significant += study.outcome.significant ? 1 : 0;
    people += study.num_people;
    const EffectEstimate& last = *study.outcome.estimates.back();
    const auto estimate = SequentialEstimate::of(boundaries, study.outcome);
    ordinary.add(true, interval_of(last, 0.95), design.effect);
    adjusted.add(true, estimate->interval(0.95), design.effect);
    const std::optional<double> median = estimate->median_unbiased();
    num_without += median ? 0 : 1;
    bias += median.value_or(last.effect) - design.effect;
    ordinary_bias += last.effect - design.effect;
    num_above += median.value_or(last.effect) > design.effect ? 1 : 0;
    num_ordinary_above += last.effect > design.effect ? 1 : 0;
  }
  char expected[16];
  std::snprintf(expected, sizeof expected, "%.1f", people / num_sets);
  cells.insert(cells.end(),
               {plain_percent(static_cast<double>(num_significant) / num_sets), expected,
                adjusted.words(), ordinary.words(),
                plain_percent(static_cast<double>(num_above) / num_sets),
                plain_percent(static_cast<double>(num_ordinary_above) / num_sets),
                signed_words(bias / num_sets), signed_words(ordinary_bias / num_sets),
                std::to_string(num_without)});
  return row_of(cells);
}

std::vector<LookedDesign> designs() {
  std::vector<LookedDesign> all;
  for (const auto spending : {SpendingFunction::kObrienFleming, SpendingFunction::kPocock}) {
    all.push_back({.looks = {12, 24}, .spending = spending});
    all.push_back({.looks = {12, 18, 24}, .spending = spending});
    all.push_back({.looks = {6, 9, 12}, .spending = spending});
    all.push_back({.looks = {10, 20, 30, 40, 50}, .spending = spending});
    all.push_back({.looks = {12, 18, 24}, .spending = spending, .tail = Tail::kGreater});
    all.push_back({.looks = {12, 18, 24}, .spending = spending, .spread = Spread::kFitted});
    all.push_back({.looks = {6, 9, 12}, .spending = spending, .spread = Spread::kFitted});
    all.push_back({.looks = {12, 18, 24}, .spending = spending, .spread = Spread::kSkewed});
    all.push_back({.looks = {12, 18, 24}, .spending = spending, .spread = Spread::kHeavyTails});
    all.push_back({.looks = {12, 24, 36}, .spending = spending, .num_groups = 2});
  }
  return all;
}

}  // namespace

void cover_sequential(int num_sets, std::uint64_t seed) {
  const std::int64_t num_null = std::int64_t{10} * num_sets;
  std::printf(
      "\n## Studies that looks may end: how often they find what is not there\n\n"
      "%lld studies a row without an effect, alpha 0.05. People's own contrasts spread by 1: "
      "normally, as those of own fits (in\nln ln(1 + w), five answers at each of eight hard "
      "levels, w 0.6 and 0.4), skewed (lognormal with sigma 0.5) or with heavy\ntails "
      "(Student's t with 5 degrees of freedom). In brackets the standard error. Without "
      "looks: the same t test "
      "with all people, once.\n\n",
      static_cast<long long>(num_null));
  print_row({"looks", "spending", "sides", "people", "with looks", "without looks"});
  std::printf("| --- | --- | --- | --- | --- | --- |\n");
  std::vector<std::function<std::string()>> rows;
  for (const LookedDesign& design : designs()) {
    rows.emplace_back([=] { return cover_level(design, num_null, seed); });
  }
  print_rows(rows);
  std::printf(
      "\n## Studies that looks may end: their estimates\n\n"
      "%d studies a row. Effect: in standard deviations of people's own contrasts. Coverage of "
      "the 95 %% interval, how often the\nestimate is above the truth (which should be half of "
      "the time) and its mean error; each in the stage-wise order, and in\nbrackets as if "
      "nobody had looked. n: people at the end, in the mean. The test: share with a crossed "
      "boundary.\n\n",
      num_sets);
  print_row({"looks", "spending", "sides", "people", "effect", "significant", "n", "coverage",
             "(ordinary)", "above", "(ordinary)", "bias", "(ordinary)", "without"});
  std::printf(
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- "
      "|\n");
  rows.clear();
  for (const LookedDesign& design : designs()) {
    for (const double effect : {0.0, 0.5, 0.8, 1.2}) {
      LookedDesign one = design;
      // With two groups the effect is a difference, whose standard error is twice as large.
      one.effect = effect * static_cast<double>(design.num_groups);
      rows.emplace_back([=] { return cover_estimate(one, num_sets, seed); });
    }
  }
  print_rows(rows);
}

}  // namespace jnd::coverage
