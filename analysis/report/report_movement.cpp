#include <algorithm>

#include "analysis/data/presentation_use.h"
#include "analysis/report/explored_media.h"
#include "analysis/report/report_results.h"
#include "analysis/results/number_words.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// If at least this share is missing, a comparison may be one of selections.
constexpr double kManyMissing = 0.10;

std::string percent_words(double ratio) { return number_words(100.0 * ratio, 0) + " %"; }

/// The use of each block and interval as a whole.
std::vector<PresentationUse> by_interval(const std::vector<PresentationUse>& uses) {
  std::vector<PresentationUse> wholes;
  for (const PresentationUse& use : uses) {
    if (wholes.empty() || wholes.back().block != use.block ||
        wholes.back().interval != use.interval) {
      wholes.push_back({.block = use.block, .interval = use.interval});
    }
    wholes.back().num_presented += use.num_presented;
    wholes.back().num_used += use.num_used;
  }
  return wholes;
}

void add_cautions(HtmlTable& table, const std::vector<PresentationUse>& uses) {
  std::string where;
  for (const PresentationUse& whole : by_interval(uses)) {
    if (!(whole.missing_ratio() > kManyMissing)) continue;
    where += (where.empty() ? "" : ", ") + whole.block + " " + in_words(whole.interval) + " (" +
             percent_words(whole.missing_ratio()) + ")";
  }
  if (!where.empty()) {
    table.notes.push_back(
        said("Caution: more than 10 % hold no whole stroke in {}. Only strokes quick enough to "
             "be finished count, so slow ones drop out, and means and comparisons of these "
             "rest on a selection. “References and tests weighed equally” keeps the missing "
             "from shifting the weights of the two, not from selecting.",
             where));
  }
}

void write_uses(HtmlText& html, const StudyData& data) {
  const std::vector<PresentationUse> uses = presentation_uses(data);
  HtmlTable table{.caption = said("Presentations with a whole stroke, on which width and speed "
                                  "rest, and those presented"),
                  .columns = {{said("Block")},
                              {said("Interval")},
                              {said("Level"), true},
                              {said("Used"), true},
                              {said("Presented"), true},
                              {said("Missing"), true},
                              {said("Participants"), true},
                              {said("Width [m]"), true},
                              {said("Highest speed [m/s]"), true}}};
  for (const PresentationUse& use : uses) {
    table.rows.push_back(
        {use.block, in_words(use.interval),
         use.intensity ? shortest_words(*use.intensity) : said("as set"),
         std::to_string(use.num_used), std::to_string(use.num_presented),
         percent_words(use.missing_ratio()), std::to_string(use.num_participants),
         number_words(use.stroke_width_m, 3), number_words(use.max_speed_m_per_s, 3)});
  }
  table.notes.emplace_back(
      said("Participants: with at least one that is used. Width and speed: means over the "
           "presentations that are used."));
  add_cautions(table, uses);
  html.table(table);
}

std::string mean_words(const std::vector<double>& values) {
  const Summary summary = summary_of(values);
  std::string words = number_words(summary.mean, 3);
  if (summary.standard_deviation) words += " ± " + number_words(summary.standard_deviation, 3);
  return words;
}

void write_explored(HtmlText& html, const std::vector<ExploredMedium>& media) {
  HtmlTable table{
      .caption = said("Strokes by medium explored outside of trials, from the recordings"),
      .columns = {{said("Medium")},
                  {said("Participants"), true},
                  {said("Strokes of each"), true},
                  {said("Width [m]"), true},
                  {said("Highest speed [m/s]"), true},
                  {said("Mean speed [m/s]"), true}}};
  for (const ExploredMedium& medium : media) {
    std::vector<double> width_m, max_speed_m_per_s, mean_speed_m_per_s;
    std::string strokes;
    for (const ExploredMedium::Person& person : medium.people) {
      strokes += (strokes.empty() ? "" : ", ") + std::to_string(person.strokes.num_strokes);
      if (person.strokes.stroke_width_m) width_m.push_back(*person.strokes.stroke_width_m);
      if (person.strokes.max_speed_m_per_s) {
        max_speed_m_per_s.push_back(*person.strokes.max_speed_m_per_s);
      }
      if (person.strokes.mean_speed_m_per_s) {
        mean_speed_m_per_s.push_back(*person.strokes.mean_speed_m_per_s);
      }
    }
    if (medium.people.size() > 5) {
      const auto least = std::ranges::min_element(
          medium.people, {}, [](const auto& person) { return person.strokes.num_strokes; });
      const auto most = std::ranges::max_element(
          medium.people, {}, [](const auto& person) { return person.strokes.num_strokes; });
      strokes = said("{} to {}", std::to_string(least->strokes.num_strokes),
                     std::to_string(most->strokes.num_strokes));
    }
    table.rows.push_back({medium.title, std::to_string(medium.people.size()), strokes,
                          mean_words(width_m), mean_words(max_speed_m_per_s),
                          mean_words(mean_speed_m_per_s)});
  }
  table.notes.emplace_back(
      said("Means ± standard deviations over participants, each of all whole strokes in the "
           "medium. Width: distance between turning points; highest speed: mean over strokes "
           "of the highest in each."));
  html.table(table);
}

}  // namespace

void write_movement(HtmlText& html, const ReportSource& source, const StudyTitles& titles) {
  const std::vector<ExploredMedium> media =
      explored_media({source.data, source.results, titles}, source.movement);
  if (presentation_uses(source.data).empty()) {
    html.paragraph(source.data.blocks.empty()
                       ? said("This study has no trials, so there are no presentations to "
                              "summarise and to compare; how the hand moved is told by the "
                              "recordings of the media explored.")
                       : said("No presentation of a stimulus was stored, so nothing is known "
                              "of how the hand moved in trials."));
  }
  write_uses(html, source.data);
  write_explored(html, media);
}

}  // namespace jnd::analysis
