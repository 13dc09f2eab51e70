#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/charts/chart.h"

namespace jnd::app {

/// Figures of the report that somebody wants to have separately.
struct StudyFiguresRequest {
  std::filesystem::path folder;  ///< The folder NAME.study.
  std::filesystem::path out;     ///< A new or empty folder.
  enum class What {
    kCharts,  ///< The charts in `charts`.
    /// Box plots of all participants: fractions, magnitudes and strokes, for example.
    kBoxes,
  };
  What what = What::kCharts;
  std::vector<analysis::ChartSet> charts;  ///< The charts as the window shows them.
  /// Whose charts; for everybody there are panels as well.
  std::string who = analysis::kEverybody;
  bool simulated = false;                   ///< Each figure says that the data are simulated.
  std::function<void(double)> on_progress;  ///< What it throws ends the work.
};

struct StudyFigures {
  int num_drawn = 0;
  std::vector<std::string> problems;
};

/// The charts of one participant, each as a separate figure. For `kEverybody`, the charts are
/// returned unchanged.
[[nodiscard]] std::vector<analysis::ChartSet> charts_of_one(
    std::vector<analysis::ChartSet> charts, const std::string& who);

/// Draws the figures by the code of the report: NAME.svg and NAME.pdf with their data and
/// script. The study remembers where they are. Throws `core::Error` if the study is
/// double-blind, if there is no gnuplot, or if there is nothing to draw. Not real time.
[[nodiscard]] StudyFigures write_study_figures(const StudyFiguresRequest& request);

}  // namespace jnd::app
