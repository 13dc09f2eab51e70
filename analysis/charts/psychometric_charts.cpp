#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "analysis/charts/chart_parts.h"
#include "analysis/charts/charts.h"
#include "analysis/fits/bounded_interval.h"
#include "analysis/fits/interval_order_fit.h"
#include "analysis/results/number_words.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/summary.h"
#include "analysis/statistics/wilson_interval.h"
#include "analysis/words/said.h"
#include "core/psychometric_function.h"
#include "experiments/procedures/task.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

struct LevelAnswers {
  std::int64_t num_yes = 0, num_trials = 0;
  [[nodiscard]] double ratio() const {
    return static_cast<double>(num_yes) / static_cast<double>(num_trials);
  }
};

/// A fitted curve, with the interval of its Weber fraction.
struct Curve {
  double weber_fraction = 0.0;
  Interval ci95;
  double pse = 0.0;
  double order_effect_ln = 0.0;
  double lapse_rate = 0.0;

  [[nodiscard]] double ratio(double intensity) const { return at(weber_fraction, intensity); }
  /// The lowest and highest of the curves with the ends of the interval, for the same pse. An
  /// open end stands for a step or a flat line.
  [[nodiscard]] std::pair<double, double> band(double intensity) const {
    const double steep = at(ci95.low.value_or(0.0), intensity);
    const double flat =
        at(ci95.high.value_or(std::numeric_limits<double>::infinity()), intensity);
    return std::minmax(steep, flat);
  }

 private:
  [[nodiscard]] double at(double fraction, double intensity) const {
    constexpr double kFlat = 0.5;
    if (!std::isfinite(fraction)) return kFlat;
    return lapse_rate + (1.0 - 2.0 * lapse_rate) *
                            mean_over_orders(pse, fraction, order_effect_ln, intensity);
  }
};

/// The answers of one participant in one block, and both of the participant's curves.
struct OwnAnswers {
  std::string participant;
  std::map<double, LevelAnswers> levels;
  /// The Weber fraction with the pse at the reference.
  const ParticipantEstimate* fraction = nullptr;
  /// The Weber fraction with the pse free.
  const ParticipantEstimate* free_fraction = nullptr;
  std::optional<Curve> fixed, freed;
};

std::string fraction_words(const std::optional<double>& value) {
  if (!value) return "none";
  return number_words(value, *value < 0.1 ? 3 : 2);
}

/// For example "median person: w = 0.29 (0.21 .. 0.40)".
std::string median_person_words(const Estimate& fraction) {
  const int num_decimals = *fraction.value < 0.1 ? 3 : 2;
  std::string words = said("median person: w = {}", number_words(fraction.value, num_decimals));
  const Interval ci95 = bounded_by_data(fraction.ci95, fraction.value);
  if (!ci95.low || !ci95.high) return words;
  return words + " (" + number_words(ci95.low, num_decimals) + " .. " +
         number_words(ci95.high, num_decimals) + ")";
}

/// Explains the reason to the participant, not to the person who fits the curve.
std::string in_plain_words(const std::string& reason, bool is_separated, bool frees) {
  if (!is_separated) return reason;
  const std::string place = frees ? said("one level") : said("the reference");
  return said(
      "every answer fell on its side of {}, so the Weber fraction is smaller than these "
      "stimuli can show; stimuli nearer to {} would find it",
      place, (frees ? "it" : place));
}

void add_word(std::string& words, const std::string& more, const char* between) {
  if (!more.empty()) words += (words.empty() ? "" : between) + more;
}

class PsychometricCharts {
 public:
  PsychometricCharts(const FigureSource& source, const BlockDesign& block)
      : source_(source),
        block_(block),
        frees_(source.section(block.block) != nullptr &&
               source.section(block.block)->own_fractions_free_pse) {
    for (const ParticipantData& participant : source.data.participants) count(participant);
  }

  [[nodiscard]] bool empty() const { return all_.empty(); }

  [[nodiscard]] ChartSet set() {
    const std::string name = file_word(block_.block);
    const std::string title = source_.titles.title_of(block_.block);
    const bool is_two_interval = task_of(block_.written) == experiments::Task::kTwoInterval;
    set_ = {.section = block_.block,
            .heading = title,
            .x = quantity_chart_axis(block_.quantity, "test"),
            .y = {.title = said("Proportion of answers “more”"),
                  .label = is_two_interval ? said("test chosen in percent")
                                           : said("“yes” in percent"),
                  .is_proportion = true,
                  .range = {0.0, 1.0}}};
    std::vector<double> intensities{reference_};
    for (const auto& [intensity, level] : pooled_) intensities.push_back(intensity);
    set_.x.range = axis_range(intensities);
    set_.x.range.low = std::max(set_.x.range.low, 0.0);
    set_.tables.resize(kSpreadTable + 1);
    set_.tables[kAnswersTable] = {
        .name = name + "_answers",
        .columns = {"series", "participant", "intensity", "num_yes", "num_trials", "ratio",
                    "ratio_low", "ratio_high"}};
    const std::vector<std::string> own_columns = {"series", "participant", "intensity",
                                                  "ratio",  "ratio_low",   "ratio_high"};
    set_.tables[kCurvesTable] = {.name = name + "_curves", .columns = own_columns};
    set_.tables[kFreeCurvesTable] = {.name = name + "_curves_free_pse", .columns = own_columns};
    set_.tables[kMedianPersonTable] = {
        .name = name + "_median_person",
        .columns = {"intensity", "ratio", "ratio_low", "ratio_high"}};
    set_.tables[kGroupCurveTable] = {.name = name + "_group_curve",
                                     .columns = {"intensity", "ratio"}};
    set_.tables[kPooledTable] = block_.has_fixed_levels() ? means_table() : shares_table();
    for (const OwnAnswers& own : all_) add_participant(own);
    add_everybody();
    set_.panels = PanelFigures{.name = name + "_participants",
                               .title = said("Answers of every participant, {}", title),
                               .caption = panels_caption(),
                               .thesis = said("Fig. D.5 and D.20")};
    return std::move(set_);
  }

 private:
  static constexpr std::size_t kAnswersTable = 0, kCurvesTable = 1, kFreeCurvesTable = 2,
                               kMedianPersonTable = 3, kGroupCurveTable = 4, kPooledTable = 5,
                               kSpreadTable = 6;

  void count(const ParticipantData& participant) {
    OwnAnswers own{.participant = participant.participant};
    for (const core::TrialRow& trial : participant.trials_in(block_.block)) {
      if (!trial.intensity || !trial.response || !trial.reference_intensity) continue;
      reference_ = *trial.reference_intensity;
      for (LevelAnswers* const level :
           {&own.levels[*trial.intensity], &pooled_[*trial.intensity]}) {
        level->num_yes += *trial.response > 0.5 ? 1 : 0;
        ++level->num_trials;
      }
    }
    if (!own.levels.empty()) all_.push_back(std::move(own));
  }

  /// Finds the results for this participant's curves.
  void find_curves(OwnAnswers& own) const {
    const auto value = [&](const std::string& name) {
      return source_.own(block_.block, own.participant, block_.block + "." + name);
    };
    own.fraction = value("weber_fraction");
    own.free_fraction = value("weber_fraction_free_pse");
    if (own.fraction != nullptr && own.fraction->value) {
      own.fixed = Curve{.weber_fraction = *own.fraction->value,
                        .ci95 = own.fraction->ci95,
                        .pse = reference_,
                        .order_effect_ln = value_or_0(value("order_effect_ln_at_reference"))};
    }
    const ParticipantEstimate* const pse = value("pse");
    if (own.free_fraction != nullptr && own.free_fraction->value && pse != nullptr &&
        pse->value && *pse->value > 0.0) {
      own.freed = Curve{.weber_fraction = *own.free_fraction->value,
                        .ci95 = own.free_fraction->ci95,
                        .pse = *pse->value,
                        .order_effect_ln =
                            value_or_0(source_.own(block_.block + "_intervals", own.participant,
                                                   block_.block + ".order_effect_ln"))};
    }
  }

  /// Adds rows of a curve. `first` holds the cells that stand before each, and the band follows
  /// if the curve has one.
  void add_curve(FigureTable& table, const std::vector<FigureCell>& first, const Curve& curve,
                 bool has_band) const {
    for (const double intensity : even_grid(set_.x.range)) {
      std::vector<FigureCell> row = first;
      row.insert(row.end(), {intensity, curve.ratio(intensity)});
      const auto [low, high] = curve.band(intensity);
      const bool is_closed = has_band && (curve.ci95.low || curve.ci95.high);
      row.push_back(is_closed ? FigureCell(low) : FigureCell());
      row.push_back(is_closed ? FigureCell(high) : FigureCell());
      table.rows.push_back(std::move(row));
    }
  }

  static ChartSeries curve_series(ChartSeries::Look look, std::size_t table,
                                  std::optional<int> series = std::nullopt,
                                  std::string legend = "") {
    return {.look = look,
            .table = table,
            .series = series,
            .x = "intensity",
            .y = "ratio",
            .low = "ratio_low",
            .high = "ratio_high",
            .legend = std::move(legend)};
  }

  void add_reference(Chart& chart) const { chart.lines.push_back({.at = reference_}); }

  /// Adds a line where the curve reaches 84.13 %, and returns whether it did. It adds none if
  /// the curve is the mean of two orders. It also adds none beyond the stimuli, because the
  /// axis would become so long that nothing else could be seen.
  bool add_weber_line(Chart& chart, const Curve& curve) const {
    const double at = curve.pse * (1.0 + curve.weber_fraction);
    if (curve.order_effect_ln != 0.0 || !(at <= set_.x.range.high)) return false;
    chart.lines.push_back({.kind = ChartLine::Kind::kValue,
                           .at = at,
                           .until = core::standard_normal_cdf(1.0),
                           .label = said("pse (1 + w)")});
    return true;
  }

  void add_participant(OwnAnswers own) {
    find_curves(own);
    const int series = static_cast<int>(set_.participants.size()) + 1;
    for (const auto& [intensity, level] : own.levels) {
      const auto [low, high] = wilson_interval(level.num_yes, level.num_trials);
      set_.tables[kAnswersTable].rows.push_back(
          {series, own.participant, intensity, static_cast<double>(level.num_yes),
           static_cast<double>(level.num_trials), level.ratio(), low, high});
    }
    Chart chart{.who = own.participant};
    using Look = ChartSeries::Look;
    const std::size_t primary_table = frees_ ? kFreeCurvesTable : kCurvesTable;
    const std::size_t other_table = frees_ ? kCurvesTable : kFreeCurvesTable;
    const std::optional<Curve>& primary = frees_ ? own.freed : own.fixed;
    const std::optional<Curve>& other = frees_ ? own.fixed : own.freed;
    has_order_effects_ |= (own.fixed && own.fixed->order_effect_ln != 0.0) ||
                          (own.freed && own.freed->order_effect_ln != 0.0);
    if (primary) {
      add_curve(set_.tables[primary_table], {series, own.participant}, *primary,
                /*has_band=*/true);
      chart.series.push_back(curve_series(Look::kBand, primary_table, series));
      with_curve_.push_back(series);
    }
    if (other) {
      add_curve(set_.tables[other_table], {series, own.participant}, *other,
                /*has_band=*/false);
      chart.series.push_back(curve_series(Look::kOtherCurve, other_table, series));
    }
    if (primary) chart.series.push_back(curve_series(Look::kCurve, primary_table, series));
    ChartSeries points = curve_series(
        block_.has_fixed_levels() ? Look::kAnswers : Look::kManyAnswers, kAnswersTable, series);
    points.size = "num_trials";
    chart.series.push_back(std::move(points));
    add_reference(chart);
    if (primary) (void)add_weber_line(chart, *primary);
    add_own_value(chart, own);
    set_.participants.push_back(std::move(chart));
  }

  void add_own_value(Chart& chart, const OwnAnswers& own) const {
    const ParticipantEstimate* const primary = frees_ ? own.free_fraction : own.fraction;
    const ParticipantEstimate* const other = frees_ ? own.fraction : own.free_fraction;
    if (primary == nullptr) {
      chart.reason = said("no value");
      return;
    }
    add_value(chart, primary->value, primary->ci95,
              in_plain_words(primary->reason, primary->is_separated, frees_), primary->cautions,
              "w = " + fraction_words(primary->value));
    if (other != nullptr) {
      add_other(chart,
                said("with the pse {}{}", (frees_ ? said("at the reference ") : said("free ")),
                     fraction_words(other->value)));
    }
  }

  /// Adds another value to the chart's own, or puts it in its place.
  static void add_other(Chart& chart, const std::string& words) {
    if (chart.value.empty()) {
      chart.reason += "; " + words;
    } else {
      add_word(chart.detail, words, " · ");
    }
  }

  /// The mean and spread between participants.
  [[nodiscard]] FigureTable means_table() const {
    FigureTable table{.name = file_word(block_.block) + "_means",
                      .columns = {"intensity", "mean_ratio", "sd_ratio", "low", "high",
                                  "num_participants", "num_yes", "num_trials"}};
    for (const auto& [intensity, pooled] : pooled_) {
      std::vector<double> ratios;
      for (const OwnAnswers& own : all_) {
        const auto found = own.levels.find(intensity);
        if (found != own.levels.end()) ratios.push_back(found->second.ratio());
      }
      const Summary summary = summary_of(ratios);
      const std::optional<double> sd = summary.standard_deviation;
      table.rows.push_back({intensity, summary.mean, sd,
                            sd ? FigureCell(std::max(*summary.mean - *sd, 0.0)) : FigureCell(),
                            sd ? FigureCell(std::min(*summary.mean + *sd, 1.0)) : FigureCell(),
                            summary.num_values, static_cast<double>(pooled.num_yes),
                            static_cast<double>(pooled.num_trials)});
    }
    return table;
  }

  /// The shares over all participants together.
  [[nodiscard]] FigureTable shares_table() const {
    FigureTable table{.name = file_word(block_.block) + "_shares",
                      .columns = {"intensity", "num_yes", "num_trials", "ratio"}};
    for (const auto& [intensity, pooled] : pooled_) {
      table.rows.push_back({intensity, static_cast<double>(pooled.num_yes),
                            static_cast<double>(pooled.num_trials), pooled.ratio()});
    }
    return table;
  }

  /// The curve of the block's primary value.
  [[nodiscard]] std::optional<Curve> median_person() const {
    const Estimate* const fraction = found("weber_fraction_median_person");
    if (fraction == nullptr || !fraction->value) return std::nullopt;
    const Estimate* const pse = found("pse_median_person");
    return Curve{.weber_fraction = *fraction->value,
                 .ci95 = fraction->ci95,
                 .pse = frees_ && pse != nullptr && pse->value ? *pse->value : reference_,
                 .lapse_rate = value_or_0(found("lapse_rate"))};
  }

  /// The curve through everybody's answers. Differences between people make it flatter.
  [[nodiscard]] std::optional<Curve> group_curve() const {
    const Estimate* const fraction = found("weber_fraction");
    if (fraction == nullptr || !fraction->value) return std::nullopt;
    return Curve{.weber_fraction = *fraction->value,
                 .pse = reference_,
                 .order_effect_ln = value_or_0(found("weber_fraction_order_effect_ln"))};
  }

  void add_everybody() {
    using Look = ChartSeries::Look;
    Chart chart{.who = kEverybody};
    const std::optional<Curve> person = median_person();
    const std::optional<Curve> group = group_curve();
    const std::size_t own_table = frees_ ? kFreeCurvesTable : kCurvesTable;
    if (are_curves_a_band()) {
      set_.tables[kSpreadTable] =
          spread_table(file_word(block_.block) + "_spread_of_curves", "intensity",
                       values_by(set_.tables[own_table], "intensity", "ratio"));
      chart.series.push_back(spread_series(
          kSpreadTable, "intensity", said("middle 90 % of the participants’ own curves")));
    } else {
      for (const int series : with_curve_) {
        chart.series.push_back(curve_series(Look::kFaintCurve, own_table, series));
      }
      if (!chart.series.empty()) chart.series.back().legend = said("each participant, fitted");
    }
    if (person) {
      add_curve(set_.tables[kMedianPersonTable], {}, *person, /*has_band=*/true);
      chart.series.push_back(curve_series(Look::kBand, kMedianPersonTable));
    }
    if (person) {
      chart.series.push_back(
          curve_series(Look::kCurve, kMedianPersonTable, std::nullopt,
                       median_person_words(*found("weber_fraction_median_person"))));
    }
    if (group) {
      for (const double intensity : even_grid(set_.x.range)) {
        set_.tables[kGroupCurveTable].rows.push_back({intensity, group->ratio(intensity)});
      }
      chart.series.push_back(
          curve_series(Look::kOtherCurve, kGroupCurveTable, std::nullopt,
                       said("one curve through everybody’s answers: w = {}",
                            number_words(std::optional<double>(group->weber_fraction), 3))));
    }
    ChartSeries points =
        curve_series(Look::kManyAnswers, kPooledTable, std::nullopt, said("all answers"));
    points.size = "num_trials";
    if (block_.has_fixed_levels()) {
      points.look = Look::kAnswers;
      points.y = "mean_ratio";
      points.low = "low";
      points.high = "high";
      points.legend = said("mean ± sd");
    }
    chart.series.push_back(std::move(points));
    add_reference(chart);
    const bool has_weber_line = person && add_weber_line(chart, *person);
    add_group_value(chart);
    set_.whole = WholeFigure{.name = file_word(block_.block) + "_psychometric",
                             .title = said("Psychometric function, {}", set_.heading),
                             .caption = whole_caption(person, group, has_weber_line),
                             .thesis = said("Fig. 5, D.6 and D.23"),
                             .height_in = 3.7,
                             .has_key_above = true};
    set_.everybody = std::move(chart);
  }

  void add_group_value(Chart& chart) const {
    const Estimate* const person = found("weber_fraction_median_person");
    if (person == nullptr) {
      chart.reason = said("no value");
    } else {
      add_value(chart, person->value, person->ci95,
                in_plain_words(person->reason, person->is_separated, frees_), person->cautions,
                "w = " + fraction_words(person->value));
      if (person->value) add_word(chart.detail, "median person", " · ");
    }
    if (const Estimate* const pooled = found("weber_fraction")) {
      add_other(chart, said("curve through all answers {}{}", fraction_words(pooled->value),
                            (pooled->published
                                 ? said(" (published {})", fraction_words(pooled->published))
                                 : "")));
    }
  }

  /// What the caption says about the curves of the group.
  [[nodiscard]] std::string curves_words(const std::optional<Curve>& person,
                                         const std::optional<Curve>& group) const {
    const bool by_order = group && group->order_effect_ln != 0.0;
    std::string words;
    if (person) {
      words = said(
          "Black: the curve of the median person (hierarchical fit), whose Weber fraction, {}, "
          "is the primary value{}{}",
          with_interval(person->weber_fraction, person->ci95),
          (by_order ? said(", without anybody’s bias for an interval") : ""),
          (person->ci95.low || person->ci95.high
               ? said("; the band lies between the curves of the ends of its 95 % interval. ")
               : ". "));
    }
    if (!group) return said("{}The answers of everybody together have no curve. ", words);
    return said(
        "{}Orange, dashed: one curve through everybody’s answers ({}), w = {}: differences "
        "between people{} flatten it, so that its Weber fraction is no person’s. ",
        words,
        (by_order ? said("maximum likelihood, each order of the intervals with a point of "
                         "subjective equality of its own, drawn as the mean of both")
                  : said("least squares, point of subjective equality at the reference")),
        number_words(std::optional<double>(group->weber_fraction), 3),
        (by_order ? said(" and between the intervals") : ""));
  }

  [[nodiscard]] std::string whole_caption(const std::optional<Curve>& person,
                                          const std::optional<Curve>& group,
                                          bool has_weber_line) const {
    return said(
        "{}{} (maximum likelihood, point of subjective equality {}{}{} at each level{}Dashed, "
        "vertical: the reference, {} {}{}",
        curves_words(person, group),
        (are_curves_a_band() ? said("Grey band: at each stimulus the middle 90 % of the "
                                    "participants’ own curves, of which there are {}",
                                    std::to_string(with_curve_.size()))
                             : said("Grey: each participant’s own")),
        (frees_ ? said("free). Points: ") : said("at the reference). Points: ")),
        (block_.has_fixed_levels() ? said("mean proportion of answers “more than the "
                                          "reference” and standard deviation between ")
                                   : said("proportion of answers “more than the reference”, "
                                          "the larger a point the more answers, of ")),
        counted_words(std::ssize(all_), "participant"),
        (block_.has_fixed_levels() ? said(", cut at 0 and 1. ") : ". "),
        number_words(reference_), experiments::quantity_unit(block_.quantity),
        (has_weber_line
             ? said(". Solid, vertical: where the median person answers “more” in 84.13 %.")
             : "."));
  }

  [[nodiscard]] bool are_curves_a_band() const { return with_curve_.size() > kMostLines; }

  [[nodiscard]] std::string panels_caption() const {
    return said(
        "Proportion of answers “more than the reference”{}, and the curves of maximum "
        "likelihood, where they exist: black, with its Weber fraction w, the point of "
        "subjective equality {}{}Vertical: the reference, dashed, and where the black curve "
        "reaches 84.13 %. The values of every participant say which curves the answers reject.",
        (block_.has_fixed_levels() ? said(" with Wilson’s 95 % interval") : ""),
        (frees_ ? said("free, as the primary value has it; dashed, it is at the reference. ")
                : said("at the reference, as the primary value has it; dashed, it is free. ")),
        (has_order_effects_ ? said("Drawn is the mean of both orders of the intervals. ")
                            : ""));
  }

  [[nodiscard]] const Estimate* found(const std::string& name) const {
    return source_.results.find(block_.block + "." + name);
  }

  const FigureSource& source_;
  const BlockDesign& block_;
  bool frees_ = false;  ///< Whether the primary value has a free pse.
  double reference_ = 0.0;
  std::vector<OwnAnswers> all_;  ///< The participants who answered.
  std::map<double, LevelAnswers> pooled_;
  bool has_order_effects_ = false;
  std::vector<int> with_curve_;  ///< The series of the participants who have the primary value.
  ChartSet set_;
};

}  // namespace

std::vector<ChartSet> psychometric_charts(const FigureSource& source) {
  std::vector<ChartSet> sets;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.compares()) continue;
    PsychometricCharts charts(source, block);
    if (!charts.empty()) sets.push_back(charts.set());
  }
  return sets;
}

}  // namespace jnd::analysis
