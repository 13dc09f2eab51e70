#include "tests/experiments/procedures/example_procedure.h"
#include "support/files.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <iterator>
#include <string>

// Tests the example of CONTRIBUTING.md, so that it compiles and does what it says.

namespace jnd::experiments {
namespace example_procedure_test {

std::string text_of(const std::string& file) {
  return test_support::read_file(test_support::source_folder() / file);
}

TEST(ExampleProcedure, StandsInContributingWordForWord) {
  const std::string header = text_of("tests/experiments/procedures/example_procedure.h");
  const std::size_t begin = header.find("class RoughThreshold");
  const std::size_t end = header.find("\n};", begin) + 3;
  ASSERT_NE(begin, header.npos);
  EXPECT_NE(text_of("CONTRIBUTING.md").find(header.substr(begin, end - begin)),
            std::string::npos)
      << "copy the class into CONTRIBUTING.md again";
}

/// Returns the last trial of a person who feels everything from `threshold` on.
AnsweredTrial last_trial(const Block& block, double threshold) {
  const RoughThreshold procedure;
  core::RandomStream stream(1, "order");
  std::vector<AnsweredTrial> answered;
  while (true) {
    const auto next = procedure.draw_next(block, answered, stream);
    if (next.empty()) return answered.back();
    for (const PlannedTrial& trial : next) {
      answered.push_back({trial, trial.intensity.value() >= threshold ? 1.0 : 0.0});
    }
  }
}

TEST(ExampleProcedure, FindsTheThresholdBetweenTwoStimuli) {
  const Block block{.intensities = {4.0, 1.0, 3.0, 2.0, 5.0}};
  EXPECT_EQ(last_trial(block, 2.5).planned.intensity, 4.0);  // 3 and 4 were felt.
  EXPECT_EQ(last_trial(block, 0.5).planned.position, 2);
  EXPECT_EQ(last_trial(block, 9.0).planned.intensity, 5.0);
}

}  // namespace example_procedure_test
}  // namespace jnd::experiments
