#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/charts/chart.h"

namespace jnd::app {

/// Figures of the report that somebody wants by themselves.
struct StudyFiguresRequest {
  std::filesystem::path folder;  ///< NAME.study
  std::filesystem::path out;     ///< New or empty.
  enum class What {
    kCharts,  ///< Those of `charts`.
    kBoxes,   ///< Of all participants: fractions, magnitudes, strokes, boxes among them.
  };
  What what = What::kCharts;
  std::vector<analysis::ChartSet> charts;   ///< As they are shown.
  std::string who = analysis::kEverybody;   ///< Whose charts; everybody's have panels as well.
  bool simulated = false;                   ///< Each figure says so.
  std::function<void(double)> on_progress;  ///< What it throws ends the work.
};

struct StudyFigures {
  int num_drawn = 0;
  std::vector<std::string> problems;
};

/// The charts of one participant alone, each as a figure of its own; of `kEverybody` they are
/// as they were.
[[nodiscard]] std::vector<analysis::ChartSet> charts_of_one(
    std::vector<analysis::ChartSet> charts, const std::string& who);

/// Draws them by the code of the report: NAME.svg and NAME.pdf with their data and script; the
/// study remembers where. Throws `core::Error`: double-blind, no gnuplot, nothing to draw. Not
/// real time.
[[nodiscard]] StudyFigures write_study_figures(const StudyFiguresRequest& request);

}  // namespace jnd::app
