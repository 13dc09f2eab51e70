#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "analysis/fits/power_fit.h"
#include "analysis/fits/psychometric_fit.h"
#include "app/session/pseudonym.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/session.h"
#include "support/places.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace answer_simulator_physics_test {

using namespace experiments;

const std::filesystem::path kSource = test_support::source_folder();

/// Everybody's answers in a block, once with a device that is simulated tick by tick, and once
/// calculated.
struct Both {
  std::vector<std::pair<PlannedTrial, double>> simulated, calculated;
  double simulated_s = 0.0, calculated_s = 0.0;  ///< The time for which the stimuli were felt.
};

/// Expects that the stimuli were felt for similar times. The simulated hand lags behind the
/// arm, and the calculation neglects this, so the simulation always takes longer.
void expect_alike_felt(const Both& both) {
  EXPECT_LE(both.calculated_s, both.simulated_s);
  EXPECT_GE(both.calculated_s, 0.65 * both.simulated_s);
}

/// Returns the answers of the same persons by both methods, with the same random numbers.
std::map<std::string, Both> answers_of(const std::string& study_name, int num_participants) {
  const std::filesystem::path file = kSource / "protocols" / (study_name + ".json");
  const Study study = read_study(file);
  const Laboratory laboratory = thesis_laboratory();
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  core::StudyStore store(temporary.path() / "a.study", core::StudyStore::Mode::kCreate,
                         core::Durability::kAtClose);
  const std::vector<std::int64_t> sessions =
      add_sessions(store,
                   {.study = study,
                    .laboratory = &laboratory,
                    .study_file = file,
                    .seed = 3,
                    .record = false},
                   next_participants(store, num_participants));
  run_batch({.study = study,
             .laboratory = laboratory,
             .store = store,
             .sessions = sessions,
             .jobs = 2});
  const AnswerSimulator simulator(study, laboratory);
  std::map<std::string, Both> both;
  for (const std::int64_t session : sessions) {
    for (const core::TrialRow& trial : store.trials(session)) {
      both[trial.block].simulated.push_back({{.repetition = static_cast<int>(trial.repetition),
                                              .position = static_cast<int>(trial.position),
                                              .intensity = trial.intensity,
                                              .reference_intensity = trial.reference_intensity,
                                              .starting_intensity = trial.starting_intensity,
                                              .target_percent = trial.target_percent},
                                             trial.response.value()});
      both[trial.block].simulated_s +=
          static_cast<double>(trial.last_tick - trial.first_tick) / study.device.rate_hz;
    }
    const core::SessionRow row = store.session(session);
    const Cell cell = cell_from_text(study, row.cells);
    for (const AnsweredBlock& block : simulator.answers(stages_of(study, cell), row.seed)) {
      for (const AnsweredTrial& trial : block.trials) {
        both[block.stage->name].calculated.push_back({trial.planned, *trial.response});
      }
      both[block.stage->name].calculated_s += block.felt_s;
    }
  }
  return both;
}

double pooled_weber_fraction(const std::vector<std::pair<PlannedTrial, double>>& answers) {
  std::map<double, analysis::AnswerCount> counts;
  for (const auto& [planned, response] : answers) {
    analysis::AnswerCount& count = counts[*planned.intensity];
    count.intensity = *planned.intensity;
    count.num_yes += response > 0.5 ? 1 : 0;
    ++count.num_trials;
  }
  std::vector<analysis::AnswerCount> rows;
  for (const auto& [intensity, count] : counts) rows.push_back(count);
  return analysis::fit_psychometric(
             rows,
             {.reference = *answers.front().first.reference_intensity, .intervals = false})
      .weber_fraction.value();
}

/// Returns the exponent, which is fitted to the means on logarithmic scales. In production
/// these are the intensities at each target.
double exponent(const std::vector<std::pair<PlannedTrial, double>>& answers) {
  std::map<double, std::pair<double, int>> sums;
  for (const auto& [planned, response] : answers) {
    auto& [sum, count] = sums[planned.target_percent.value_or(planned.intensity.value_or(0.0))];
    sum += response;
    ++count;
  }
  const bool production = answers.front().first.target_percent.has_value();
  std::vector<analysis::Magnitude> rows;
  for (const auto& [x, sum] : sums) {
    const double mean = sum.first / sum.second;
    rows.push_back(production ? analysis::Magnitude{mean, x} : analysis::Magnitude{x, mean});
  }
  return analysis::fit_power(rows, analysis::PowerMethod::kLogLog).a.value();
}

TEST(AnswerSimulatorPhysics, TheSamePersonsDiscriminateAlikeWithAndWithoutADevice) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  for (const auto& [block, both] : answers_of("viscosity_discrimination", 5)) {
    SCOPED_TRACE(block);
    ASSERT_EQ(both.simulated.size(), 200U);
    ASSERT_EQ(both.calculated.size(), both.simulated.size());
    int num_alike = 0;
    for (std::size_t trial = 0; trial < both.simulated.size(); ++trial) {
      EXPECT_EQ(both.calculated[trial].first.intensity, both.simulated[trial].first.intensity);
      num_alike += both.calculated[trial].second == both.simulated[trial].second ? 1 : 0;
    }
    EXPECT_GE(num_alike, 198);
    EXPECT_NEAR(pooled_weber_fraction(both.calculated) / pooled_weber_fraction(both.simulated),
                1.0, 0.03);
    expect_alike_felt(both);
  }
}

TEST(AnswerSimulatorPhysics, TheSamePersonsEstimateAndProduceAlikeWithAndWithoutADevice) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  for (const auto& [block, both] : answers_of("magnitude_of_virtual_water", 4)) {
    SCOPED_TRACE(block);
    ASSERT_EQ(both.simulated.size(), 4U * 27U);
    ASSERT_EQ(both.calculated.size(), both.simulated.size());
    double ratio_ln = 0.0;
    int num = 0;
    for (std::size_t trial = 0; trial < both.simulated.size(); ++trial) {
      if (!(both.simulated[trial].second > 0.0 && both.calculated[trial].second > 0.0))
        continue;
      ratio_ln += std::log(both.calculated[trial].second / both.simulated[trial].second);
      ++num;
    }
    // The hand lags where strokes begin. The force of water grows with the square of the speed,
    // so a few percent are lost that are not calculated. Production has a single stroke and
    // loses more.
    EXPECT_NEAR(ratio_ln / num, 0.0, 0.10);
    EXPECT_NEAR(exponent(both.calculated), exponent(both.simulated), 0.10);
    expect_alike_felt(both);
  }
}

}  // namespace answer_simulator_physics_test
}  // namespace jnd::app
