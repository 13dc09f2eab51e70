#pragma once

#include <gtest/gtest.h>

#include "analysis/charts/figure_source.h"
#include "analysis/felt_study.h"

namespace jnd::analysis {

/// Holds the data from which the figures of `add_felt_answers` are drawn, and a staircase for
/// each of the two people.
class FeltFiguresTest : public ::testing::Test {
 protected:
  FeltFiguresTest() : study_(kFeltProtocol) {
    add_felt_answers(study_);
    data_ = load_study(study_.store());
    data_.runs.clear();  // The test makes the runs itself.
    for (const char* name : {"P01", "P02"}) {
      data_.runs.push_back(
          {.participant = name,
           .block = "felt",
           .procedure = "staircase",
           .is_logarithmic = true,
           .rule = "1 up, 2 down; Levitt 1971",
           .target_probability = 0.70711,
           .tracks = {{.series = 1,
                       .points = {{1, 0.4, true}, {2, 0.2, false, true, true}, {3, 0.4, true}},
                       .threshold = 0.2,
                       .num_reversals = 2}},
           .threshold = 0.2});
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
