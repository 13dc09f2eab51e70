#include "analysis/report/report.h"

#include <algorithm>
#include <set>

#include "analysis/charts/charts.h"
#include "analysis/charts/study_titles.h"
#include "analysis/report/chart_figures.h"
#include "analysis/report/explored_media.h"
#include "analysis/report/figures.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

/// The time when the newest session began, which is the date of the files.
std::int64_t date_of(const ReportSource& source) {
  std::int64_t newest_ns = 0;
  for (const core::SessionRow& session : source.store.sessions()) {
    if (session.pilot && !source.pilot) continue;
    newest_ns = std::max(newest_ns, session.started_time_ns);
  }
  return newest_ns;
}

}  // namespace

std::vector<Figure> figures_of(const ReportSource& source) {
  const StudyTitles titles = titles_of(source.data.written);
  const FigureSource from{.data = source.data, .results = source.results, .titles = titles};
  std::vector<Figure> figures;
  std::set<std::string> names;
  const auto add = [&](std::vector<Figure> more) {
    for (Figure& figure : more) {
      if (names.insert(figure.name).second) figures.push_back(std::move(figure));
    }
  };
  if (source.delivered != nullptr) {
    add(delivered_figures(source.results, *source.delivered, titles));
  }
  add(published_figures(from));
  add(chart_figures(charts_of(from)));
  add(magnitude_figures(from));
  add(weber_figures(from));
  add(stroke_figures(from));
  add(explored_figures(from, source.movement));
  add(recording_figures(from, source.movement));
  return figures;
}

ReportOutcome write_report(const ReportSource& source, const fs::path& folder,
                           const ReportOptions& options) {
  return write_document({.figures = figures_of(source),
                         .simulated = source.results.simulated,
                         .date_time_ns = date_of(source),
                         .html =
                             [&source](const std::vector<Figure>& figures,
                                       const std::vector<DrawnFigure>& drawn) {
                               return report_html(source, figures, drawn);
                             },
                         .supplement =
                             [&source](const std::vector<Figure>& figures,
                                       const std::vector<DrawnFigure>& drawn) {
                               return supplement_html(source, figures, drawn);
                             }},
                        folder, options);
}

}  // namespace jnd::analysis
