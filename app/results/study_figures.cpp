#include "app/results/study_figures.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "analysis/charts/figure_source.h"
#include "analysis/charts/study_titles.h"
#include "analysis/data/study_data.h"
#include "analysis/report/chart_figures.h"
#include "analysis/report/figure_files.h"
#include "analysis/report/figures.h"
#include "analysis/report/report.h"
#include "app/results/noted_export.h"
#include "app/results/results_output.h"
#include "app/session/stored_session.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/progress.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using analysis::Figure;

std::vector<Figure> box_figures(const core::StudyStore& store) {
  const analysis::StudyData data = analysis::load_study(store);
  const analysis::StudyResults results = results_of_data(data);
  const analysis::StudyTitles titles = analysis::titles_of(data.written);
  const analysis::FigureSource source{.data = data, .results = results, .titles = titles};
  std::vector<Figure> figures;
  for (auto* const make :
       {analysis::magnitude_figures, analysis::weber_figures, analysis::stroke_figures}) {
    for (Figure& figure : make(source)) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace

std::vector<analysis::ChartSet> charts_of_one(std::vector<analysis::ChartSet> charts,
                                              const std::string& who) {
  if (who == analysis::kEverybody) return charts;
  std::vector<analysis::ChartSet> own;
  for (analysis::ChartSet& set : charts) {
    const auto chart = std::ranges::find(set.participants, who, &analysis::Chart::who);
    if (chart == set.participants.end()) continue;
    analysis::WholeFigure whole;
    if (set.whole) whole = *set.whole;
    if (set.panels) {
      whole.name = set.panels->name;
      whole.title = set.panels->title;
      whole.caption = set.panels->caption;
      whole.thesis.clear();
    }
    if (whole.name.empty()) continue;
    whole.name += "_" + who;
    whole.title += ": " + who;
    set.everybody = *chart;
    set.whole = whole;
    set.panels.reset();
    own.push_back(std::move(set));
  }
  return own;
}

StudyFigures write_study_figures(const StudyFiguresRequest& request) {
  const core::StudyStore store(request.folder, core::StudyStore::Mode::kReadOnly);
  require_results_open(store);
  analysis::require_free_folder(request.out);
  const fs::path gnuplot = analysis::installed_report_tools().gnuplot;
  if (gnuplot.empty()) {
    throw core::Error(
        "expected gnuplot, which draws the figures, found none; install it (on Debian: "
        "gnuplot-nox)");
  }
  core::tell(request.on_progress, 0.05);
  const std::vector<Figure> figures =
      request.what == StudyFiguresRequest::What::kBoxes
          ? box_figures(store)
          : analysis::chart_figures(charts_of_one(request.charts, request.who));
  if (figures.empty()) throw core::Error("expected something to draw, found no figure");
  core::tell(request.on_progress, 0.4);
  const std::string forgotten = noted_export(store, request.out, "figures", /*pilot=*/false);
  std::vector<analysis::DrawnFigure> drawn;
  try {
    fs::create_directories(request.out);
    drawn =
        analysis::write_figures(figures, request.out,
                                {.simulated = request.simulated,
                                 .date_time_ns = core::SystemClock().now_ns(),
                                 .gnuplot = gnuplot,
                                 .on_progress = core::part_of(request.on_progress, 0.4, 1.0)});
  } catch (...) {
    // Removes the unfinished figures; nothing else was there before.
    std::error_code ignored;
    fs::remove_all(request.out, ignored);
    throw;
  }
  StudyFigures written;
  for (const analysis::DrawnFigure& figure : drawn) {
    if (figure.problem.empty()) {
      ++written.num_drawn;
    } else {
      written.problems.push_back(figure.name + ": " + figure.problem);
    }
  }
  if (!forgotten.empty()) written.problems.push_back(forgotten);
  return written;
}

}  // namespace jnd::app
