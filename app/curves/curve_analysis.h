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

/// What a table comes to, step by step: its answers, the curves, their comparison.
struct CurveAnalysis {
  CurveRequest request;
  analysis::AnswerFile file;  ///< Without its tallies, which are `groups`.
  std::vector<std::vector<analysis::AnswerCount>> groups;
  std::vector<std::string> names;  ///< "condition light"; "" for all rows.
  analysis::CurveOptions how;
  /// The answers fall as the intensity grows, and so does the curve, though nobody said so.
  bool found_falling = false;
  /// The answers look like right ones of a forced choice with this chance, or are those of the
  /// program's own export, and nobody said what the task was. Who asked decides before there
  /// are fits.
  std::optional<double> suspected_chance;
  bool is_suspected_by_name = false;     ///< Of the column of answers alone: `is_called_right`.
  std::vector<analysis::CurveFit> fits;  ///< One a group.
  std::optional<analysis::CurveComparison> comparison;
};

/// What a table of trials that this program exported holds in a column, as its codebook says.
enum class ExportedAnswers {
  kNone,    ///< It is no such table, or no such column.
  kYesNo,   ///< is_test_chosen, is_felt and is_called_different: no answer is right by chance.
  kRight,   ///< is_right: of a choice among two or three, which the table does not tell.
  kVaried,  ///< response: what it is depends on how the block asks.
};

/// `columns`: all of the table.
[[nodiscard]] ExportedAnswers exported_answers(const std::vector<std::string>& columns,
                                               const std::string& yes);

/// Reads the answers and settles how they are fitted. Throws `UsageError` as `require_request`
/// and `options_of`, `core::Error` as `read_answer_file`. Not real time.
[[nodiscard]] CurveAnalysis read_curves(const CurveRequest& request);

/// Fits every group. `keep_going` is told how much is done, 0 to 1, before each; what it throws
/// ends the work. Not real time.
void fit_curves(CurveAnalysis& curves, const std::function<void(double)>& keep_going = {});

/// Compares the groups. Not real time.
void add_comparison(CurveAnalysis& curves);

/// The numbers of the fits' picture: the tables `answers`, `curves` and `thresholds` of
/// `analysis::curve_figure`. None without groups.
[[nodiscard]] std::vector<analysis::FigureTable> picture_tables(const CurveAnalysis& curves);

/// Draws the picture into a new .svg, .pdf or .png. Throws `core::Error` as
/// `analysis::write_single_figure`. Not real time.
void save_picture(const CurveAnalysis& curves, const std::filesystem::path& file);

/// Writes the fits as `curves_as_csv` into a new file. Throws `core::Error` where there is one
/// of that name already, and where it cannot be written.
void save_table(const CurveAnalysis& curves, const std::filesystem::path& file);

}  // namespace jnd::app
