#include "app/curves/curve_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "analysis/fits/chance_level.h"
#include "analysis/report/curve_figure.h"
#include "analysis/report/figure_files.h"
#include "analysis/report/single_figure.h"
#include "app/command_line/command.h"
#include "app/curves/curve_table.h"
#include "core/error.h"

namespace jnd::app {
namespace {

/// The answers of all groups, on an axis whose logarithm is the curve's abscissa.
std::vector<analysis::AnswerCount> all_for_chance(
    const std::vector<std::vector<analysis::AnswerCount>>& groups,
    const analysis::CurveModel& model) {
  std::vector<analysis::AnswerCount> all;
  for (const auto& rows : groups) all.insert(all.end(), rows.begin(), rows.end());
  analysis::CurveModel plain = model;
  plain.free_guess = plain.free_lapse = plain.symmetric = plain.falling = false;
  plain.guess_rate = plain.lapse_rate = 0.0;
  constexpr std::size_t kMostLevels = 60;
  const analysis::PsychometricLevels levels =
      analysis::binned(analysis::levels_of(all, plain), kMostLevels);
  std::vector<analysis::AnswerCount> rows;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    rows.push_back({std::exp((model.falling ? -2.0 : 2.0) * levels.abscissa[i]),
                    static_cast<std::int64_t>(levels.num_yes[i]),
                    static_cast<std::int64_t>(levels.num_trials[i])});
  }
  return rows;
}

analysis::Figure figure_of(const CurveAnalysis& curves) {
  return analysis::curve_figure(curves.names, curves.fits, curves.request.intensity,
                                curves.request.yes);
}

}  // namespace

ExportedAnswers exported_answers(const std::vector<std::string>& columns,
                                 const std::string& yes) {
  constexpr std::array<std::string_view, 3> kYesNo = {"is_test_chosen", "is_felt",
                                                      "is_called_different"};
  const auto has = [&columns](std::string_view name) {
    return std::ranges::find(columns, name) != columns.end();
  };
  if (!std::ranges::all_of(kYesNo, has) || !has("is_right") || !has("reference_intensity")) {
    return ExportedAnswers::kNone;
  }
  if (std::ranges::find(kYesNo, yes) != kYesNo.end()) return ExportedAnswers::kYesNo;
  if (yes == "is_right") return ExportedAnswers::kRight;
  return yes == "response" ? ExportedAnswers::kVaried : ExportedAnswers::kNone;
}

CurveAnalysis read_curves(const CurveRequest& request) {
  require_request(request);
  CurveAnalysis curves{.request = request, .how = options_of(request)};
  curves.file = read_answers(request, !curves.how.model.is_logarithmic());
  for (analysis::AnswerGroup& group : curves.file.groups) {
    curves.groups.push_back(rows_of(group));
    curves.names.push_back(words_of(group));
    group.tallies = {};
  }
  analysis::CurveModel& model = curves.how.model;
  model.falling = request.falling || (!request.rising && analysis::answers_fall(curves.groups));
  curves.found_falling = model.falling && !request.falling;
  if (model.falling && model.symmetric && model.guess_rate > 0.0) {
    throw UsageError("--symmetric: expected without guesses for a curve that falls");
  }
  const ExportedAnswers exported = exported_answers(curves.file.columns, request.yes);
  if (request.task.empty() && request.guess.empty() && exported != ExportedAnswers::kYesNo) {
    curves.suspected_chance = analysis::suspected_chance(all_for_chance(curves.groups, model));
    constexpr double kOfThreeIntervals = 1.0 / 3.0;
    if (exported == ExportedAnswers::kRight && !curves.suspected_chance) {
      curves.suspected_chance = kOfThreeIntervals;
    }
    if (!curves.suspected_chance && analysis::is_called_right(request.yes)) {
      curves.suspected_chance = 0.5;
      curves.is_suspected_by_name = true;
    }
  }
  return curves;
}

void fit_curves(CurveAnalysis& curves, const std::function<void(double)>& keep_going) {
  curves.fits.clear();
  for (const auto& rows : curves.groups) {
    if (keep_going) {
      keep_going(static_cast<double>(curves.fits.size()) /
                 static_cast<double>(curves.groups.size()));
    }
    curves.fits.push_back(analysis::fit_curve(rows, curves.how));
  }
}

void add_comparison(CurveAnalysis& curves) {
  std::vector<analysis::ComparedGroup> compared;
  for (std::size_t i = 0; i < curves.groups.size(); ++i) {
    compared.push_back({curves.names[i], curves.groups[i]});
  }
  curves.comparison = analysis::compare_curves(compared, curves.how);
}

std::vector<analysis::FigureTable> picture_tables(const CurveAnalysis& curves) {
  return curves.fits.empty() ? std::vector<analysis::FigureTable>() : figure_of(curves).tables;
}

void save_picture(const CurveAnalysis& curves, const std::filesystem::path& file) {
  analysis::write_single_figure(figure_of(curves), file);
}

void save_table(const CurveAnalysis& curves, const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, error))) {
    throw core::Error(file.string() +
                      ": expected a name for a new table, found a file that is there already");
  }
  analysis::write_text_file(file, curves_as_csv(curves.file.groups, curves.fits));
}

}  // namespace jnd::app
