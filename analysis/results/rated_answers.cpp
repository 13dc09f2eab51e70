#include "analysis/results/rated_answers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "analysis/results/magnitude_section.h"
#include "analysis/results/test_families.h"
#include "analysis/statistics/ranks.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

using OwnRelation = std::function<std::optional<double>(const std::vector<RatedAnswer>&)>;

std::vector<double> values_of(const std::vector<RatedAnswer>& answers) {
  std::vector<double> values;
  for (const RatedAnswer& one : answers) values.push_back(one.value);
  return values;
}

/// The rank correlation of the answers with the value that `of` returns. Answers without such a
/// value are left out.
std::optional<double> correlation_with(
    const std::vector<RatedAnswer>& answers,
    const std::function<std::optional<double>(const RatedAnswer&)>& of) {
  std::vector<double> x, y;
  for (const RatedAnswer& one : answers) {
    if (const std::optional<double> value = of(one)) {
      x.push_back(*value);
      y.push_back(one.value);
    }
  }
  return rank_correlation(x, y);
}

std::optional<double> mean_where(const std::vector<RatedAnswer>& answers, bool right) {
  std::vector<double> values;
  for (const RatedAnswer& one : answers) {
    if (one.was_right == right) values.push_back(one.value);
  }
  return summary_of(values).mean;
}

std::optional<double> slope_per_doubling(const std::vector<RatedAnswer>& answers) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const RatedAnswer& one : answers) {
    if (!(one.level.value_or(0.0) > 0.0)) continue;
    const double log2 = std::log2(*one.level);
    ++n;
    x += log2;
    y += one.value;
    xx += log2 * log2;
    xy += log2 * one.value;
  }
  const double spread = n * xx - x * x;
  if (!(n >= 2.0 && spread > 1e-9 * n * xx)) return std::nullopt;
  return (n * xy - x * y) / spread;
}

class RatedWriter {
 public:
  RatedWriter(ResultsSection& section, const RatedName& name, const RatedAnswers& answers)
      : section_(section), name_(name), answers_(answers) {}

  void add_means() {
    std::vector<double> means, medians;
    for (const auto& [participant, own] : answers_) {
      if (own.empty()) continue;
      const Summary summary = summary_of(values_of(own));
      means.push_back(*summary.mean);
      medians.push_back(*summary.median);
      tell(participant, "", summary.mean, "");
    }
    add_mean(section_, name_.prefix, said("mean of the participants' means, {}", name_.words),
             means, name_.unit);
    const Summary summary = summary_of(means);
    add(".sd", summary.standard_deviation,
        said("standard deviation between participants of their means"), means.size());
    add(".median", summary_of(medians).median, said("median of the participants' medians"),
        medians.size());
  }

  void add_levels() {
    if (!name_.has_fixed_levels) return;
    std::map<double, std::vector<double>> means, medians;
    for (const auto& [participant, own] : answers_) {
      std::map<double, std::vector<double>> at;
      for (const RatedAnswer& one : own) {
        if (one.level) at[*one.level].push_back(one.value);
      }
      for (const auto& [level, values] : at) {
        const Summary summary = summary_of(values);
        means[level].push_back(*summary.mean);
        medians[level].push_back(*summary.median);
        tell(participant, ".mean_at_" + number_text(level), summary.mean, "");
      }
    }
    for (const auto& [level, values] : means) {
      add_mean(section_, name_.prefix + ".mean_at_" + number_text(level),
               said("mean of the participants' means at this stimulus"), values, name_.unit);
      add(".median_at_" + number_text(level), summary_of(medians.at(level)).median,
          said("median of the participants' medians at this stimulus"), values.size());
    }
  }

  /// Adds the mean of everybody's own relation, tested against the value `nothing` of no
  /// relation.
  void add_relation(const std::string& ending, const std::string& meaning,
                    const std::string& unit, const OwnRelation& relation, double nothing,
                    const std::string& why_none) {
    std::vector<double> values, differences;
    for (const auto& [participant, own] : answers_) {
      const std::optional<double> value = relation(own);
      tell(participant, ending, value, value ? "" : why_none);
      if (!value) continue;
      values.push_back(*value);
      differences.push_back(*value - nothing);
    }
    if (values.empty()) return;
    add_mean(section_, name_.prefix + ending, meaning, values, unit);
    section_.comparisons.push_back(
        {.name = name_.prefix + ending + (nothing == 0.0 ? "" : " - " + number_text(nothing)),
         .comparison = one_sample_t_test(differences),
         .family = kQuestionsFamily});
  }

  void add_relations() {
    constexpr const char* kEqual =
        said_later("all answers or all stimuli are equal, or there are fewer than three");
    add_relation(
        ".rank_correlation",
        said("rank correlation of the answer with the stimulus, mean of the participants' own"),
        "1",
        [](const auto& own) {
          return correlation_with(own, [](const RatedAnswer& one) { return one.level; });
        },
        0.0, said(kEqual));
    if (any([](const RatedAnswer& one) { return one.distance_ln.has_value(); })) {
      add_relation(
          ".rank_correlation_with_difference",
          said("rank correlation of the answer with |ln(test / reference)|, mean of the "
               "participants' own"),
          "1",
          [](const auto& own) {
            return correlation_with(own,
                                    [](const RatedAnswer& one) { return one.distance_ln; });
          },
          0.0, said(kEqual));
    }
    if (!any([](const RatedAnswer& one) { return one.was_right.has_value(); })) return;
    add_right_and_wrong();
  }

 private:
  void add_right_and_wrong() {
    constexpr const char* kOneKind =
        said_later("there are none of them that were right, or none that were wrong");
    for (const bool right : {true, false}) {
      std::vector<double> means;
      for (const auto& [participant, own] : answers_) {
        if (const std::optional<double> mean = mean_where(own, right)) means.push_back(*mean);
      }
      add_mean(section_, name_.prefix + (right ? ".when_right" : ".when_wrong"),
               said("mean of the participants' means where the answer to the trial was {}",
                    (right ? "right" : "wrong")),
               means, name_.unit);
    }
    add_relation(
        ".right_minus_wrong",
        said("how much higher where the answer to the trial was right, mean of the "
             "participants' own"),
        name_.unit,
        [](const auto& own) {
          const std::optional<double> right = mean_where(own, true);
          const std::optional<double> wrong = mean_where(own, false);
          return right && wrong ? std::optional(*right - *wrong) : std::nullopt;
        },
        0.0, said(kOneKind));
    add_relation(
        ".type_2_auroc",
        said(
            "area under the type 2 ROC: probability that a right answer has more than a wrong "
            "one, 0.5 where it says nothing of right and wrong; mean of the participants' own"),
        "1", type_2_auroc, 0.5, said(kOneKind));
  }

  [[nodiscard]] bool any(const std::function<bool(const RatedAnswer&)>& has) const {
    return std::ranges::any_of(
        answers_, [&](const auto& own) { return std::ranges::any_of(own.second, has); });
  }

  void add(const std::string& ending, const std::optional<double>& value,
           const std::string& meaning, std::size_t n) {
    section_.estimates.push_back({.name = name_.prefix + ending,
                                  .value = value,
                                  .unit = name_.unit,
                                  .meaning = meaning,
                                  .n = static_cast<int>(n)});
  }

  void tell(const std::string& participant, const std::string& ending,
            const std::optional<double>& value, const std::string& reason) {
    section_.participants.push_back({participant, name_.prefix + ending, value, {}, reason});
  }

  ResultsSection& section_;
  const RatedName& name_;
  const RatedAnswers& answers_;
};

}  // namespace

std::optional<double> rank_correlation(const std::vector<double>& a,
                                       const std::vector<double>& b) {
  constexpr std::size_t kFewest = 3;
  if (a.size() < kFewest) return std::nullopt;
  const Ranks ranks_a = ranks_of(a), ranks_b = ranks_of(b);
  // The mean of doubled ranks is n + 1, whatever the ties are.
  const double mean = static_cast<double>(a.size()) + 1.0;
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double da = static_cast<double>(ranks_a.doubled[i]) - mean;
    const double db = static_cast<double>(ranks_b.doubled[i]) - mean;
    aa += da * da;
    bb += db * db;
    ab += da * db;
  }
  if (aa == 0.0 || bb == 0.0) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

std::optional<double> type_2_auroc(const std::vector<RatedAnswer>& answers) {
  double pairs = 0.0, area = 0.0;
  for (const RatedAnswer& right : answers) {
    if (right.was_right != true) continue;
    for (const RatedAnswer& wrong : answers) {
      if (wrong.was_right != false) continue;
      ++pairs;
      area += right.value > wrong.value ? 1.0 : right.value == wrong.value ? 0.5 : 0.0;
    }
  }
  return pairs > 0.0 ? std::optional(area / pairs) : std::nullopt;
}

void add_rated(ResultsSection& section, const RatedName& name, const RatedAnswers& answers) {
  RatedWriter writer(section, name, answers);
  writer.add_means();
  writer.add_levels();
  writer.add_relations();
}

void add_trend_per_doubling(ResultsSection& section, const RatedName& name,
                            const RatedAnswers& answers) {
  RatedWriter(section, name, answers)
      .add_relation(
          ".per_doubling",
          said("how many steps a stimulus of twice as much is rated higher: slope over log2 of "
               "the stimulus, least squares, mean of the participants' own"),
          "1", slope_per_doubling, 0.0, said("fewer than two stimuli above 0"));
}

}  // namespace jnd::analysis
