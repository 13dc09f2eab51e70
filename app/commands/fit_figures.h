#pragma once

#include <string>
#include <vector>

#include "analysis/fits/detection_fit.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/same_different_fit.h"
#include "analysis/report/curve_figure.h"
#include "app/commands/glmm_options.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// Adds `--figure FILE` to a command that draws what it computes.
void add_figure_option(CLI::App& command, std::string& figure);

/// The answers added up at each intensity, in ascending order.
[[nodiscard]] std::vector<analysis::CurvePoint> points_of(
    const std::vector<analysis::AnswerCount>& rows);

// Fits as curves of a figure.

[[nodiscard]] analysis::DrawnCurve drawn_curve(const std::string& name,
                                               const std::vector<analysis::AnswerCount>& rows,
                                               const analysis::PsychometricFit& fit);
[[nodiscard]] analysis::DrawnCurve drawn_curve(const std::string& name,
                                               const std::vector<analysis::AnswerCount>& rows,
                                               const analysis::DetectionFit& fit);
/// `reference` is the other stimulus of every pair.
[[nodiscard]] analysis::DrawnCurve drawn_curve(const std::string& name,
                                               const std::vector<analysis::AnswerCount>& rows,
                                               const analysis::SameDifferentFit& fit,
                                               double reference);

/// Throws `core::Error` as `write_single_figure` does.
void draw_glmm(const FitGlmmOptions& options, const GlmmResult& result,
               const std::string& figure);

}  // namespace jnd::app
