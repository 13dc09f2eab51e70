#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "experiments/order/counterbalance.h"
#include "experiments/protocol/study_reader.h"
#include "support/places.h"

namespace jnd::experiments {
namespace shipped_studies_test {

Study shipped(const std::string& name) {
  return read_study(test_support::source_folder() / "protocols" / (name + ".json"));
}

/// Returns the first stage of this name that any cell of the study runs.
const Stage& stage_named(const Study& study, const std::string& name) {
  for (const Cell& cell : cells_of(study)) {
    for (const StageInstance& instance : stages_of(study, cell)) {
      if (instance.stage->name == name) return *instance.stage;
    }
  }
  throw core::Error("no stage " + name);
}

template <typename Content>
const Content& content_of(const Study& study, const std::string& name) {
  return std::get<Content>(stage_named(study, name).content);
}

TEST(ShippedStudies, HaveNoProblem) {
  int num_studies = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(test_support::source_folder() / "protocols")) {
    const std::filesystem::path name = entry.path().filename();
    if (name.extension() != ".json" || name.string().ends_with(".schema.json")) continue;
    ++num_studies;
    for (const StudyProblem& problem : study_problems(entry.path())) {
      ADD_FAILURE() << to_string(problem);
    }
    EXPECT_EQ(read_study(entry.path()).name, entry.path().stem());
  }
  EXPECT_EQ(num_studies, 15);
}

TEST(ShippedStudies, TellEditorsWhereTheSchemaIs) {
  for (const char* name : {"magnitude_of_virtual_water", "viscosity_discrimination",
                           "short_tour", "finger_motion"}) {
    EXPECT_NE(shipped(name).text.find("\"$schema\": \"./study.schema.json\""),
              std::string::npos)
        << name;
  }
}

TEST(ShippedStudies, SpeakEnglishAndGerman) {
  for (const char* name :
       {"magnitude_of_virtual_water", "viscosity_discrimination", "short_tour"}) {
    EXPECT_EQ(shipped(name).languages, (std::vector<std::string>{"en", "de"}));
  }
}

// The values are those of the thesis, sec. 4 and D.3.2.
TEST(ShippedStudies, EstimateAndProduceWaterAsInTheThesis) {
  const Study study = shipped("magnitude_of_virtual_water");
  const std::vector<double> factors = {0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4};
  const auto& estimation = content_of<Block>(study, "magnitude_estimation");
  EXPECT_EQ(estimation.intensities, factors);
  EXPECT_EQ(estimation.repetitions, 3);
  const auto& production = content_of<Block>(study, "magnitude_production");
  EXPECT_EQ(production.intensities, factors);
  EXPECT_EQ(production.target_percent, (std::vector<double>{100, 50, 200}));
  EXPECT_FALSE(production.max_intensity.has_value());
  EXPECT_EQ(content_of<Explore>(study, "free_space").media.at(0).duration_s, 150.0);
  EXPECT_EQ(content_of<Training>(study, "training").examples.size(), 3u);
}

// The values are those of table 1 of the thesis, with the corrections of table D.1.
TEST(ShippedStudies, CompareTheViscositiesOfTheThesis) {
  const Study study = shipped("viscosity_discrimination");
  const auto& d = content_of<Block>(study, "group_d");
  EXPECT_EQ(d.intensities,
            (std::vector<double>{1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883}));
  EXPECT_EQ(d.reference_intensity, 1.853);
  EXPECT_EQ(d.repetitions, 5);
  const auto& e = content_of<Block>(study, "group_e");
  EXPECT_EQ(e.intensities,
            (std::vector<double>{10.1, 11.58, 13.83, 14.945, 17.505, 18.95, 23.2, 29.335}));
  EXPECT_EQ(e.reference_intensity, 16.06);
  EXPECT_EQ(e.repetitions, 5);
}

TEST(ShippedStudies, GiveHalfOfTheParticipantsTheBucketOfWaterTwice) {
  const Study study = shipped("magnitude_of_virtual_water");
  for (const Cell& cell : cells_of(study)) {
    const auto stages = stages_of(study, cell);
    const auto num_buckets = std::count_if(
        stages.begin(), stages.end(),
        [](const auto& instance) { return instance.stage->name.starts_with("water_bucket"); });
    EXPECT_EQ(num_buckets, cell.at(0).arms.at(0) == "primed" ? 2 : 0) << to_string(cell);
  }
}

TEST(ShippedStudies, AskTheSevenScalesInTenStepsAndKnowTheirDirection) {
  for (const char* name : {"magnitude_of_virtual_water", "viscosity_discrimination"}) {
    const Study study = shipped(name);
    std::map<std::string, bool> high_is_good;
    for (const auto& item : content_of<Questionnaire>(study, "experience").items) {
      if (item.kind != "scale") continue;
      EXPECT_EQ(item.num_steps, 10);
      high_is_good[item.name] = item.high_is_good.value();
    }
    EXPECT_EQ(high_is_good, (std::map<std::string, bool>{{"control_ease", false},
                                                         {"control_intuitivity", false},
                                                         {"freedom", true},
                                                         {"realism", false},
                                                         {"safety", false},
                                                         {"task_ease", false},
                                                         {"task_interest", false}}));
  }
}

TEST(ShippedStudies, AskForBodyHeightAndHandednessBeforeTheFirstBlock) {
  for (const char* name : {"magnitude_of_virtual_water", "viscosity_discrimination"}) {
    const Study study = shipped(name);
    const auto stages = stages_of(study, cells_of(study).front());
    const auto about_you = std::find_if(stages.begin(), stages.end(), [](const auto& instance) {
      return instance.stage->name == "about_you";
    });
    const auto first_block =
        std::find_if(stages.begin(), stages.end(), [](const auto& instance) {
          return std::holds_alternative<Block>(instance.stage->content);
        });
    EXPECT_LT(about_you, first_block);
    const auto& items = std::get<Questionnaire>(about_you->stage->content).items;
    EXPECT_EQ(items.at(0).name, "body_height_m");
    EXPECT_EQ(items.at(1).name, "handedness");
  }
}

}  // namespace shipped_studies_test
}  // namespace jnd::experiments
