#include <cmath>
#include <set>

#include "analysis/charts/chart_parts.h"
#include "analysis/charts/charts.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kOwnTable = 0, kGroupTable = 1, kFunctionTable = 2;

/// The standards, ascending. A standard of 0 is left out, because a logarithmic axis has no
/// place for it.
std::set<double> standards_of(const StudyData& data, const std::string& block) {
  std::set<double> standards;
  for (const ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.trials_in(block)) {
      if (trial.reference_intensity.value_or(0.0) > 0.0) {
        standards.insert(*trial.reference_intensity);
      }
    }
  }
  return standards;
}

class MatchingCharts {
 public:
  MatchingCharts(const FigureSource& source, const BlockDesign& block)
      : source_(source), block_(block), standards_(standards_of(source.data, block.block)) {
    const std::string name = file_word(block.block);
    set_.tables = {
        {.name = name + "_matches", .columns = {"series", "participant", "standard", "match"}},
        {.name = name + "_group_matches",
         .columns = {"standard", "match", "ci95_low", "ci95_high", "num_participants"}},
        {.name = name + "_matching_function", .columns = {"standard", "match"}}};
    add_own_matches();
    add_group_matches();
  }

  [[nodiscard]] bool empty() const { return set_.tables[kGroupTable].rows.empty(); }

  [[nodiscard]] ChartSet set() {
    add_function();
    set_.section = block_.block;
    set_.heading = source_.titles.title_of(block_.block);
    set_.whole = WholeFigure{.name = file_word(block_.block) + "_matches",
                             .title = said("Matches, {}", set_.heading),
                             .caption = caption()};
    set_.x = axis(said("Standard"), block_.standard_quantity(), block_.written.standard_medium);
    set_.y = axis(said("Match"), block_.quantity, block_.medium);
    std::vector<double> standards, matches = drawn_;
    for (const auto& row : set_.tables[kGroupTable].rows) {
      standards.push_back(*row[0].number);
      for (const std::size_t column : {1U, 2U, 3U}) {
        if (row[column].number) matches.push_back(*row[column].number);
      }
    }
    set_.x.range = axis_range(standards, /*logarithmic=*/true);
    set_.y.range = axis_range(matches, /*logarithmic=*/true);
    set_.everybody = everybody();
    if (law_.empty()) set_.tables.pop_back();
    return std::move(set_);
  }

 private:
  static ChartAxis axis(const std::string& what, const std::string& quantity,
                        const std::string& medium) {
    const std::string unit = experiments::quantity_unit(quantity);
    const std::string words = said_of(experiments::quantity_words(quantity)) +
                              (medium.empty() ? "" : said(" of “{}”", medium));
    return {.title = what + ": " + words + (unit.empty() ? "" : " [" + unit + "]"),
            .label = what + ": " + words,
            .unit = unit,
            .logarithmic = true};
  }

  void add_own_matches() {
    const std::string& block = block_.block;
    for (const std::string& participant : source_.participants()) {
      const int series = static_cast<int>(set_.participants.size()) + 1;
      bool any = false;
      for (const double standard : standards_) {
        const ParticipantEstimate* const own =
            source_.own(block, participant, block + ".match_at_" + number_text(standard));
        if (own == nullptr || !own->value) continue;
        any = true;
        set_.tables[kOwnTable].rows.push_back({series, participant, standard, own->value});
        drawn_.push_back(*own->value);
      }
      if (any) set_.participants.push_back(chart_of(participant, series));
    }
  }

  [[nodiscard]] Chart chart_of(const std::string& participant, int series) const {
    Chart chart{.who = participant};
    if (block_.standard_is_of_its_quantity()) {
      chart.series.push_back({.look = ChartSeries::Look::kIdentity, .legend = "identity"});
    }
    chart.series.push_back({.look = ChartSeries::Look::kTrack,
                            .table = kOwnTable,
                            .series = series,
                            .x = "standard",
                            .y = "match",
                            .legend = said("geometric mean")});
    const auto own = [&](const char* name) {
      return source_.own(block_.block, participant, block_.block + name);
    };
    const ParticipantEstimate* const k = own(".k");
    const ParticipantEstimate* const a = own(".a");
    if (k != nullptr && a != nullptr && k->value && a->value) {
      add_value(chart, a->value, a->ci95, "", a->cautions, law_words(k->value, a->value));
      if (!chart.detail.empty()) chart.detail = "a: " + chart.detail;
    } else {
      chart.reason =
          a == nullptr || a->reason.empty() ? said("no matching function") : a->reason;
    }
    return chart;
  }

  void add_group_matches() {
    for (const double standard : standards_) {
      const Estimate* const group =
          source_.results.find(block_.block + ".match_at_" + number_text(standard));
      if (group == nullptr || !group->value) continue;
      set_.tables[kGroupTable].rows.push_back(
          {standard, group->value, group->ci95.low, group->ci95.high, group->n});
    }
  }

  void add_function() {
    constexpr int kPoints = 40;
    k_ = source_.results.find(block_.block + ".k");
    a_ = source_.results.find(block_.block + ".a");
    if (k_ == nullptr || a_ == nullptr || !k_->value || !a_->value) return;
    law_ = law_words(k_->value, a_->value);
    // The function reaches no further than the standards.
    const auto& group = set_.tables[kGroupTable].rows;
    const double low = *group.front()[0].number, high = *group.back()[0].number;
    for (int i = 0; i <= kPoints; ++i) {
      const double standard = low * std::pow(high / low, static_cast<double>(i) / kPoints);
      set_.tables[kFunctionTable].rows.push_back(
          {standard, *k_->value * std::pow(standard, *a_->value)});
    }
  }

  [[nodiscard]] Chart everybody() const {
    Chart chart{.who = kEverybody};
    if (block_.standard_is_of_its_quantity()) {
      chart.series.push_back({.look = ChartSeries::Look::kIdentity, .legend = "identity"});
    }
    for (std::size_t i = 1; i <= set_.participants.size(); ++i) {
      chart.series.push_back({.look = ChartSeries::Look::kEverybodys,
                              .table = kOwnTable,
                              .series = static_cast<int>(i),
                              .x = "standard",
                              .y = "match",
                              .legend = i == 1 ? "participants" : ""});
    }
    if (!law_.empty()) {
      chart.series.push_back({.table = kFunctionTable,
                              .x = "standard",
                              .y = "match",
                              .legend = said("matching function, {}", law_)});
      add_value(chart, a_->value, a_->ci95, "", a_->cautions, law_);
      if (!chart.detail.empty()) chart.detail = "a: " + chart.detail;
    } else {
      chart.reason =
          a_ == nullptr || a_->reason.empty() ? said("no matching function") : a_->reason;
    }
    chart.series.push_back({.look = ChartSeries::Look::kAnswers,
                            .table = kGroupTable,
                            .x = "standard",
                            .y = "match",
                            .low = "ci95_low",
                            .high = "ci95_high",
                            .legend = said("geometric mean, 95 %")});
    return chart;
  }

  [[nodiscard]] std::string caption() const {
    return said(
        "Match over standard, both axes logarithmic. Grey: geometric means of each of {} over "
        "repetitions and starting values. Squares: the group’s geometric means with their 95 % "
        "intervals (Student’s t in ln). {}{}",
        counted_words(std::ssize(set_.participants), "participant"),
        (law_.empty()
             ? said("There is no matching function here.")
             : said("Black line: the matching function, match = k standardᵃ with {}.", law_)),
        (block_.standard_is_of_its_quantity()
             ? said(" Dashed: identity, the match being the standard.")
             : ""));
  }

  const FigureSource& source_;
  const BlockDesign& block_;
  std::set<double> standards_;
  std::vector<double> drawn_;  ///< The participants' own matches.
  const Estimate *k_ = nullptr, *a_ = nullptr;
  std::string law_;  ///< For example "k = 1.02, a = 0.98"; "" without a matching function.
  ChartSet set_;
};

}  // namespace

std::vector<ChartSet> matching_charts(const FigureSource& source) {
  std::vector<ChartSet> sets;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.matches()) continue;
    MatchingCharts charts(source, block);
    if (!charts.empty()) sets.push_back(charts.set());
  }
  return sets;
}

}  // namespace jnd::analysis
