#include "analysis/export/csv_export.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <locale>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/data/csv_table.h"
#include "analysis/hand_made_study.h"
#include "core/error.h"
#include "core/storage/recording.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::analysis {
namespace csv_export_test {

namespace fs = std::filesystem;
using test_support::read_file;

class CsvExportTest : public ::testing::Test {
 protected:
  CsvExportTest() {
    study_.add("P01");
    (void)study_.answer({.block = "a \"quoted\", block",
                         .procedure = "constant_stimuli",
                         .quantity = "viscosity_pa_s",
                         .repetition = 1,
                         .intensity = kAwkward,
                         .reference_intensity = 8.0,
                         .response = 1.0,
                         .measures = {.response_time_s = 1.5e-7}});
    study_.move({.presentation = 1,
                 .interval = "test",
                 .intensity = kAwkward,
                 .measures = {.num_strokes = 2, .stroke_width_m = 1.0 / 3.0}});
    study_.exclude(study_.answer({.block = "group_d",
                                  .procedure = "constant_stimuli",
                                  .quantity = "viscosity_pa_s",
                                  .intensity = 2.0,
                                  .response = 0.0}));
    study_.add("PILOT", /*pilot=*/true);
    study_.estimate(1.0, 100.0);
  }

  [[nodiscard]] fs::path out(const char* name = "out") const {
    return temporary_.path() / name;
  }
  [[nodiscard]] CsvTable table(const char* name, const char* folder = "out") const {
    return CsvTable::read(out(folder) / name);
  }
  [[nodiscard]] static std::string cell(const CsvTable& of, std::size_t row,
                                        const char* column) {
    return of.cell(row, of.find(column).value());
  }

  // Neither number fits into fewer than 17 digits.
  static constexpr double kAwkward = 0.1 + 0.2;
  HandMadeStudy study_;
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

constexpr const char* kTables[] = {"sessions.csv", "trials.csv", "presentations.csv",
                                   "events.csv", "answers.csv"};
// These tables are made from several tables or from the study file.
constexpr const char* kMadeTables[] = {"participants.csv", "questionnaires.csv",
                                       "questions.csv",    "codebook.csv",
                                       "markers.csv",      "session_values.csv"};

TEST_F(CsvExportTest, TheCodebookHasEveryColumnOfEveryTableAndNoOther) {
  export_csv(study_.store(), out(), {});
  const CsvTable codebook = table("codebook.csv");
  std::set<std::string> told;
  for (std::size_t row = 0; row < codebook.num_rows(); ++row) {
    told.insert(cell(codebook, row, "file") + ":" + cell(codebook, row, "column"));
    EXPECT_NE(cell(codebook, row, "meaning"), "") << row;
  }
  EXPECT_EQ(told.size(), codebook.num_rows()) << "each once";
  EXPECT_EQ(told.erase("*.csv:*"), 1U) << "what is said of all tables";
  std::set<std::string> there;
  std::vector<std::string> names(std::begin(kTables), std::end(kTables));
  names.insert(names.end(), std::begin(kMadeTables), std::end(kMadeTables));
  for (const std::string& name : names) {
    const CsvTable columns = table(name.c_str());
    for (const std::string& column : columns.columns()) {
      there.insert(name + ":" + column);
      EXPECT_EQ(column.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
                std::string::npos)
          << column;
    }
  }
  EXPECT_EQ(told, there);
}

TEST_F(CsvExportTest, ColumnsHaveTheNamesOfTheDatabase) {
  export_csv(study_.store(), out(), {});
  std::string schema;
  for (const auto& layout :
       fs::directory_iterator(test_support::source_folder() / "data" / "database")) {
    schema += read_file(layout.path());
  }
  const std::set<std::string> kWorkedOut = {
      "simulated",         "excluded",       "completed", "is_practice",
      "standard_medium",   "language",       "fields",    "fitting",
      "laboratory_sha256", "magnitude",      "rating",    "produced_intensity",
      "matched_intensity", "is_test_chosen", "is_felt",   "is_called_different",
      "is_right"};
  for (const char* name : kTables) {
    const CsvTable columns = table(name);
    for (const std::string& column : columns.columns()) {
      EXPECT_TRUE(kWorkedOut.contains(column) ||
                  schema.find("\n  " + column + " ") != std::string::npos ||
                  schema.find("ADD COLUMN " + column + " ") != std::string::npos)
          << name << ' ' << column;
    }
  }
}

TEST_F(CsvExportTest, EachPulseHasItsTimeAndTheEventThatItTellsOf) {
  HandMadeStudy study;
  study.add("P01");
  study.happen("session_started");
  study.happen("fault_raised", {}, R"({"fault":"force_limit"})");
  study.happen("markers_sent", {},
               R"({"pulses":[[2,16,12345.6789,0.00025],[0,32,12350.5,0.0]]})");
  study.happen("markers_sent", {}, R"({"pulses":[[1],"x",[1,2,"3",4]]})");
  study.happen("markers_sent", {}, "[]");
  export_csv(study.store(), out(), {});
  const CsvTable markers = table("markers.csv");
  ASSERT_EQ(markers.num_rows(), 2U) << "what is damaged is left out";
  EXPECT_EQ(cell(markers, 0, "code"), "16");
  EXPECT_EQ(cell(markers, 0, "monotonic_s"), "12345.6789");
  EXPECT_EQ(cell(markers, 0, "uncertainty_s"), "0.00025");
  EXPECT_EQ(cell(markers, 0, "event"), "2");
  EXPECT_EQ(cell(markers, 0, "kind"), "fault_raised");
  EXPECT_EQ(cell(markers, 0, "trial"), "");
  EXPECT_EQ(cell(markers, 1, "code"), "32");
  EXPECT_EQ(cell(markers, 1, "event"), "") << "the end";
  EXPECT_EQ(cell(markers, 1, "kind"), "");
}

TEST_F(CsvExportTest, LinesEndInLfAndNumbersHaveAPoint) {
  export_csv(study_.store(), out(), {});
  for (const auto& entry : fs::directory_iterator(out())) {
    const std::string text = read_file(entry.path());
    EXPECT_EQ(text.find('\r'), std::string::npos) << entry.path();
    EXPECT_TRUE(text.ends_with("\n")) << entry.path();
    EXPECT_FALSE(text.starts_with("\xEF\xBB\xBF")) << entry.path();
  }
  EXPECT_NE(read_file(out() / "trials.csv").find("0.30000000000000004"), std::string::npos);
}

TEST_F(CsvExportTest, ValuesReadBackAsTheyWere) {
  export_csv(study_.store(), out(), {});
  const CsvTable trials = table("trials.csv");
  ASSERT_EQ(trials.num_rows(), 2U);
  const auto number = [&](const CsvTable& of, std::size_t row, const char* column) {
    const std::string text = cell(of, row, column);
    double value = NAN;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
  };
  EXPECT_EQ(cell(trials, 0, "participant"), "P01");
  EXPECT_EQ(cell(trials, 0, "block"), "a \"quoted\", block");
  EXPECT_EQ(number(trials, 0, "intensity"), kAwkward);
  EXPECT_EQ(number(trials, 0, "response_time_s"), 1.5e-7);
  EXPECT_EQ(cell(trials, 0, "starting_intensity"), "") << "what there is not is empty";
  EXPECT_EQ(number(table("presentations.csv"), 0, "stroke_width_m"), 1.0 / 3.0);
}

TEST_F(CsvExportTest, ExcludedTrialsAreThereAndMarked) {
  export_csv(study_.store(), out(), {});
  const CsvTable trials = table("trials.csv");
  EXPECT_EQ(cell(trials, 0, "excluded"), "0");
  EXPECT_EQ(cell(trials, 1, "excluded"), "1");
}

TEST_F(CsvExportTest, ASessionHasWhatItsParticipantReadAndBrought) {
  (void)study_.add("P09");
  study_.start(R"({"language": "de", "fields": {"sex": "female", "hand": "left"}})");
  export_csv(study_.store(), out(), {});
  const CsvTable sessions = table("sessions.csv");
  EXPECT_EQ(cell(sessions, 0, "language"), "");
  EXPECT_EQ(cell(sessions, sessions.num_rows() - 1, "language"), "de");
  EXPECT_EQ(cell(sessions, sessions.num_rows() - 1, "fields"), "hand=left;sex=female");
}

TEST_F(CsvExportTest, ASessionHasHowTheDeviceWasFitted) {
  (void)study_.add("P09");
  study_.start(R"({"language": "de"})");
  study_.keep("fitting_kept",
              R"({"fitting": {"thumb": "thin pad", "glove": "M"}, "held": ["thumb"],
                  "neutral_pose_m": {"thumb": [0, 0.1, 0.2]}})");
  export_csv(study_.store(), out(), {});
  const CsvTable sessions = table("sessions.csv");
  EXPECT_EQ(cell(sessions, 0, "fitting"), "");
  EXPECT_EQ(cell(sessions, sessions.num_rows() - 1, "fitting"), "glove=M;thumb=thin pad");
  EXPECT_EQ(cell(sessions, sessions.num_rows() - 1, "language"), "de");
}

TEST_F(CsvExportTest, WhatWasMeasuredOfADeviceIsAFileThatItsSessionsName) {
  export_csv(study_.store(), out("without"), {});
  EXPECT_FALSE(fs::exists(out("without") / "device_profiles"));
  const std::string hash = study_.add_measured("P08", "{\"name\": \"left\"}\n");
  (void)study_.add_measured("P09", "{\"name\": \"left\"}\n");
  export_csv(study_.store(), out(), {});
  const CsvTable sessions = table("sessions.csv");
  EXPECT_EQ(cell(sessions, 0, "device_profile_sha256"), "");
  EXPECT_EQ(cell(sessions, sessions.num_rows() - 1, "device_profile_sha256"), hash);
  EXPECT_EQ(read_file(out() / "device_profiles" / (hash + ".device.json")),
            "{\"name\": \"left\"}\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(out() / "device_profiles"), {}), 1);
}

TEST_F(CsvExportTest, PilotsAreThereOnlyWhenAskedFor) {
  export_csv(study_.store(), out(), {});
  export_csv(study_.store(), out("with"), {.pilot = true});
  EXPECT_EQ(table("sessions.csv").num_rows(), 1U);
  EXPECT_EQ(table("sessions.csv", "with").num_rows(), 2U);
  EXPECT_EQ(table("trials.csv", "with").num_rows(), 3U);
  for (const char* name : kTables) {
    EXPECT_EQ(read_file(out() / name).find("PILOT"), std::string::npos) << name;
  }
}

TEST_F(CsvExportTest, ParticipantsAreCountedWithWhatWasSetAside) {
  export_csv(study_.store(), out(), {});
  const CsvTable participants = table("participants.csv");
  ASSERT_EQ(participants.num_rows(), 1U) << "the pilot is not one";
  EXPECT_EQ(cell(participants, 0, "participant"), "P01");
  EXPECT_EQ(cell(participants, 0, "num_sessions"), "1");
  EXPECT_EQ(cell(participants, 0, "num_completed_sessions"), "0");
  EXPECT_EQ(cell(participants, 0, "num_trials"), "2");
  EXPECT_EQ(cell(participants, 0, "num_excluded_trials"), "1");
}

TEST_F(CsvExportTest, ParticipantsHaveTheFieldsOfTheStudyAndTheCodebookTellsThem) {
  HandMadeStudy study(R"({"name": "asked", "participant_fields": [
      {"name": "sex", "question": {"en": "Sex?"}, "options": [
        {"value": "female", "label": {"en": "a woman"}},
        {"value": "male", "label": {"en": "a man"}}]},
      {"name": "num_trials", "options": [{"value": "many"}]}]})");
  study.add("P01");
  study.say("participant", "sex", "female");
  study.say("participant", "num_trials", "many");
  study.add("P02");
  export_csv(study.store(), out(), {});
  const CsvTable participants = table("participants.csv");
  EXPECT_EQ(cell(participants, 0, "sex"), "female");
  EXPECT_EQ(cell(participants, 0, "num_trials"), "0");
  EXPECT_EQ(cell(participants, 0, "field_num_trials"), "many");
  EXPECT_EQ(cell(participants, 1, "sex"), "");
  EXPECT_NE(
      read_file(out() / "codebook.csv")
          .find("participants.csv,sex,,\"Sex?, as was known before the session: female (a "
                "woman), male (a man)\""),
      std::string::npos)
      << read_file(out() / "codebook.csv");
}

TEST_F(CsvExportTest, QuestionnairesAreThereWithTheirQuestionsAlsoThoseNotAnswered) {
  HandMadeStudy study(R"({"name": "asked", "stages": [
      {"kind": "questionnaire", "name": "about_you", "items": [
        {"name": "age_years", "kind": "number", "unit": "years",
         "question": {"de": "Wie alt?", "en": "How old?"}},
        {"name": "safety", "kind": "scale", "question": {"en": "Safe?"}}]}]})");
  study.add("P01");
  export_csv(study.store(), out(), {});
  const CsvTable asked = table("questionnaires.csv");
  ASSERT_EQ(asked.num_rows(), 2U);
  EXPECT_EQ(cell(asked, 0, "question"), "How old?");
  EXPECT_EQ(cell(asked, 0, "unit"), "years");
  EXPECT_EQ(cell(asked, 0, "answer"), "");
  EXPECT_EQ(cell(asked, 1, "num_steps"), "10");
}

TEST_F(CsvExportTest, AQuestionnaireThatCameThreeTimesHasARowForEach) {
  HandMadeStudy study(R"({"name": "asked", "stages": [
      {"kind": "questionnaire", "name": "rest", "items": [
        {"name": "tired", "kind": "scale", "question": {"en": "Tired?"}}]}]})");
  study.add("P01");
  study.say("rest", "tired", "2", 1);
  study.say("rest", "tired", "5", 3);
  study.say("rest", "tired", "7", 5);
  export_csv(study.store(), out(), {});
  const CsvTable asked = table("questionnaires.csv");
  ASSERT_EQ(asked.num_rows(), 3U);
  EXPECT_EQ(cell(asked, 0, "answer"), "2");
  EXPECT_EQ(cell(asked, 0, "stage_index"), "1");
  EXPECT_EQ(cell(asked, 1, "answer"), "5");
  EXPECT_EQ(cell(asked, 2, "answer"), "7");
  EXPECT_EQ(cell(asked, 2, "stage_index"), "5");
  const CsvTable answers = table("answers.csv");
  ASSERT_EQ(answers.num_rows(), 3U);
  EXPECT_EQ(cell(answers, 1, "stage_index"), "3");
}

TEST_F(CsvExportTest, PresentationsOfExcludedTrialsAreThereAndMarked) {
  study_.add("P02");
  const std::int64_t trial = study_.answer({.block = "group_d", .response = 0.0});
  study_.move({.presentation = 1, .interval = "test", .intensity = 2.0});
  study_.exclude(trial);
  export_csv(study_.store(), out(), {});
  const CsvTable presentations = table("presentations.csv");
  ASSERT_EQ(presentations.num_rows(), 2U);
  EXPECT_EQ(cell(presentations, 0, "excluded"), "0");
  EXPECT_EQ(cell(presentations, 1, "participant"), "P02");
  EXPECT_EQ(cell(presentations, 1, "intensity"), "2");
  EXPECT_EQ(cell(presentations, 1, "excluded"), "1");
}

TEST_F(CsvExportTest, EveryTableOfASimulatedStudySaysSoAndWhose) {
  HandMadeStudy study(R"({"name": "asked", "stages": [
      {"kind": "questionnaire", "name": "about_you", "items": [
        {"name": "safety", "kind": "scale", "question": {"en": "Safe?"}}]}]})");
  study.add("P01", /*pilot=*/false, "{\n  \"name\": \"made\"\n}");
  study.estimate(1.0, 100.0);
  study.move({.presentation = 1, .interval = "test", .intensity = 1.0});
  study.say("about_you", "safety", "3");
  core::RecordingWriter writer(study.store().recording_file(1), 1000.0,
                               core::Durability::kAtClose);
  for (const std::int64_t tick : {0, 5}) writer.append({.tick = tick});
  writer.flush();
  export_csv(study.store(), out(), {.recordings = true});
  for (const char* name :
       {"sessions.csv", "participants.csv", "trials.csv", "presentations.csv", "events.csv",
        "answers.csv", "questionnaires.csv", "recordings/gaps.csv"}) {
    const CsvTable rows = table(name);
    ASSERT_GT(rows.num_rows(), 0U) << name;
    for (std::size_t row = 0; row < rows.num_rows(); ++row) {
      EXPECT_EQ(cell(rows, row, "simulated"), "1") << name;
      EXPECT_EQ(cell(rows, row, "participant"), "P01") << name;
    }
  }
  const std::string laboratory = cell(table("sessions.csv"), 0, "laboratory_sha256");
  EXPECT_EQ(test_support::read_file(out() / "laboratories" / (laboratory + ".json")),
            "{\n  \"name\": \"made\"\n}")
      << "word for word";
  EXPECT_EQ(cell(table("events.csv"), 0, "version"), "1");
}

TEST_F(CsvExportTest, SeriesIntervalAndCatchOfATrialAreThere) {
  study_.add("P02");
  (void)study_.answer({.block = "staircases",
                       .response = 1.0,
                       .series = 2,
                       .test_interval = 1,
                       .is_catch = true});
  export_csv(study_.store(), out(), {});
  const CsvTable trials = table("trials.csv");
  EXPECT_EQ(cell(trials, 0, "series"), "") << "there is one";
  EXPECT_EQ(cell(trials, 0, "is_catch"), "0");
  EXPECT_EQ(cell(trials, 2, "series"), "2");
  EXPECT_EQ(cell(trials, 2, "test_interval"), "1");
  EXPECT_EQ(cell(trials, 2, "is_catch"), "1");
}

TEST_F(CsvExportTest, AGapOfARecordingIsToldAndNotFilledIn) {
  {
    core::RecordingWriter writer(study_.store().recording_file(1), 1000.0,
                                 core::Durability::kAtClose);
    for (const std::int64_t tick : {0, 1, 5, 6}) writer.append({.tick = tick});
  }
  export_csv(study_.store(), out(), {.recordings = true});
  EXPECT_EQ(table("recordings/0001.csv").num_rows(), 4U);
  EXPECT_EQ(read_file(out() / "recordings/gaps.csv"),
            "session,participant,simulated,first_tick,last_tick,missed_ticks\n1,P01,0,2,4,0\n");
}

/// This covers everything that somebody typed, in the study file or during a session.
TEST_F(CsvExportTest, NoCellThatSomebodyTypedIsAFormula) {
  HandMadeStudy study(R"json({"name": "typed", "participant_fields": [{"name": "group",
      "options": [{"value": "=GROUP()"}]}],
      "stages": [{"kind": "questionnaire", "name": "asked", "items": [
      {"name": "remark", "kind": "text", "question": {"en": "=QUESTION()?"}},
      {"name": "shift", "kind": "number", "unit": "@unit", "minimum": -9, "maximum": 9,
       "question": {"en": "Shift?"}}]}]})json");
  study.add("P01");
  study.say("participant", "group", "=GROUP()");
  study.say("asked", "remark", "=cmd|' /C calc'!A0");
  study.say("asked", "shift", "-3.2");
  study.say("checked", "note", "@mail");
  export_csv(study.store(), out(), {});
  std::size_t num_texts = 0;
  for (const char* name :
       {"sessions.csv", "trials.csv", "presentations.csv", "events.csv", "answers.csv",
        "participants.csv", "questionnaires.csv", "codebook.csv"}) {
    const CsvTable of = table(name);
    for (std::size_t row = 0; row < of.num_rows(); ++row) {
      for (std::size_t column = 0; column < of.columns().size(); ++column) {
        const std::string& text = of.cell(row, column);
        if (text.starts_with("'")) ++num_texts;
        if (text.empty() || text == "-3.2") continue;
        EXPECT_EQ(std::string("=+-@").find(text[0]), std::string::npos) << name << ": " << text;
      }
    }
  }
  // There are three texts in answers, one in participants (the field), and three in
  // questionnaires (question, unit and answer).
  EXPECT_EQ(num_texts, 3U + 1U + 3U);
  EXPECT_NE(read_file(out() / "answers.csv").find(",'=cmd|' /C calc'!A0,"), std::string::npos)
      << read_file(out() / "answers.csv");
  EXPECT_NE(read_file(out() / "answers.csv").find(",-3.2,"), std::string::npos);
  EXPECT_NE(read_file(out() / "codebook.csv").find("apostrophe"), std::string::npos);
}

TEST_F(CsvExportTest, WhatFailsHalfWayLeavesNothing) {
  std::ofstream(study_.store().recording_file(1)) << "no recording";
  EXPECT_THROW(export_csv(study_.store(), out(), {.recordings = true}), core::Error);
  EXPECT_TRUE(fs::is_empty(temporary_.path()));
}

TEST_F(CsvExportTest, TheSameStudyGivesTheSameBytes) {
  export_csv(study_.store(), out("a"), {});
  export_csv(study_.store(), out("b"), {});
  for (const char* name : kTables)
    EXPECT_EQ(read_file(out("a") / name), read_file(out("b") / name));
}

TEST_F(CsvExportTest, RefusesAFolderThatIsNotEmptyAndTakesOneThatIs) {
  fs::create_directory(out());
  export_csv(study_.store(), out(), {});
  const std::string before = read_file(out() / "trials.csv");
  EXPECT_THROW(export_csv(study_.store(), out(), {.pilot = true}), core::Error);
  EXPECT_EQ(read_file(out() / "trials.csv"), before);
  std::ofstream(temporary_.path() / "file") << "precious";
  EXPECT_THROW(export_csv(study_.store(), temporary_.path() / "file", {}), core::Error);
  EXPECT_EQ(read_file(temporary_.path() / "file"), "precious");
}

TEST_F(CsvExportTest, ALocaleWithDecimalCommasChangesNothing) {
  export_csv(study_.store(), out("plain"), {.pilot = true});
  class Commas final : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new Commas));
  export_csv(study_.store(), out("commas"), {.pilot = true});
  std::locale::global(before);
  for (const char* name : kTables) {
    EXPECT_EQ(read_file(out("plain") / name), read_file(out("commas") / name)) << name;
  }
}

class RecordingsExportTest : public CsvExportTest,
                             public ::testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(WithAndWithoutJoints, RecordingsExportTest, ::testing::Bool());

TEST_P(RecordingsExportTest, HaveARowASampleAndTheirColumnsInTheCodebook) {
  {
    core::RecordingWriter writer(study_.store().recording_file(1), 1000.0,
                                 core::Durability::kAtClose);
    for (std::int64_t tick = 0; tick < 100; ++tick) {
      core::Sample sample;
      sample.tick = tick;
      sample.tip_position_m[0][0] = 1e-3F * static_cast<float>(tick);
      if (GetParam()) sample.joint_position_rad[21] = 1.5708F;
      if (GetParam()) sample.joint_torque_n_m[21] = 0.3F;
      writer.append(sample);
    }
  }
  export_csv(study_.store(), out(), {.recordings = true});
  const CsvTable samples = table("recordings/0001.csv");
  ASSERT_EQ(samples.num_rows(), 100U);
  EXPECT_EQ(cell(samples, 99, "tick"), "99");
  if (GetParam()) {
    // The values have single precision; their own digits would be 1.5707999467849731 and
    // 0.30000001192092896.
    EXPECT_EQ(cell(samples, 99, "middle_proximal_position_rad"), "1.5708");
    EXPECT_EQ(cell(samples, 99, "middle_proximal_torque_n_m"), "0.3");
  }
  std::set<std::string> told;
  const CsvTable codebook = table("codebook.csv");
  for (std::size_t row = 0; row < codebook.num_rows(); ++row) {
    if (cell(codebook, row, "file") == "recordings/*.csv") {
      told.insert(cell(codebook, row, "column"));
    }
  }
  EXPECT_EQ(told, std::set<std::string>(samples.columns().begin(), samples.columns().end()));
}

/// Exports a study of blocks with factors.
class TidyExportTest : public ::testing::Test {
 protected:
  TidyExportTest() {
    nlohmann::json study = nlohmann::json::parse(
        read_file(test_support::source_folder() / "protocols" / "viscosity_priming.json"));
    made_ = std::make_unique<HandMadeStudy>(study.dump());
  }
  [[nodiscard]] CsvTable table(const char* name) const {
    return CsvTable::read(temporary_.path() / "out" / name);
  }
  [[nodiscard]] static std::string cell(const CsvTable& of, std::size_t row,
                                        const char* column) {
    return of.cell(row, of.find(column).value());
  }
  void write(const ExportSelection& selection = {}) {
    export_csv(made_->store(), temporary_.path() / "out", {.selection = selection});
  }

  std::unique_ptr<HandMadeStudy> made_;
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

TEST_F(TidyExportTest, EachTrialTellsItsConditionAndEachColumnOneThing) {
  made_->add("P01", false, "", "priming=primed;sex=female");
  (void)made_->answer({.block = "thick_fluids", .response = 1.0});
  (void)made_->answer({.block = "thin_fluids", .response = 0.0});
  made_->start(R"({"language": "de", "fields": {"handedness": "left"}})");
  made_->keep("fitting_kept", R"({"fitting": {"glove": "M"}})");
  write();
  const CsvTable trials = table("trials.csv");
  EXPECT_EQ(cell(trials, 0, "fluid"), "thick");
  EXPECT_EQ(cell(trials, 0, "priming"), "primed");
  EXPECT_EQ(cell(trials, 1, "fluid"), "thin");
  EXPECT_EQ(cell(trials, 1, "priming"), "primed") << "people differ in it";
  EXPECT_EQ(cell(trials, 0, "is_test_chosen"), "1");
  EXPECT_EQ(cell(trials, 1, "is_test_chosen"), "0");
  for (const char* other : {"magnitude", "rating", "produced_intensity", "matched_intensity",
                            "is_felt", "is_called_different", "is_right"}) {
    EXPECT_EQ(cell(trials, 0, other), "") << other;
  }
  const CsvTable values = table("session_values.csv");
  std::set<std::string> rows;
  for (std::size_t row = 0; row < values.num_rows(); ++row) {
    rows.insert(cell(values, row, "kind") + " " + cell(values, row, "name") + " " +
                cell(values, row, "value"));
  }
  EXPECT_EQ(rows, (std::set<std::string>{"arm priming primed", "arm sex female",
                                         "field handedness left", "fitting glove M"}));
}

TEST_F(TidyExportTest, ASelectionHasThatParticipantAndThatBlockAndPresentationsTellTheirBlock) {
  made_->add("P01");
  (void)made_->answer({.block = "thick_fluids", .response = 1.0});
  made_->move({.presentation = 1, .interval = "test", .intensity = 1.0});
  (void)made_->answer({.block = "thin_fluids", .response = 0.0});
  made_->move({.presentation = 1, .interval = "test", .intensity = 2.0});
  made_->add("P02");
  (void)made_->answer({.block = "thick_fluids", .response = 1.0});
  write({.participants = {"P01"}, .blocks = {"thin_fluids"}});
  const CsvTable sessions = table("sessions.csv"), trials = table("trials.csv"),
                 presentations = table("presentations.csv");
  ASSERT_EQ(sessions.num_rows(), 1U);
  ASSERT_EQ(trials.num_rows(), 1U);
  EXPECT_EQ(cell(trials, 0, "block"), "thin_fluids");
  ASSERT_EQ(presentations.num_rows(), 1U);
  EXPECT_EQ(cell(presentations, 0, "block"), "thin_fluids");
  EXPECT_EQ(cell(presentations, 0, "intensity"), "2");
}

}  // namespace csv_export_test
}  // namespace jnd::analysis
