#include "experiments/protocol/study_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/error.h"
#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace study_reader_test {

TEST(StudyReader, FillsTheStudyWordForWord) {
  const Study study = read_study_text(kSoundStudy, "x.json");
  EXPECT_EQ(study.format, 1);
  EXPECT_EQ(study.name, "sound");
  EXPECT_EQ(study.languages, (std::vector<std::string>{"en", "de"}));
  EXPECT_EQ(study.title.at("de"), "Heil");
  EXPECT_EQ(study.authors, (std::vector<std::string>{"A. Author"}));
  EXPECT_EQ(study.text, kSoundStudy);
  ASSERT_EQ(study.stages.size(), 4u);
  EXPECT_EQ(study.stages[1].name, "estimation");
  EXPECT_EQ(study.stages[1].line, 13);
}

TEST(StudyReader, ReadsAnEstimation) {
  const Study study = read_study_text(kSoundStudy, "x.json");
  const auto& block = std::get<Block>(study.stages[1].content);
  EXPECT_EQ(block.procedure, "magnitude_estimation");
  EXPECT_EQ(block.medium, "water");
  EXPECT_EQ(block.quantity, "scale");
  EXPECT_EQ(block.intensities, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(block.repetitions, 3);
  EXPECT_EQ(block.expected_trial_s, 20.0);
  EXPECT_FALSE(block.reference_intensity.has_value());
  EXPECT_TRUE(block.target_percent.empty());
}

TEST(StudyReader, ReadsAProductionAndAComparisonInTheirArms) {
  const Study study = read_study_text(kSoundStudy, "x.json");
  const auto& counterbalance = std::get<Counterbalance>(study.stages[2].content);
  EXPECT_EQ(counterbalance.method, Counterbalance::Method::kOrder);
  ASSERT_EQ(counterbalance.arms.size(), 2u);
  const auto& production = std::get<Block>(counterbalance.arms[0].stages[0].content);
  EXPECT_EQ(production.target_percent, (std::vector<double>{100, 50}));
  EXPECT_EQ(production.repetitions, 1);
  EXPECT_EQ(production.coarse_step, 0.5);
  EXPECT_EQ(production.fine_step, 0.1);
  EXPECT_EQ(production.max_intensity, 8.0);
  const auto& comparison = std::get<Block>(counterbalance.arms[1].stages[0].content);
  EXPECT_EQ(comparison.quantity, "viscosity_pa_s");
  EXPECT_EQ(comparison.reference_intensity, 16.0);
  ASSERT_EQ(counterbalance.between.size(), 1u);
  EXPECT_EQ(counterbalance.between[0].only_for.at("priming"), "primed");
}

TEST(StudyReader, ReadsAQuestionnaire) {
  const Study study = read_study_text(kSoundStudy, "x.json");
  const auto& items = std::get<Questionnaire>(study.stages[3].content).items;
  ASSERT_EQ(items.size(), 3u);
  EXPECT_EQ(items[0].unit, "m");
  EXPECT_EQ(items[0].minimum, 1.0);
  EXPECT_EQ(items[0].maximum, 2.5);
  EXPECT_TRUE(items[0].required);
  ASSERT_EQ(items[1].options.size(), 2u);
  EXPECT_EQ(items[1].options[1].value, "left");
  EXPECT_EQ(items[1].options[1].label.at("de"), "links");
  EXPECT_EQ(items[2].num_steps, 10);
  EXPECT_EQ(items[2].high_is_good, true);
  const auto items_of = [](const std::string& from, const std::string& to) {
    return std::get<Questionnaire>(read_study_text(broken(from, to), "x").stages[3].content)
        .items;
  };
  EXPECT_EQ(items_of("\"high_is_good\": true", "\"high_is_good\": false")[2].high_is_good,
            false);
  EXPECT_EQ(items_of(",\n        \"high_is_good\": true", "")[2].high_is_good, std::nullopt)
      << "neither end is better";
}

TEST(StudyReader, FillsInTheDefaultsOfTheTables) {
  const Study study = read_study_text(broken("\"blinding\": \"none\",", ""), "x.json");
  EXPECT_EQ(study.blinding, Blinding::kNone);
  EXPECT_EQ(study.device.min_contact_points, 5);
  EXPECT_EQ(study.device.rate_hz, 1000.0);
  EXPECT_EQ(study.device.ramp_s, 0.05);
  EXPECT_TRUE(std::isinf(study.device.immersion.radius_m));
  EXPECT_TRUE(std::isinf(study.device.immersion.depth_m));
  EXPECT_EQ(study.device.immersion.origin_z_m, 0.0);
  EXPECT_EQ(std::get<Block>(study.stages[1].content).free_space_between_s, 0.0);
}

TEST(StudyReader, ReadsTheNeedsOfTheDeviceAndTheBlinding) {
  const Study study = read_study_text(
      broken(
          "\"blinding\": \"none\"",
          "\"blinding\": \"double\", \"device\": {\"min_contact_points\": 1, \"rate_hz\": 833,"
          " \"ramp_s\": 0.1, \"immersion\": {\"radius_m\": 0.25, \"origin_z_m\": -0.1}}"),
      "x.json");
  EXPECT_EQ(study.blinding, Blinding::kDouble);
  EXPECT_EQ(study.device.min_contact_points, 1);
  EXPECT_EQ(study.device.rate_hz, 833.0);
  EXPECT_EQ(study.device.ramp_s, 0.1);
  EXPECT_EQ(study.device.immersion.radius_m, 0.25);
  EXPECT_EQ(study.device.immersion.origin_z_m, -0.1);
}

TEST(StudyReader, ReadsAContainerAndAForceMap) {
  const Study study =
      read_study_text(broken("\"blinding\": \"none\"", R"json("blinding": "none", "device": {
        "immersion": {"radius_m": 0.2, "depth_m": 0.3, "wall_stiffness_n_per_m": 800,
                      "wall_friction_ratio": 0.3},
        "force_map": [
          {"angle_of_attack_rad": 0, "speed_m_per_s": 1, "drag_coefficient": 0.3},
          {"angle_of_attack_rad": 0.8, "speed_m_per_s": 1, "drag_coefficient": 0.6,
           "lift_coefficient": 0.5},
          {"angle_of_attack_rad": 1.5708, "speed_m_per_s": 1, "drag_coefficient": 0.9}]})json"),
                      "x.json");
  EXPECT_EQ(study.device.wall_stiffness_n_per_m, 800.0);
  EXPECT_EQ(study.device.wall_friction_ratio, 0.3);
  ASSERT_EQ(study.device.force_map.size(), 3u);
  EXPECT_EQ(study.device.force_map[1].lift_coefficient, 0.5);
  EXPECT_EQ(study.device.force_map[2].lift_coefficient, 0.0);
}

TEST(StudyReader, WithoutThemThereIsNoContainerAndNoForceMap) {
  const Study study = read_study_text(kSoundStudy, "x.json");
  EXPECT_EQ(study.device.wall_stiffness_n_per_m, 0.0);
  EXPECT_TRUE(study.device.force_map.empty());
  EXPECT_EQ(std::get<Block>(study.stages[1].content).buoyancy_n, 0.0);
}

TEST(StudyReader, ReadsTheOtherFluidsAndTheirBuoyancy) {
  for (const char* medium : {"viscous_schiller_naumann", "viscous_ellipsoid"}) {
    const Study study = read_study_text(
        broken("\"medium\": \"viscous\"",
               "\"buoyancy_n\": 3.5, \"medium\": \"" + std::string(medium) + "\""),
        "x.json");
    const auto& comparison = std::get<Block>(
        std::get<Counterbalance>(study.stages[2].content).arms[1].stages[0].content);
    EXPECT_EQ(comparison.medium, medium);
    EXPECT_EQ(comparison.quantity, "viscosity_pa_s");
    EXPECT_EQ(comparison.buoyancy_n, 3.5);
  }
  const Study study =
      read_study_text(broken("\"medium\": \"water\"", "\"medium\": \"water_map\""), "x.json");
  EXPECT_EQ(std::get<Block>(study.stages[1].content).quantity, "scale");
}

TEST(StudyReader, KeepsCommentsOutOfTexts) {
  const Study study = read_study_text(
      broken("{\"en\": \"Say.\"", "{\"comment\": \"c\", \"en\": \"Say.\""), "x");
  EXPECT_EQ(std::get<Block>(study.stages[1].content).instruction.size(), 2u);
}

TEST(StudyReader, ThrowsEveryProblemAtOnce) {
  const std::string text = broken("\"format\": 1", "\"format\": 7, \"nmae\": 1");
  try {
    static_cast<void>(read_study_text(text, "x.json"));
    FAIL() << "a broken study was read";
  } catch (const ProtocolError& error) {
    EXPECT_EQ(error.problems().size(), 2u);
    EXPECT_EQ(std::string(error.what()), problems_of(text));
  }
}

TEST(StudyReader, AStudyThatWasBegunIsReadThoughABlockCannotComeToWhatItIsFor) {
  const std::string text = R"json({
    "format": 1, "name": "begun", "languages": ["en"], "title": {"en": "A"},
    "authors": ["A. Author"], "stages": [{"kind": "block", "name": "one",
    "procedure": "quest_plus", "medium": "viscous", "viscosity_pa_s": [5, 8, 12, 18],
    "reference_viscosity_pa_s": 10, "pse_viscosity_pa_s": [12, 16],
    "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
    "expected_trial_s": 5}]})json";
  EXPECT_THROW((void)read_study_text(text, "x.json"), ProtocolError);
  const Study study = read_stored_study(text, "x.study: stored protocol");
  EXPECT_EQ(std::get<Block>(study.stages.front().content).procedure, "quest_plus");
  EXPECT_THROW((void)read_stored_study(text.substr(1), "x"), ProtocolError);
}

TEST(StudyReader, TellsOfAFileThatCannotBeRead) {
  const auto none = study_problems("/no/such/study.json");
  ASSERT_EQ(none.size(), 1u);
  EXPECT_EQ(to_string(none[0]),
            "/no/such/study.json: expected a study file that can be read, found no such file");
  const auto folder = study_problems(std::filesystem::temp_directory_path());
  ASSERT_EQ(folder.size(), 1u);
  EXPECT_NE(folder[0].message.find("found a folder"), std::string::npos);
  EXPECT_THROW(static_cast<void>(read_study("/no/such/study.json")), ProtocolError);
}

TEST(StudyReader, KeepsEveryMessageShortWhateverTheFileHolds) {
  const std::string words(1000000, 'w');
  const std::string controls = "\\u001b[2J\\u0000\\u009b" + words;
  for (const std::string& junk : {words, controls}) {
    const std::string text = '"' + junk + '"';
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"\"format\": 1", "\"format\": " + text},
             {"\"format\": 1", text + ": 1"},
             {"\"sound\"", text},
             {"\"en\", \"de\"", text},
             {"{\"en\": \"Sound\", \"de\": \"Heil\"}", text},
             {"\"en\": \"Sound\"", text + ": 1"},
             {"\"none\"", text},
             {"\"water\"", text},
             {"\"kind\": \"break\"", "\"kind\": " + text},
             {"\"primed\"}", text + '}'},
             {"{\"priming\":", '{' + text + ':'},
             {"\"name\": \"unprimed\"", "\"name\": " + text},
             {"[10.5, 20]", text}}) {
      const auto problems = study_text_problems(broken(from, to), "x.json");
      EXPECT_FALSE(problems.empty()) << from;
      for (const StudyProblem& problem : problems) {
        const std::string line = to_string(problem);
        EXPECT_LT(problem.message.size(), 300u) << problem.message.substr(0, 400);
        EXPECT_LT(line.size(), 600u) << from;
        EXPECT_EQ(line.find_first_of(std::string("\0\x1B\n\xC2", 4)), line.npos) << line;
      }
    }
  }
}

TEST(StudyReader, TellsAThousandProblemsAndThatThereAreMore) {
  std::string keys;
  for (int i = 0; i < 5000; ++i) keys += "\"nonsense_" + std::to_string(i) + "\": 0,\n";
  const auto problems =
      study_text_problems(broken("\"format\": 1", keys + "\"format\": 1"), "x.json");
  ASSERT_EQ(problems.size(), 1001u);
  EXPECT_EQ(problems.back().message,
            "expected no more than 1000 problems, found more; mend these first");
}

TEST(StudyReader, NeverCrashesOnATextCutShort) {
  for (std::size_t length = 0; length < kSoundStudy.size(); ++length) {
    EXPECT_FALSE(study_text_problems(kSoundStudy.substr(0, length), "x").empty()) << length;
  }
}

TEST(StudyReader, EitherReadsOrRefusesAStudyWithAnyValueReplaced) {
  // A value of another type must be a problem or must be read, wherever it stands. It must
  // never cause a crash.
  for (const std::string value : {"null", "[]", "{}", "-1", "\"\"", "[[{}]]", "1e308"}) {
    for (std::size_t at = kSoundStudy.find(": "); at != std::string::npos;
         at = kSoundStudy.find(": ", at + 1)) {
      const std::size_t end = kSoundStudy.find_first_of(",}]\n", at + 2);
      std::string text = kSoundStudy;
      text.replace(at + 2, end - at - 2, value);
      if (study_text_problems(text, "x").empty()) {
        EXPECT_NO_THROW(static_cast<void>(read_study_text(text, "x"))) << text.substr(at, 40);
      }
    }
  }
}

TEST(StudyReader, WhatIsWrittenIsReadThoughTheRulesWouldRefuseIt) {
  // The study breaks two rules, as if the program had become stricter. Its answers must still
  // be readable.
  const std::string text = broken(R"("languages": ["en", "de"])", R"("languages": ["en"])");
  EXPECT_THROW((void)read_study_text(text, "x.json"), ProtocolError);
  const Study study = study_as_written(text, "x.json");
  EXPECT_EQ(study.title.at("de"), "Heil");
  ASSERT_EQ(study.stages.size(), 4u);
  EXPECT_EQ(std::get<Block>(study.stages[1].content).intensities.size(), 3u);
  EXPECT_EQ(study_as_written(kSoundStudy, "x.json").stages.size(), 4u);
}

TEST(StudyReader, WhatIsMissingInAWrittenStudyIsEmptyOrHasItsDefault) {
  const Study study = study_as_written(
      R"json({"name": "least", "stages": [{"kind": "block", "name": "one",
        "procedure": "constant_stimuli"}, {"kind": "questionnaire", "name": "form",
        "items": [{"name": "age"}]}]})json",
      "x.json");
  EXPECT_EQ(study.name, "least");
  EXPECT_TRUE(study.title.empty());
  EXPECT_EQ(study.device.ramp_s, 0.05);
  const auto& block = std::get<Block>(study.stages.at(0).content);
  EXPECT_EQ(block.settings.word("task"), "reminder");
  EXPECT_TRUE(block.intensities.empty());
  EXPECT_EQ(std::get<Questionnaire>(study.stages.at(1).content).items.at(0).name, "age");
}

TEST(StudyReader, WhatIsNoStudyIsRefusedInASentence) {
  for (const char* text :
       {"", "3", "[]", "{", R"({"stages": 3})", R"({"stages": [3]})", R"({"stages": [{}]})",
        R"({"stages": [{"kind": "dance"}]})", R"({"title": 3, "authors": 7})",
        R"({"stages": [{"kind": "block", "name": "b", "procedure": "guess"}]})"}) {
    EXPECT_THROW((void)study_as_written(text, "x.json"), core::Error) << text;
  }
}

TEST(StudyReader, AWrittenStudyWithAnyValueReplacedIsReadOrRefused) {
  for (const std::string value : {"null", "[]", "{}", "-1", "\"\"", "[[{}]]", "1e308"}) {
    for (std::size_t at = kSoundStudy.find(": "); at != std::string::npos;
         at = kSoundStudy.find(": ", at + 1)) {
      const std::size_t end = kSoundStudy.find_first_of(",}]\n", at + 2);
      std::string text = kSoundStudy;
      text.replace(at + 2, end - at - 2, value);
      try {
        (void)study_as_written(text, "x");
      } catch (const core::Error&) {
        // The refusal is a sentence.
      }
    }
  }
}

}  // namespace study_reader_test
}  // namespace jnd::experiments
