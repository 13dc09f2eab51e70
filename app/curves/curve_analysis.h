#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/charts/figure_table.h"
#include "analysis/data/answer_file.h"
#include "analysis/fits/curve_comparison.h"
#include "analysis/fits/curve_fit.h"
#include "app/curves/curve_request.h"

namespace jnd::app {

/// What the program finds in a table, step by step: its answers, the curves, their comparison.
struct CurveAnalysis {
  CurveRequest request;
  /// The file without its tallies, which are in `groups`.
  analysis::AnswerFile file;
  std::vector<std::vector<analysis::AnswerCount>> groups;
  std::vector<std::string> names;  ///< Such as "condition light"; "" for all rows.
  analysis::CurveOptions how;
  /// The answers fall as the intensity grows, so the curve falls as well, although nobody asked
  /// for it.
  bool found_falling = false;
  /// The answers look like right answers of a forced choice with this chance, or come from the
  /// program's own export, and nobody said what the task was. The caller decides before
  /// anything is fitted.
  std::optional<double> suspected_chance;
  /// Only the name of the answers' column suggests it: see `is_called_right`.
  bool is_suspected_by_name = false;
  std::vector<analysis::CurveFit> fits;  ///< One for each group.
  std::optional<analysis::CurveComparison> comparison;
};

/// What a column contains in a table of trials that this program exported, as its codebook
/// says.
enum class ExportedAnswers {
  kNone,  ///< The table or the column is none of the program's.
  /// is_test_chosen, is_felt and is_called_different: no answer is right by chance.
  kYesNo,
  /// is_right: of a choice among two or three, which the table does not tell.
  kRight,
  /// response: its meaning depends on how the block asks.
  kVaried,
};

/// `columns` are all columns of the table.
[[nodiscard]] ExportedAnswers exported_answers(const std::vector<std::string>& columns,
                                               const std::string& yes);

/// Reads the answers and decides how they are fitted. Throws `UsageError` as `require_request`
/// and `options_of` do, and `core::Error` as `read_answer_file` does. Not real time.
[[nodiscard]] CurveAnalysis read_curves(const CurveRequest& request);

/// Fits every group. Before each fit, `keep_going` is told how much is done, 0 to 1; what it
/// throws ends the work. Not real time.
void fit_curves(CurveAnalysis& curves, const std::function<void(double)>& keep_going = {});

/// Compares the groups. Not real time.
void add_comparison(CurveAnalysis& curves);

/// The numbers of the fits' picture: the tables `answers`, `curves` and `thresholds` of
/// `analysis::curve_figure`. Empty if there are no groups.
[[nodiscard]] std::vector<analysis::FigureTable> picture_tables(const CurveAnalysis& curves);

/// Draws the picture into a new .svg, .pdf or .png file. Throws `core::Error` as
/// `analysis::write_single_figure` does. Not real time.
void save_picture(const CurveAnalysis& curves, const std::filesystem::path& file);

/// Writes the fits, as `curves_as_csv` makes them, into a new file. Throws `core::Error` if a
/// file of that name exists already, or if it cannot be written.
void save_table(const CurveAnalysis& curves, const std::filesystem::path& file);

}  // namespace jnd::app
