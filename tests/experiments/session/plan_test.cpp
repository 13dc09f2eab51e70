#include "experiments/session/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/clock.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/event.h"
#include "experiments/session/session_in_memory.h"
#include "support/temporary_folder.h"

namespace jnd::experiments {
namespace plan_test {

const std::string kStudy = R"json({
  "format": 1, "name": "planned", "languages": ["en"], "title": {"en": "Planned"},
  "authors": ["A. Author"],
  "stages": [
    {"kind": "checklist", "name": "before", "items": [
      {"text": {"en": "One."}}, {"text": {"en": "Two."}}]},
    {"kind": "explore", "name": "explore", "instruction": {"en": "Feel."}, "media": [
      {"medium": "free_space", "duration_s": 30}, {"medium": "water", "scale": 4, "duration_s": 10}]},
    {"kind": "counterbalance", "name": "method_order", "method": "order",
     "arms": [
       {"name": "estimation", "stages": [
         {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
          "medium": "water", "scale": [0, 1, 4], "repetitions": 3,
          "instruction": {"en": "Say."}, "question": {"en": "How?"},
          "free_space_between_s": 2, "expected_trial_s": 18}]},
       {"name": "comparison", "stages": [
         {"kind": "block", "name": "comparison", "procedure": "constant_stimuli",
          "medium": "viscous", "viscosity_pa_s": [10, 30], "reference_viscosity_pa_s": 16,
          "repetitions": 5, "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
          "expected_trial_s": 15}]}],
     "between": [{"kind": "break", "name": "rest", "instruction": {"en": "Rest."}, "duration_s": 60}]},
    {"kind": "post_experiment", "name": "after", "items": [
      {"name": "is_solid", "medium": "solid", "stiffness_n_per_m": 1000,
       "instruction": {"en": "Touch."}, "question": {"en": "Solid?"}, "answer": "yes_no"}]}
  ]
})json";

std::vector<std::string> participants(int count) {
  std::vector<std::string> names;
  for (int i = 1; i <= count; ++i) names.push_back("P" + std::to_string(i));
  return names;
}

TEST(Plan, FillsTheCellsEvenly) {
  const Study study = read_study_text(kStudy, "x");
  std::map<std::string, int> starts;
  for (const auto& plan :
       plan_participants(study, {.participants = participants(13), .seed = 3})) {
    ++starts[to_string(plan.cell)];
  }
  EXPECT_EQ(starts.size(), 2u);
  EXPECT_EQ(std::abs(starts.begin()->second - starts.rbegin()->second), 1);
}

TEST(Plan, GoesOnWhereTheStudyFolderStands) {
  const Study study = read_study_text(kStudy, "x");
  const auto plans =
      plan_participants(study, {.participants = participants(2),
                                .seed = 3,
                                .num_earlier_sessions = 2,
                                .completed = {"method_order=estimation,comparison",
                                              "method_order=estimation,comparison"}});
  ASSERT_EQ(plans.size(), 2u);
  EXPECT_EQ(plans[1].participant, "P2");
  for (const auto& plan : plans) {
    EXPECT_EQ(to_string(plan.cell), "method_order=comparison,estimation");
  }
}

/// Expects that sessions of these participants draw what was planned.
void expect_orders_as_planned(const Study& study) {
  for (const auto& plan :
       plan_participants(study, {.participants = participants(4), .seed = 9})) {
    std::vector<const Stage*> stages;
    for (const StageInstance& instance : plan.stages) stages.push_back(instance.stage);
    MemoryLog log;
    const core::SimulatedClock clock;
    Session session({.session = 1,
                     .seed = session_seed(9, study.name, plan.participant),
                     .stages = stages,
                     .cell = plan.cell},
                    {}, log, clock);
    session.start();
    std::int64_t tick = 0;
    while (session.current_stage() != nullptr) {
      session.enter_stage();
      while (session.state().current_trial()) {
        session.start_trial(tick);
        session.begin_presentation("test", tick);
        session.end_presentation(tick += 10, {});
        session.answer(1.0, {.response_time_s = 1.0}, tick);
        tick += 1;
      }
      session.finish_stage();
    }
    std::vector<std::optional<double>> planned, drawn;
    for (const PlannedBlock& block : plan.blocks) {
      for (const PlannedTrial& trial : block.trials) planned.push_back(trial.intensity);
    }
    for (const core::DesignRow& row : log.design) drawn.push_back(row.intensity);
    EXPECT_EQ(planned.size(), 19u);
    EXPECT_EQ(planned, drawn);
  }
}

TEST(Plan, ForetellsTheVeryOrdersThatTheSessionDraws) {
  expect_orders_as_planned(read_study_text(kStudy, "x"));
}

/// Returns a study in which the stimuli of the estimation come in rows of a square.
std::string study_with_a_square() {
  const std::string repetitions = "\"repetitions\": 3,";
  std::string text = kStudy;
  return text.replace(text.find(repetitions), repetitions.size(),
                      repetitions + R"( "order": {"method": "latin"},)");
}

TEST(Plan, ForetellsTheRowsOfSquaresToo) {
  const Study study = read_study_text(study_with_a_square(), "x");
  expect_orders_as_planned(study);
  std::map<double, int> firsts;
  for (const auto& plan :
       plan_participants(study, {.participants = participants(6), .seed = 9})) {
    for (const PlannedBlock& block : plan.blocks) {
      if (block.stage->name == "estimation") ++firsts[block.trials[0].intensity.value()];
    }
  }
  EXPECT_EQ(firsts, (std::map<double, int>{{0.0, 2}, {1.0, 2}, {4.0, 2}}));
}

TEST(Plan, GivesEveryParticipantAnOrderOfTheirOwn) {
  const Study study = read_study_text(kStudy, "x");
  const auto plans = plan_participants(study, {.participants = participants(2), .seed = 3});
  const auto order_of = [](const ParticipantPlan& plan) {
    std::vector<double> order;
    for (const PlannedBlock& block : plan.blocks) {
      if (block.stage->name != "comparison") continue;
      for (const PlannedTrial& trial : block.trials) order.push_back(*trial.intensity);
    }
    return order;
  };
  EXPECT_NE(order_of(plans[0]), order_of(plans[1]));
}

TEST(Plan, CountsCompletedSessionsAndNeitherPilotsNorDropOuts) {
  const test_support::TemporaryFolder folder;
  core::StudyStore store(folder.path() / "a.study", core::StudyStore::Mode::kCreate,
                         core::Durability::kAtClose);
  const std::string hash = store.add_protocol("x.json", kStudy);
  const auto add = [&](const std::string& cells, bool pilot, std::optional<bool> ended) {
    core::SessionRow row;
    row.participant = "P" + std::to_string(store.sessions().size());
    row.protocol_sha256 = hash;
    row.cells = cells;
    row.pilot = pilot;
    const std::int64_t session = store.add_session(row);
    core::Commit started, stopped;
    started.event =
        row_from_event(session, {.sequence = 1, .time_ns = 0, .data = SessionStarted{}});
    store.append(started);
    if (!ended) return;
    const EventData end =
        *ended ? EventData(SessionCompleted{}) : EventData(SessionEndedEarly{});
    stopped.event = row_from_event(session, {.sequence = 2, .time_ns = 0, .data = end});
    store.append(stopped);
  };
  add("o=a,b", false, true);
  add("o=b,a", false, false);
  add("o=b,a", true, true);
  add("o=b,a", false, std::nullopt);
  add("o=a,b", false, true);
  EXPECT_EQ(completed_cells(store), (std::vector<std::string>{"o=a,b", "o=a,b"}));
}

TEST(Plan, AddsUpTheExpectedDuration) {
  // There are 2 points of a checklist, 40 s of exploring, 9 trials of 20 s, 10 of 15 s, a break
  // of 60 s, and one item afterwards.
  const ExpectedTimes times;
  const Study study = read_study_text(kStudy, "x");
  const ParticipantPlan plan =
      plan_participants(study, {.participants = participants(1)}).at(0);
  EXPECT_DOUBLE_EQ(plan.longest_duration_s, plan.duration_s) << "nothing adapts";
  EXPECT_DOUBLE_EQ(plan.duration_s, 2 * times.checklist_item_s + 40.0 + 9 * 20.0 + 10 * 15.0 +
                                        60.0 + times.post_experiment_item_s);
}

TEST(Plan, PutsEveryStimulusAgainstTheLimits) {
  const auto range = planned_range(read_study_text(kStudy, "x"), {.max_force_per_point_n = 10.0,
                                                                  .max_total_force_n = 40.0,
                                                                  .expected_speed_m_per_s = 1.0,
                                                                  .expected_depth_m = 0.01});
  const auto entry = [&](const std::string& stage, double intensity) {
    const auto found = std::find_if(range.begin(), range.end(), [&](const RangeEntry& e) {
      return e.stage == stage && e.setting.intensity == intensity;
    });
    return found == range.end() ? RangeEntry{} : *found;
  };
  EXPECT_EQ(range.size(), 2u + 3u + 3u + 1u);

  // Water, with the hand head on at 1 m/s, takes 6.585 N (thesis, B.4), and four times that
  // with scale 4.
  EXPECT_NEAR(entry("estimation", 1).total_force_n, 6.585, 1e-3);
  EXPECT_NEAR(entry("explore", 4).total_force_n, 4 * 6.58526, 1e-4);
  EXPECT_TRUE(entry("estimation", 4).fits);
  // 10 N at the palm, which bears 35 %, is 28.571 N in all, so the speed is sqrt(28.571 /
  // 26.341) m/s.
  EXPECT_NEAR(entry("estimation", 4).fits_up_to_m_per_s.value(), 1.04147, 1e-4);

  // 1.776 m * 16 Pa s * 1 m/s = 28.416 N is just within the limits, and 30 Pa s is not.
  EXPECT_NEAR(entry("comparison", 16).total_force_n, 28.416, 1e-9);
  EXPECT_NEAR(entry("comparison", 16).largest_point_force_n, 9.9456, 1e-9);
  EXPECT_TRUE(entry("comparison", 16).fits);
  EXPECT_FALSE(entry("comparison", 30).fits);
  EXPECT_NEAR(entry("comparison", 30).fits_up_to_m_per_s.value(), 10.0 / 0.35 / 53.28, 1e-9);

  EXPECT_EQ(entry("estimation", 0).total_force_n, 0.0);
  EXPECT_FALSE(entry("estimation", 0).fits_up_to_m_per_s.has_value());
  EXPECT_NEAR(entry("after", 1000).total_force_n, 10.0, 1e-12);
  EXPECT_FALSE(entry("after", 1000).fits_up_to_m_per_s.has_value());
}

TEST(Plan, PutsTheOtherMediaAgainstTheLimitsToo) {
  const auto most = [](const std::string& medium, const std::string& device) {
    std::string text = kStudy;
    const std::string from = R"("medium": "water", "scale": 4)";
    text.replace(text.find(from), from.size(), medium);
    if (!device.empty()) text.insert(text.find("\"stages\""), "\"device\": " + device + ", ");
    return planned_range(read_study_text(text, "x"), {.max_force_per_point_n = 10.0,
                                                      .max_total_force_n = 40.0,
                                                      .expected_speed_m_per_s = 1.0})
        .at(1);
  };
  // Worked by hand: Re = 10, 17.76 N (1 + 0.15 10^0.687).
  EXPECT_NEAR(
      most(R"("medium": "viscous_schiller_naumann", "viscosity_pa_s": 10)", "").total_force_n,
      17.76 * (1.0 + 0.15 * std::pow(10.0, 0.687)), 1e-9);
  const RangeEntry ellipsoid =
      most(R"("medium": "viscous_ellipsoid", "viscosity_pa_s": 10)", "");
  EXPECT_NEAR(ellipsoid.total_force_n * ellipsoid.fits_up_to_m_per_s.value(), 10.0 / 0.35,
              1e-9);
  EXPECT_NEAR(most(R"("medium": "water", "scale": 1, "buoyancy_n": 4)", "").total_force_n,
              6.58526 + 4.0, 1e-4);
  // With lift, the largest force is not head on: 7.4 hypot(1, 3) at 0.8 rad.
  EXPECT_NEAR(most(R"("medium": "water_map", "scale": 1)", R"({"force_map": [
      {"angle_of_attack_rad": 0, "speed_m_per_s": 1, "drag_coefficient": 1},
      {"angle_of_attack_rad": 0.785, "speed_m_per_s": 1, "drag_coefficient": 1, "lift_coefficient": 3},
      {"angle_of_attack_rad": 1.571, "speed_m_per_s": 1, "drag_coefficient": 1}]})")
                  .total_force_n,
              7.4 * std::hypot(1.0, 3.0), 0.05);
}

TEST(Plan, FewerPointsHaveLargerShares) {
  const auto largest_n = [](int num_points) {
    const auto range =
        planned_range(read_study_text(kStudy, "x"),
                      {.max_force_per_point_n = 10.0,
                       .max_total_force_n = 40.0,
                       .largest_share_ratio = core::area_shares_of_first(num_points)[0],
                       .expected_speed_m_per_s = 1.0});
    const auto found = std::find_if(range.begin(), range.end(), [](const RangeEntry& e) {
      return e.stage == "comparison" && e.setting.intensity == 16.0;
    });
    EXPECT_EQ(found->fits, num_points == 5) << num_points;
    return found->largest_point_force_n;
  };
  // The whole force is 28.416 N. The inner point of the palm bears .35 of what all points bear.
  EXPECT_NEAR(largest_n(5), 9.9456, 1e-9);
  EXPECT_NEAR(largest_n(3), 28.416 * 0.35 / 0.8, 1e-9);
  EXPECT_NEAR(largest_n(2), 14.208, 1e-9);
  EXPECT_NEAR(largest_n(1), 28.416, 1e-9);
}

TEST(Plan, NamesTheTotalLimitWhereItIsTheTighterOne) {
  const auto range =
      planned_range(read_study_text(kStudy, "x"),
                    {.max_force_per_point_n = 100.0, .max_total_force_n = 5.328});
  const auto thick = std::find_if(range.begin(), range.end(), [](const RangeEntry& e) {
    return e.setting.intensity == 30.0;
  });
  ASSERT_NE(thick, range.end());
  EXPECT_FALSE(thick->fits);
  EXPECT_NEAR(thick->fits_up_to_m_per_s.value(), 0.1, 1e-9);
}

}  // namespace plan_test
}  // namespace jnd::experiments
