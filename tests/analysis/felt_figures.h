#pragma once

#include <gtest/gtest.h>

#include "analysis/charts/figure_source.h"
#include "analysis/felt_study.h"

namespace jnd::analysis {

/// The data for figures of `add_felt_answers`, with a staircase for each of the two people.
class FeltFiguresTest : public ::testing::Test {
 protected:
  FeltFiguresTest() : study_(kFeltProtocol) {
    add_felt_answers(study_);
    data_ = load_study(study_.store());
    data_.runs.clear();  // The runs are made by hand instead.
    for (const char* name : {"P01", "P02"}) {
      AdaptiveRun run{.participant = name, .block = "felt", .procedure = "staircase"};
      run.is_logarithmic = true;
      run.rule = "1 up, 2 down; Levitt 1971";
      run.target_probability = 0.70711;
      run.tracks = {{.series = 1,
                     .points = {{1, 0.4, true}, {2, 0.2, false, true, true}, {3, 0.4, true}},
                     .threshold = 0.2,
                     .num_reversals = 2}};
      run.threshold = 0.2;
      data_.runs.push_back(run);
    }
    results_ = results_of(data_, {}, {.num_resamples = 50});
  }
  [[nodiscard]] FigureSource source() const { return {data_, results_, titles_}; }

  HandMadeStudy study_;
  StudyData data_;
  StudyResults results_;
  StudyTitles titles_;
};

}  // namespace jnd::analysis
