#include <algorithm>
#include <cmath>

#include "analysis/charts/chart_parts.h"
#include "analysis/charts/charts.h"
#include "analysis/charts/magnitude_data.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

using Look = ChartSeries::Look;

/// k and a of a power law, of everybody or of one participant.
struct Law {
  std::optional<double> k, a;
  Interval k_ci95, a_ci95;
  std::optional<double> published_k, published_a;
  std::string reason;  ///< Why there is no law; "" if there is one.
  std::vector<std::string> cautions;

  [[nodiscard]] bool exists() const { return k && a; }
  [[nodiscard]] std::string words() const { return exists() ? law_words(k, a) : "none"; }
};

Law law_of(const FigureSource& source, const std::string& name) {
  Law law;
  if (const Estimate* const k = source.results.find(name + ".k")) {
    law = {.k = k->value, .k_ci95 = k->ci95, .published_k = k->published, .reason = k->reason};
  }
  if (const Estimate* const a = source.results.find(name + ".a")) {
    law.a = a->value;
    law.a_ci95 = a->ci95;
    law.published_a = a->published;
    law.cautions = a->cautions;
  }
  return law;
}

Law own_law(const FigureSource& source, const std::string& block,
            const std::string& participant) {
  Law law;
  if (const auto* const k = source.own(block, participant, block + ".k")) {
    law = {.k = k->value, .k_ci95 = k->ci95, .reason = k->reason};
  }
  if (const auto* const a = source.own(block, participant, block + ".a")) {
    law.a = a->value;
    law.a_ci95 = a->ci95;
    law.cautions = a->cautions;
  }
  return law;
}

/// For example "95 % k 0.54 to 0.77, a 0.59 to 0.73 · published k = 0.66, a = 0.66".
std::string detail_of(const Law& law) {
  std::string words;
  if (law.k_ci95.low && law.k_ci95.high && law.a_ci95.low && law.a_ci95.high) {
    words = "95 % k " + interval_words(law.k_ci95, law.k) + ", a " +
            interval_words(law.a_ci95, law.a);
  }
  if (law.published_k && law.published_a) {
    words += (words.empty() ? said("published ") : said(" · published ")) +
             law_words(law.published_k, law.published_a);
  }
  return words;
}

void add_law(Chart& chart, const Law& law) {
  for (const std::string& caution : law.cautions) {
    chart.caution += (chart.caution.empty() ? "" : "; ") + caution;
  }
  if (!law.exists()) {
    chart.reason = law.reason.empty() ? said("no power law") : law.reason;
    return;
  }
  chart.value = law.words();
  chart.detail = detail_of(law);
}

/// Adds rows of a law over intensities. `first` holds the cells that stand before them, such as
/// the series.
void add_curve(FigureTable& table, const std::vector<FigureCell>& first, const Law& law,
               const AxisRange& shown) {
  if (!law.exists()) return;
  for (const double intensity : even_grid(shown)) {
    std::vector<FigureCell> row = first;
    row.insert(row.end(), {intensity, *law.k * std::pow(intensity, *law.a)});
    table.rows.push_back(std::move(row));
  }
}

ChartSeries rows_of(Look look, std::size_t table, std::optional<int> series,
                    std::string legend = "") {
  return {.look = look,
          .table = table,
          .series = series,
          .x = "intensity",
          .y = "magnitude",
          .legend = std::move(legend)};
}

ChartSeries means_of(std::size_t table, std::optional<int> series, bool along_x,
                     std::string legend) {
  ChartSeries means = rows_of(Look::kAnswers, table, series, std::move(legend));
  means.low = "low";
  means.high = "high";
  means.has_bars_along_x = along_x;
  return means;
}

/// The largest number in these columns of the tables.
double largest_of(const std::vector<const FigureTable*>& tables,
                  const std::vector<std::string>& columns) {
  double most = 0.0;
  for (const FigureTable* const table : tables) {
    for (const std::string& column : columns) {
      const std::size_t place = table->place_of(column);
      if (place >= table->columns.size()) continue;
      for (const auto& row : table->rows)
        most = std::max(most, row[place].number.value_or(0.0));
    }
  }
  return most;
}

constexpr const char* kMagnitudeTitle = said_later("Perceived magnitude (modulus = 1)");

ChartAxis magnitude_axis() {
  return {.title = said(kMagnitudeTitle), .label = said("magnitude, the modulus being 1")};
}

/// The figures 4a and b, D.3, D.9, D.12 and D.14: everybody's means, the group's means, and its
/// power law.
ChartSet curves_of(const FigureSource& source, const MagnitudeData& data) {
  constexpr std::size_t kOwn = 0, kGroup = 1, kCurve = 2, kOwnCurves = 3;
  const std::string name = file_word(data.block);
  ChartSet set{.section = data.block,
               .heading = data.title,
               .x = quantity_chart_axis(data.quantity, said("intensity,")),
               .y = magnitude_axis(),
               .tables = {own_means_table(data),
                          group_means_table(data),
                          {.name = name + "_curve", .columns = {"intensity", "magnitude"}},
                          {.name = name + "_own_curves",
                           .columns = {"series", "participant", "intensity", "magnitude"}}}};
  if (data.is_production) set.x.title += said(", as set");
  const std::vector<const FigureTable*> means = {&set.tables[kOwn], &set.tables[kGroup]};
  const double most = largest_of(means, {"intensity"});
  const AxisRange shown{0.0, most > 0.0 ? 1.04 * most : 1.0};
  set.x.range = {-0.02 * shown.high, shown.high};
  const Law law = law_of(source, data.block);
  add_curve(set.tables[kCurve], {}, law, shown);

  Chart everybody{.who = kEverybody};
  add_law(everybody, law);
  for (std::size_t i = 0; i < data.participants.size(); ++i) {
    const std::string& who = data.participants[i].participant;
    const auto series = static_cast<int>(i) + 1;
    const Law own = own_law(source, data.block, who);
    add_curve(set.tables[kOwnCurves], {series, who}, own, shown);
    Chart chart{.who = who};
    add_law(chart, own);
    if (own.exists()) chart.series.push_back(rows_of(Look::kCurve, kOwnCurves, series));
    chart.series.push_back(means_of(kOwn, series, data.is_production, ""));
    set.participants.push_back(std::move(chart));
    everybody.series.push_back(
        rows_of(Look::kEverybodys, kOwn, series, i == 0 ? "participants" : ""));
  }
  if (law.exists()) {
    everybody.series.push_back(
        rows_of(Look::kCurve, kCurve, std::nullopt, said("power law, {}", law.words())));
  }
  everybody.series.push_back(
      means_of(kGroup, std::nullopt, data.is_production, said("mean ± sd")));
  set.everybody = std::move(everybody);
  std::vector<const FigureTable*> drawn = means;
  drawn.push_back(&set.tables[kCurve]);
  set.y.range = {
      0.0,
      1.05 * std::max(largest_of(drawn, data.is_production
                                            ? std::vector<std::string>{"magnitude"}
                                            : std::vector<std::string>{"magnitude", "high"}),
                      0.1)};
  set.whole = WholeFigure{
      .name = name + "_curves",
      .title = said("{}: means and power law", data.title),
      .caption =
          said("{}: means of each of {} (grey), mean and standard deviation between them "
               "(squares), and the power law through these means{}",
               std::string(data.is_production
                               ? said("Intensities that were set for each magnitude asked for")
                               : said("Magnitudes that were told at each intensity")),
               counted_words(std::ssize(data.participants), "participant"),
               (law.exists() ? said(", S = k Iᵃ with {}.", law.words())
                             : said(", which does not exist here."))),
      .thesis = data.is_production ? said("Fig. 4b, D.3, D.12 and D.14")
                                   : said("Fig. 4a, D.3, D.9 and D.14"),
      .height_in = 3.3};
  return set;
}

const BlockDesign* only_block(const StudyData& data, bool (BlockDesign::*measure)() const) {
  const BlockDesign* found = nullptr;
  for (const BlockDesign& block : data.blocks) {
    if (!(block.*measure)()) continue;
    if (found != nullptr) return nullptr;
    found = &block;
  }
  return found;
}

/// Estimation, production, and the law between them.
class LawsChart {
 public:
  LawsChart(const FigureSource& source, const BlockDesign& estimation,
            const BlockDesign& production)
      : source_(source),
        estimated_(magnitude_data(source, estimation)),
        produced_(magnitude_data(source, production)) {
    set_.tables = {group_means_table(estimated_), group_means_table(produced_),
                   own_means_table(estimated_),   own_means_table(produced_),
                   curve_table("estimation"),     curve_table("production"),
                   curve_table("combined")};
    set_.tables.push_back({.name = "power_law_own_estimation", .columns = kOwnColumns});
    set_.tables.push_back({.name = "power_law_own_production", .columns = kOwnColumns});
  }

  [[nodiscard]] bool empty() const {
    return set_.tables[kEstimated].rows.empty() || set_.tables[kProduced].rows.empty() ||
           !(measured().high > 0.0) ||
           (!law_of(source_, estimated_.block).exists() &&
            !law_of(source_, produced_.block).exists());
  }

  [[nodiscard]] ChartSet set() {
    const double most = measured().high;
    shown_ = {most / 200.0, 1.05 * most};
    set_.section = "combined";
    set_.heading = said("Estimation and production");
    set_.x = quantity_chart_axis(estimated_.quantity, said("intensity,"));
    set_.y = magnitude_axis();
    set_.x.logarithmic = set_.y.logarithmic = true;
    add_everybody();
    for (const std::string& participant : source_.participants()) add_participant(participant);
    const AxisRange least = least_above_zero();
    set_.x.range = {least.low / 1.6, 1.15 * most};
    set_.y.range = {least.high / 1.6, 1.05 * largest_magnitude()};
    set_.whole = WholeFigure{
        .name = "power_laws",
        .title = said("Estimation, production and the law between them"),
        .caption =
            said("Power laws through the means of estimation and of production, and the one "
                 "between both curves, on linear (left) and logarithmic axes (right). Marks: "
                 "means over participants. Dotted: beyond the intensities that were measured."),
        .thesis = said("Fig. 4c, D.4 and D.15"),
        .width_in = 6.6,
        .height_in = 3.7,
        .has_linear_beside = true};
    return std::move(set_);
  }

 private:
  static constexpr std::size_t kEstimated = 0, kProduced = 1, kOwnEstimated = 2,
                               kOwnProduced = 3, kEstimationLaw = 4, kProductionLaw = 5,
                               kCombinedLaw = 6, kOwnEstimationLaws = 7, kOwnProductionLaws = 8;
  static constexpr int kEstimationColour = 1, kProductionColour = 2, kCombinedColour = 5;
  inline static const std::vector<std::string> kOwnColumns = {"series", "participant",
                                                              "intensity", "magnitude"};

  static FigureTable curve_table(const std::string& name) {
    return {.name = "power_law_" + name, .columns = {"intensity", "magnitude", "extrapolated"}};
  }

  /// The lowest and highest intensity of the group's means.
  [[nodiscard]] AxisRange ends_of(std::size_t table) const {
    AxisRange ends{0.0, 0.0};
    bool is_first = true;
    for (const auto& row : set_.tables[table].rows) {
      const double intensity = row.front().number.value_or(0.0);
      ends.low = is_first ? intensity : std::min(ends.low, intensity);
      ends.high = is_first ? intensity : std::max(ends.high, intensity);
      is_first = false;
    }
    return ends;
  }
  [[nodiscard]] AxisRange measured() const {
    const AxisRange first = ends_of(kEstimated), second = ends_of(kProduced);
    return {std::min(first.low, second.low), std::max(first.high, second.high)};
  }

  /// The smallest means above 0, at which logarithmic axes begin: `low` is that of intensities,
  /// and `high` that of magnitudes.
  [[nodiscard]] AxisRange least_above_zero() const {
    AxisRange least{0.0, 0.0};
    const auto take = [](double& smallest, const FigureCell& cell) {
      const double value = cell.number.value_or(0.0);
      if (value > 0.0 && (smallest == 0.0 || value < smallest)) smallest = value;
    };
    for (const std::size_t table : {kEstimated, kProduced}) {
      for (const auto& row : set_.tables[table].rows) {
        if (row[0].number.value_or(0.0) > 0.0) take(least.high, row[1]);
        take(least.low, row[0]);
      }
    }
    return {least.low > 0.0 ? least.low : 0.1, least.high > 0.0 ? least.high : 0.1};
  }
  [[nodiscard]] double largest_magnitude() const {
    std::vector<const FigureTable*> drawn;
    for (const std::size_t table :
         {kEstimated, kProduced, kEstimationLaw, kProductionLaw, kCombinedLaw}) {
      drawn.push_back(&set_.tables[table]);
    }
    return std::max(largest_of(drawn, {"magnitude"}), 0.1);
  }

  void add_group_law(Chart& chart, const Law& law, std::size_t table, const AxisRange& measured,
                     int colour, const std::string& name) {
    if (!law.exists()) return;
    for (const double intensity : even_grid(shown_)) {
      const bool is_outside = intensity < measured.low || intensity > measured.high;
      set_.tables[table].rows.push_back(
          {intensity, *law.k * std::pow(intensity, *law.a), is_outside ? 1 : 0});
    }
    ChartSeries series = rows_of(Look::kLaw, table, std::nullopt, name + ": " + law.words());
    series.colour = colour;
    ChartSeries beyond = series;
    beyond.look = Look::kBeyond;
    beyond.series_column = "extrapolated";
    beyond.series = 1;
    beyond.legend.clear();
    chart.series.push_back(std::move(beyond));
    series.series_column = "extrapolated";
    series.series = 0;
    chart.series.push_back(std::move(series));
  }

  void add_everybody() {
    Chart chart{.who = kEverybody};
    const Law estimation = law_of(source_, estimated_.block);
    const Law production = law_of(source_, produced_.block);
    const Law combined = law_of(source_, "combined");
    add_group_law(chart, estimation, kEstimationLaw, ends_of(kEstimated), kEstimationColour,
                  "estimation");
    add_group_law(chart, production, kProductionLaw, ends_of(kProduced), kProductionColour,
                  "production");
    add_group_law(chart, combined, kCombinedLaw, measured(), kCombinedColour, "between");
    add_means(chart, kEstimated, std::nullopt, kEstimationColour);
    add_means(chart, kProduced, std::nullopt, kProductionColour);
    add_law(chart, combined);
    if (!combined.exists()) chart.reason = said("estimation or production has no power law");
    set_.everybody = std::move(chart);
  }

  static void add_means(Chart& chart, std::size_t table, std::optional<int> series,
                        int colour) {
    ChartSeries means = rows_of(Look::kMeans, table, series);
    means.colour = colour;
    chart.series.push_back(std::move(means));
  }

  void add_participant(const std::string& who) {
    Chart chart{.who = who};
    std::string words;
    const auto add = [&](const MagnitudeData& data, std::size_t means, std::size_t laws,
                         int colour, const std::string& name) {
      const auto own =
          std::ranges::find(data.participants, who, &MagnitudeData::Own::participant);
      if (own == data.participants.end()) return;
      const auto series = static_cast<int>(own - data.participants.begin()) + 1;
      const Law law = own_law(source_, data.block, who);
      if (law.exists()) {
        add_curve(set_.tables[laws], {series, who}, law, shown_);
        ChartSeries curve = rows_of(Look::kLaw, laws, series, name);
        curve.colour = colour;
        chart.series.push_back(std::move(curve));
        words += (words.empty() ? "" : " · ") + name + " " + law.words();
      } else if (chart.reason.empty()) {
        chart.reason = name + ": " + (law.reason.empty() ? said("no power law") : law.reason);
      }
      add_means(chart, means, series, colour);
    };
    add(estimated_, kOwnEstimated, kOwnEstimationLaws, kEstimationColour, "estimation");
    add(produced_, kOwnProduced, kOwnProductionLaws, kProductionColour, "production");
    if (chart.series.empty()) return;
    chart.value = words;
    set_.participants.push_back(std::move(chart));
  }

  const FigureSource& source_;
  MagnitudeData estimated_, produced_;
  AxisRange shown_{0.0, 1.0};
  ChartSet set_;
};

}  // namespace

std::vector<ChartSet> magnitude_charts(const FigureSource& source) {
  std::vector<ChartSet> sets;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.estimates() && !block.produces()) continue;
    const MagnitudeData data = magnitude_data(source, block);
    if (!data.participants.empty()) sets.push_back(curves_of(source, data));
  }
  const BlockDesign* const estimation = only_block(source.data, &BlockDesign::estimates);
  const BlockDesign* const production = only_block(source.data, &BlockDesign::produces);
  if (estimation == nullptr || production == nullptr) return sets;
  LawsChart laws(source, *estimation, *production);
  if (!laws.empty()) sets.push_back(laws.set());
  return sets;
}

}  // namespace jnd::analysis
