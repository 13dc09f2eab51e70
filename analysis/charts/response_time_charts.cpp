#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "analysis/charts/chart_parts.h"
#include "analysis/charts/charts.h"
#include "analysis/results/number_words.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kOwnTimes = 0, kGroupTimes = 1;

/// A participant's response times at each level. The level is what distinguishes the trials of
/// the block.
using Times = std::map<double, std::vector<double>>;

std::optional<double> level_of(const BlockDesign& block, const core::TrialRow& trial) {
  if (block.produces()) return trial.target_percent;
  return block.matches() ? trial.reference_intensity : trial.intensity;
}

Times times_of(const BlockDesign& block, const ParticipantData& participant) {
  Times times;
  for (const core::TrialRow& trial : participant.trials_in(block.block)) {
    const std::optional<double> level = level_of(block, trial);
    const double time_s = trial.measures.response_time_s.value_or(0.0);
    if (level && time_s > 0.0) times[*level].push_back(time_s);
  }
  return times;
}

/// Response times over the stimuli of one block whose study file lists them.
class ResponseTimeCharts {
 public:
  ResponseTimeCharts(const FigureSource& source, const BlockDesign& block)
      : source_(source), block_(block) {
    const std::string name = file_word(block.block);
    set_.tables = {{.name = name + "_response_times",
                    .columns = {"series", "participant", "level", "response_time_s"}},
                   {.name = name + "_group_response_times",
                    .columns = {"level", "response_time_s", "quartile_low_s", "quartile_high_s",
                                "num_participants"}}};
    add_own();
    add_group();
  }

  [[nodiscard]] bool empty() const { return set_.tables[kGroupTimes].rows.empty(); }

  [[nodiscard]] ChartSet set() {
    set_.section = "response_times";
    set_.heading = source_.titles.title_of(block_.block);
    set_.whole = WholeFigure{
        .name = file_word(block_.block) + "_response_times",
        .title = said("Response times, {}", set_.heading),
        .caption = said("Median response time at each stimulus: of each participant, and of "
                        "all with the middle half of them as bars."),
        .height_in = 3.0};
    if (block_.produces()) {
      set_.x = {
          .title = said("Target [%]"), .label = "target", .unit = "%", .logarithmic = true};
    } else if (block_.matches()) {
      set_.x = quantity_chart_axis(block_.standard_quantity(), "standard");
    } else {
      set_.x = quantity_chart_axis(block_.quantity, "stimulus");
    }
    set_.y = {.title = said("Response time [s]"),
              .label = said("response time"),
              .unit = "s",
              .logarithmic = true};
    std::vector<double> levels, times = drawn_;
    for (const auto& row : set_.tables[kGroupTimes].rows) {
      levels.push_back(*row[0].number);
      for (const std::size_t column : {2U, 3U}) times.push_back(*row[column].number);
    }
    if (levels.front() <= 0.0) set_.x.logarithmic = false;
    set_.x.range = axis_range(levels, set_.x.logarithmic);
    set_.y.range = axis_range(times, /*logarithmic=*/true);
    set_.everybody = everybody();
    return std::move(set_);
  }

 private:
  void add_own() {
    for (const ParticipantData& participant : source_.data.participants) {
      const Times times = times_of(block_, participant);
      if (times.empty()) continue;
      const int series = static_cast<int>(set_.participants.size()) + 1;
      for (const auto& [level, values] : times) {
        const double median_s = summary_of(values).median.value();
        by_level_[level].push_back(median_s);
        drawn_.push_back(median_s);
        set_.tables[kOwnTimes].rows.push_back(
            {series, participant.participant, level, median_s});
      }
      Chart chart{.who = participant.participant};
      chart.series.push_back({.look = ChartSeries::Look::kTrack,
                              .table = kOwnTimes,
                              .series = series,
                              .x = "level",
                              .y = "response_time_s",
                              .legend = "median"});
      tell(chart, source_.own("response_times", participant.participant,
                              block_.block + ".response_time_s"));
      set_.participants.push_back(std::move(chart));
    }
  }

  void add_group() {
    for (auto& [level, medians] : by_level_) {
      std::ranges::sort(medians);
      set_.tables[kGroupTimes].rows.push_back(
          {level, percentile(medians, 0.5), percentile(medians, 0.25),
           percentile(medians, 0.75), static_cast<int>(medians.size())});
    }
  }

  template <typename AnyEstimate>
  static void tell(Chart& chart, const AnyEstimate* estimate) {
    if (estimate == nullptr || !estimate->value) return;
    add_value(chart, estimate->value, estimate->ci95, "", estimate->cautions,
              number_words(estimate->value) + " s");
  }

  [[nodiscard]] Chart everybody() const {
    Chart chart{.who = kEverybody};
    for (std::size_t i = 1; i <= set_.participants.size(); ++i) {
      chart.series.push_back({.look = ChartSeries::Look::kEverybodys,
                              .table = kOwnTimes,
                              .series = static_cast<int>(i),
                              .x = "level",
                              .y = "response_time_s",
                              .legend = i == 1 ? "participants" : ""});
    }
    chart.series.push_back({.look = ChartSeries::Look::kAnswers,
                            .table = kGroupTimes,
                            .x = "level",
                            .y = "response_time_s",
                            .low = "quartile_low_s",
                            .high = "quartile_high_s",
                            .legend = said("median and middle half")});
    tell(chart, source_.results.find(block_.block + ".response_time_s"));
    if (block_.reference_intensity) {
      chart.lines.push_back({.at = *block_.reference_intensity, .label = "reference"});
    }
    return chart;
  }

  const FigureSource& source_;
  const BlockDesign& block_;
  ChartSet set_;
  std::map<double, std::vector<double>> by_level_;
  std::vector<double> drawn_;
};

}  // namespace

std::vector<ChartSet> response_time_charts(const FigureSource& source) {
  std::vector<ChartSet> sets;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.has_fixed_levels()) continue;
    ResponseTimeCharts charts(source, block);
    if (!charts.empty()) sets.push_back(charts.set());
  }
  return sets;
}

}  // namespace jnd::analysis
