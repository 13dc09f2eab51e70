#include <algorithm>
#include <set>

#include "analysis/charts/chart_parts.h"
#include "analysis/charts/charts.h"
#include "analysis/data/stored_studies.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// What is drawn over the stimuli of a block: a rating, or the answers to one of its questions.
struct RatedWhat {
  std::string section, prefix;  ///< The names in the results.
  std::string title;            ///< For example "Rating" or "How sure are you?".
  std::string low_label, high_label;
  int num_steps = 0;  ///< The number of steps of the scale; 0 if the answer is a number.
};

class RatedCharts {
 public:
  RatedCharts(const FigureSource& source, const BlockDesign& block, const RatedWhat& what)
      : source_(source), block_(block), what_(what) {
    const std::string name = file_word(what.prefix);
    set_.tables = {
        {.name = name + "_own_means", .columns = {"series", "participant", "stimulus", "mean"}},
        {.name = name + "_means",
         .columns = {"stimulus", "mean", "ci95_low", "ci95_high", "num_participants"}}};
    for (const double level : block.written.intensities) {
      const Estimate* const mean =
          source.results.find(what.prefix + ".mean_at_" + number_text(level));
      if (mean == nullptr || !mean->value) continue;
      levels_.insert(level);
    }
  }

  [[nodiscard]] bool empty() const { return levels_.empty(); }

  [[nodiscard]] ChartSet set() {
    add_means();
    add_own_means();
    set_.section = what_.section;
    set_.heading = source_.titles.title_of(block_.block);
    set_.whole = WholeFigure{.name = file_word(what_.prefix) + "_means",
                             .title = what_.title + ", " + set_.heading,
                             .caption = caption()};
    set_.x = quantity_chart_axis(block_.quantity, "stimulus");
    set_.x.logarithmic = *levels_.begin() > 0.0;
    set_.x.range = axis_range({levels_.begin(), levels_.end()}, set_.x.logarithmic);
    set_.y = {.title = y_title(), .label = y_title()};
    if (what_.num_steps > 0) {
      drawn_.push_back(1.0);
      drawn_.push_back(what_.num_steps);
    }
    set_.y.range = axis_range(drawn_, /*logarithmic=*/false);
    set_.everybody = everybody();
    return std::move(set_);
  }

 private:
  static constexpr std::size_t kOwnTable = 0, kGroupTable = 1;

  [[nodiscard]] std::string y_title() const {
    if (what_.num_steps == 0) return what_.title;
    return said("Step, 1: {}, {}: {}", what_.low_label, std::to_string(what_.num_steps),
                what_.high_label);
  }

  void add_means() {
    for (const double level : levels_) {
      const Estimate* const mean =
          source_.results.find(what_.prefix + ".mean_at_" + number_text(level));
      set_.tables[kGroupTable].rows.push_back(
          {level, mean->value, mean->ci95.low, mean->ci95.high, mean->n});
      for (const std::optional<double>& end : {mean->value, mean->ci95.low, mean->ci95.high}) {
        if (end) drawn_.push_back(*end);
      }
    }
  }

  void add_own_means() {
    for (const std::string& participant : source_.participants()) {
      const int series = static_cast<int>(set_.participants.size()) + 1;
      bool any = false;
      for (const double level : levels_) {
        const ParticipantEstimate* const own = source_.own(
            what_.section, participant, what_.prefix + ".mean_at_" + number_text(level));
        if (own == nullptr || !own->value) continue;
        any = true;
        set_.tables[kOwnTable].rows.push_back({series, participant, level, own->value});
        drawn_.push_back(*own->value);
      }
      if (any) set_.participants.push_back(chart_of(participant, series));
    }
  }

  [[nodiscard]] static ChartSeries own_series(ChartSeries::Look look, int series,
                                              const std::string& legend) {
    return {.look = look,
            .table = kOwnTable,
            .series = series,
            .x = "stimulus",
            .y = "mean",
            .legend = legend};
  }

  [[nodiscard]] Chart chart_of(const std::string& participant, int series) const {
    Chart chart{.who = participant};
    chart.series.push_back(own_series(ChartSeries::Look::kTrack, series, "mean"));
    const ParticipantEstimate* const own =
        source_.own(what_.section, participant, what_.prefix + ".rank_correlation");
    if (own != nullptr) {
      add_value(chart, own->value, own->ci95, own->reason, own->cautions,
                own->value ? said("rank correlation {}", number_words(*own->value, 2)) : "");
    }
    return chart;
  }

  [[nodiscard]] Chart everybody() const {
    Chart chart{.who = kEverybody};
    for (std::size_t i = 1; i <= set_.participants.size(); ++i) {
      chart.series.push_back(own_series(ChartSeries::Look::kEverybodys, static_cast<int>(i),
                                        i == 1 ? "participants" : ""));
    }
    chart.series.push_back({.look = ChartSeries::Look::kAnswers,
                            .table = kGroupTable,
                            .x = "stimulus",
                            .y = "mean",
                            .low = "ci95_low",
                            .high = "ci95_high",
                            .legend = said("mean, 95 %")});
    const Estimate* const relation = source_.results.find(what_.prefix + ".rank_correlation");
    if (relation != nullptr) {
      add_value(chart, relation->value, relation->ci95, relation->reason, relation->cautions,
                relation->value ? said("rank correlation {}", number_words(*relation->value, 2))
                                : "");
    }
    return chart;
  }

  [[nodiscard]] std::string caption() const {
    return said(
        "{}: mean over the stimuli. Grey: means of each of {}. Points: the mean of the "
        "participants’ means with its 95 % interval (Student’s t).",
        what_.title, counted_words(std::ssize(set_.participants), "participant"));
  }

  const FigureSource& source_;
  const BlockDesign& block_;
  RatedWhat what_;
  std::set<double> levels_;
  std::vector<double> drawn_;
  ChartSet set_;
};

RatedWhat question_of(const BlockDesign& block, const experiments::QuestionnaireItem& item) {
  const bool is_scale = item.kind == "scale";
  return {.section = block.block + "_questions",
          .prefix = block.block + ".question." + item.name,
          .title = in_spoken_language(item.question),
          .low_label = is_scale ? in_spoken_language(item.low_label) : "",
          .high_label = is_scale ? in_spoken_language(item.high_label) : "",
          .num_steps = is_scale ? item.num_steps : 0};
}

}  // namespace

std::vector<ChartSet> rated_charts(const FigureSource& source) {
  std::vector<ChartSet> sets;
  const auto add = [&](const BlockDesign& block, const RatedWhat& what) {
    RatedCharts charts(source, block, what);
    if (!charts.empty()) sets.push_back(charts.set());
  };
  for (const BlockDesign& block : source.data.blocks) {
    if (block.rates()) {
      add(block,
          {.section = block.block,
           .prefix = block.block + ".rating",
           .title = said("Rating"),
           .low_label = in_spoken_language(block.written.low_label),
           .high_label = in_spoken_language(block.written.high_label),
           .num_steps = static_cast<int>(block.written.settings.number("num_steps", 10.0))});
    }
    for (const experiments::QuestionnaireItem& item : block.written.questions) {
      add(block, question_of(block, item));
    }
  }
  return sets;
}

}  // namespace jnd::analysis
