#include "analysis/export/bids_export.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/hand_made_study.h"
#include "core/error.h"
#include "core/sample_table.h"
#include "core/storage/recording.h"
#include "core/storage/schedule.h"
#include "support/files.h"

namespace jnd::analysis {
namespace bids_export_test {

namespace fs = std::filesystem;
using test_support::read_file;

class BidsExportTest : public ::testing::Test {
 protected:
  BidsExportTest() {
    study_.add("P_01", /*pilot=*/false, R"({"name": "made"})");
    (void)study_.answer({.block = "group_d",
                         .procedure = "constant_stimuli",
                         .medium = "viscous",
                         .quantity = "viscosity_pa_s",
                         .intensity = 4.0,
                         .reference_intensity = 8.0,
                         .response = 0.0,
                         .measures = {.response_time_s = 1.5},
                         .first_tick = 100,
                         .last_tick = 109});
    study_.move({.presentation = 1,
                 .interval = "test",
                 .intensity = 4.0,
                 .first_tick = 100,
                 .last_tick = 104});
    study_.add("PILOT", /*pilot=*/true);
    study_.estimate(1.0, 100.0);
  }

  /// Records the ticks 90 to 119 without 103, 106 and 107.
  void record() { record(study_.store()); }
  static void record(const core::StudyStore& store) {
    core::RecordingWriter writer(store.recording_file(1), 1000.0, core::Durability::kAtClose);
    for (std::int64_t tick = 90; tick < 120; ++tick) {
      if (tick == 103 || tick == 106 || tick == 107) continue;
      core::Sample sample{.tick = tick};
      sample.tip_position_m[0][0] = 1e-7 * static_cast<double>(tick);
      writer.append(sample);
    }
  }
  ExportOutcome write(const ExportOptions& options, const char* name = "out") {
    return export_bids(study_.store(), temporary_.path() / name, options, R"({"study": "x"})");
  }
  [[nodiscard]] fs::path out(const std::string& name) const {
    return temporary_.path() / "out" / name;
  }
  [[nodiscard]] static std::vector<std::vector<std::string>> cells(const fs::path& file) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(read_file(file));
    for (std::string line; std::getline(lines, line);) {
      rows.emplace_back();
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, '\t');) rows.back().push_back(cell);
    }
    return rows;
  }
  [[nodiscard]] static std::string value(const std::vector<std::vector<std::string>>& rows,
                                         std::size_t row, const std::string& column) {
    const auto found = std::find(rows[0].begin(), rows[0].end(), column);
    EXPECT_NE(found, rows[0].end()) << column;
    return rows.at(row).at(static_cast<std::size_t>(found - rows[0].begin()));
  }
  [[nodiscard]] static nlohmann::json json(const fs::path& file) {
    return nlohmann::json::parse(read_file(file));
  }

  static constexpr const char* kBeh = "sub-P01/ses-01/beh/sub-P01_ses-01_task-groupd";
  static constexpr const char* kMotion =
      "sub-P01/ses-01/motion/sub-P01_ses-01_task-groupd_tracksys-haptic";
  HandMadeStudy study_{R"({"name": "by_hand", "title": {"en": "By hand"}, "authors": ["A", "B"],
      "stages": [{"kind": "questionnaire", "name": "about_you", "items": [
        {"name": "age_years", "kind": "number", "unit": "years", "question": {"en": "Age?"}}]}]})"};
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

TEST_F(BidsExportTest, SaysWhatItIsAndThatItIsSimulated) {
  (void)write({});
  const nlohmann::json description = json(out("dataset_description.json"));
  EXPECT_EQ(description["Name"], "SIMULATED: By hand");
  EXPECT_EQ(description["BIDSVersion"], "1.9.0");
  EXPECT_EQ(description["Authors"], (nlohmann::json{"A", "B"}));
  EXPECT_EQ(description["Simulated"], true);
  EXPECT_NE(read_file(out("README.md")).find("SIMULATED"), std::string::npos);
  EXPECT_EQ(read_file(out("participants.tsv")),
            "participant_id\tpseudonym\tdata_origin\tnum_sessions\tage\n"
            "sub-P01\tP_01\tSIMULATED\t1\tn/a\n");
  EXPECT_EQ(read_file(out("phenotype/aboutyou.tsv")),
            "participant_id\tsimulated\tage_years\nsub-P01\t1\tn/a\n");
  EXPECT_EQ(read_file(out("derivatives/jnd/results.json")), "{\"study\": \"x\"}\n");
  EXPECT_EQ(json(out("derivatives/jnd/dataset_description.json"))["DatasetType"], "derivative");
}

TEST_F(BidsExportTest, BehHasARowATrialAndASidecarOfEveryColumn) {
  (void)write({});
  const auto rows = cells(out(std::string(kBeh) + "_beh.tsv"));
  ASSERT_EQ(rows.size(), 2U);
  const nlohmann::json sidecar = json(out(std::string(kBeh) + "_beh.json"));
  EXPECT_EQ(sidecar["TaskName"], "group_d");
  for (const std::string& column : rows[0]) {
    EXPECT_TRUE(sidecar[column].contains("Description")) << column;
  }
  EXPECT_EQ(value(rows, 1, "intensity"), "4");
  EXPECT_EQ(value(rows, 1, "starting_intensity"), "n/a");
  EXPECT_EQ(value(rows, 1, "simulated"), "1");
  EXPECT_EQ(value(rows, 1, "series"), "n/a");
  EXPECT_EQ(value(rows, 1, "is_catch"), "0");
  EXPECT_EQ(sidecar["FirstTick"], 100) << "from which first_tick counts to a row of motion";
  EXPECT_EQ(sidecar.dump().find(".csv"), std::string::npos) << "there is none";
  EXPECT_EQ(cells(out(std::string(kBeh) + "_events.tsv"))[1],
            (std::vector<std::string>{"0", "0.005", "test", "1", "1", "1", "viscous", "4", "0",
                                      "1.5", "0", "0", "1"}));
}

TEST_F(BidsExportTest, MotionHasARowATickAndAChannelAColumn) {
  record();
  (void)write({.recordings = true});
  const auto rows = cells(out(std::string(kMotion) + "_motion.tsv"));
  const auto channels = cells(out(std::string(kMotion) + "_channels.tsv"));
  const nlohmann::json sidecar = json(out(std::string(kMotion) + "_motion.json"));
  ASSERT_EQ(rows.size(), 10U) << "from the block's first tick to its last";
  EXPECT_EQ(channels[0],
            (std::vector<std::string>{"name", "component", "type", "tracked_point", "units",
                                      "sampling_frequency", "reference_frame", "description"}));
  EXPECT_EQ(rows[0].size(), channels.size() - 1);
  EXPECT_EQ(rows[0].size(), core::sample_column_names({}).size()) << "latency for tick";
  EXPECT_EQ(channels[1][2], "LATENCY");
  EXPECT_EQ(channels[2][0], "palm_inner_position_x_m");
  EXPECT_EQ(channels[2][1], "x");
  EXPECT_EQ(channels[2][2], "POS");
  EXPECT_EQ(channels[2][3], "palm_inner");
  EXPECT_EQ(channels[2][4], "m");
  EXPECT_EQ(channels[8][0], "palm_inner_force_x_n");
  EXPECT_EQ(channels[8][2], "MISC") << "BIDS knows no force";
  EXPECT_EQ(channels[8][4], "N");
  EXPECT_EQ(rows[2][0], "0.002");
  EXPECT_EQ(rows[2][1], "0.0000102");
  EXPECT_EQ(sidecar["TaskName"], "group_d");
  EXPECT_EQ(sidecar["SamplingFrequency"], 1000.0);
  EXPECT_EQ(sidecar["MotionChannelCount"], rows[0].size());
  EXPECT_EQ(sidecar["POSChannelCount"], 18);
  EXPECT_EQ(sidecar["VELChannelCount"], 15);
  EXPECT_EQ(sidecar["TrackedPointsCount"], 6);
  EXPECT_FALSE(fs::exists(out(std::string(kBeh) + "_events.tsv"))) << "told once";
}

TEST_F(BidsExportTest, AtAFifthOfTheRateMotionHasARowEveryFiveTicksOfTheChosenChannels) {
  record();
  (void)write(
      {.selection = {.channels = {"position_m"}, .rate_hz = 200.0}, .recordings = true});
  const auto rows = cells(out(std::string(kMotion) + "_motion.tsv"));
  const nlohmann::json sidecar = json(out(std::string(kMotion) + "_motion.json"));
  ASSERT_EQ(rows.size(), 2U) << "ticks 100 to 109";
  EXPECT_EQ(rows[0][0], "0");
  EXPECT_EQ(rows[1][0], "0.005");
  // These are the ticks 100 to 104 without 103, which was lost.
  EXPECT_EQ(rows[0][1], "0.0000102") << "the mean of 100, 101, 102 and 104 steps";
  EXPECT_EQ(rows[0].size(), 1U + 15U + 4U) << "latency, positions of five points, flags";
  EXPECT_EQ(sidecar["SamplingFrequency"], 200.0);
  EXPECT_EQ(sidecar["RecordingDuration"], 0.01);
  EXPECT_EQ(cells(out(std::string(kMotion) + "_channels.tsv"))[2][5], "200");
  EXPECT_FALSE(fs::exists(out("sourcedata/jnd.study/recordings")))
      << "who chooses some of it does not want all of it beside";
}

TEST_F(BidsExportTest, LostSamplesAreRowsOfNothingAndEvents) {
  record();
  (void)write({.recordings = true});
  const auto rows = cells(out(std::string(kMotion) + "_motion.tsv"));
  for (const std::size_t lost : {3U, 6U, 7U}) {
    EXPECT_NE(rows[lost][0], "n/a") << "its time is known";
    EXPECT_TRUE(std::all_of(rows[lost].begin() + 1, rows[lost].end(),
                            [](const std::string& cell) { return cell == "n/a"; }));
  }
  EXPECT_NE(rows[4][1], "n/a");
  const auto events = cells(out(std::string(kMotion) + "_events.tsv"));
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(events[2][0], "0.003");
  EXPECT_EQ(events[2][1], "0.001");
  EXPECT_EQ(events[2][2], "missing_samples");
  EXPECT_EQ(events[3][0], "0.006");
  EXPECT_EQ(events[3][1], "0.002");
}

TEST_F(BidsExportTest, PresentationsOfExcludedTrialsAreEventsAndMarked) {
  HandMadeStudy study;
  study.add("P01");
  for (const bool excluded : {false, true}) {
    const std::int64_t trial = study.answer({.block = "b", .response = 1.0});
    study.move({.presentation = 1, .interval = "test", .intensity = 4.0});
    if (excluded) study.exclude(trial);
  }
  export_bids(study.store(), out(""), {}, "");
  const auto rows = cells(out("sub-P01/ses-01/beh/sub-P01_ses-01_task-b_events.tsv"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(value(rows, 1, "excluded"), "0");
  EXPECT_EQ(value(rows, 2, "trial"), "2");
  EXPECT_EQ(value(rows, 2, "excluded"), "1");
}

/// This also holds for a study that only presents media. Its samples are tasks that have the
/// names of their stages.
TEST_F(BidsExportTest, StagesInWhichMediaAreExploredAreTasks) {
  HandMadeStudy study;
  study.add("P01");
  study.explore(1, "free_space", 0.0, 92, 95);
  study.explore(1, "viscous", 2.5, 100, 104);
  study.explore(7, "solid", 900.0, 110, 111);
  record(study.store());
  const auto names = [](const core::SessionRow&) {
    return std::vector<std::string>{"consent", "first_look"};
  };
  const ExportOutcome outcome =
      export_bids(study.store(), out(""), {.recordings = true, .stage_names = names}, "");
  EXPECT_TRUE(outcome.samples);
  const std::string front = "sub-P01/ses-01/motion/sub-P01_ses-01_task-";
  EXPECT_EQ(cells(out(front + "firstlook_tracksys-haptic_motion.tsv")).size(), 13U);
  EXPECT_EQ(cells(out(front + "stage8_tracksys-haptic_motion.tsv")).size(), 2U);
  const auto events = cells(out(front + "firstlook_tracksys-haptic_events.tsv"));
  ASSERT_EQ(events.size(), 4U) << "one of them for the tick that is lost";
  EXPECT_EQ(value(events, 1, "trial_type"), "medium_explored");
  EXPECT_EQ(value(events, 1, "medium"), "free_space");
  EXPECT_EQ(value(events, 1, "duration"), "0.004");
  EXPECT_EQ(value(events, 2, "onset"), "0.008");
  EXPECT_EQ(value(events, 2, "medium"), "viscous");
  EXPECT_EQ(value(events, 2, "intensity"), "2.5");
  EXPECT_EQ(value(events, 2, "trial"), "n/a");
  EXPECT_EQ(value(events, 3, "trial_type"), "missing_samples");
  EXPECT_FALSE(fs::exists(out("sub-P01/ses-01/beh"))) << "no trial, no behaviour";
  EXPECT_EQ(cells(out("sub-P01/ses-01/sub-P01_ses-01_scans.tsv")).size(), 3U);
}

TEST_F(BidsExportTest, TheReadmeSpeaksOfMotionOnlyIfThereIsSome) {
  record();
  EXPECT_TRUE(write({.recordings = true}).samples);
  EXPECT_NE(read_file(out("README.md")).find("`sub-*/ses-*/motion`"), std::string::npos);
  EXPECT_NE(read_file(out("README.md")).find("max-old-space-size"), std::string::npos)
      << "the official validator reads whole files into memory";
  EXPECT_FALSE(write({}, "plain").samples);
  EXPECT_NE(read_file(temporary_.path() / "plain/README.md").find("without recordings"),
            std::string::npos);
  HandMadeStudy other;
  other.add("P01");
  record(other.store());
  const ExportOutcome outcome =
      export_bids(other.store(), temporary_.path() / "other", {.recordings = true}, "");
  EXPECT_FALSE(outcome.samples) << "all of them are between tasks";
  EXPECT_NE(read_file(temporary_.path() / "other/README.md").find("No `motion`"),
            std::string::npos);
}

TEST_F(BidsExportTest, SessionsTellWhatTheStudyKnowsOfAVisit) {
  (void)write({});
  const auto rows = cells(out("sub-P01/sub-P01_sessions.tsv"));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(value(rows, 1, "session_id"), "ses-01");
  EXPECT_EQ(value(rows, 1, "simulated"), "1");
  EXPECT_EQ(read_file(out("sourcedata/laboratories/" + value(rows, 1, "laboratory_sha256") +
                          ".json")),
            R"({"name": "made"})");
  for (const char* column : {"cells", "seed", "realtime"}) (void)value(rows, 1, column);
  const nlohmann::json sidecar = json(out("sub-P01/sub-P01_sessions.json"));
  for (const std::string& column : rows[0]) {
    EXPECT_TRUE(sidecar[column].contains("Description")) << column;
  }
}

TEST_F(BidsExportTest, ItIsGeneratedByTheProgramThatExports) {
  (void)write({.program_version = "9.8.7"});
  EXPECT_EQ(json(out("dataset_description.json"))["GeneratedBy"][0]["Version"], "9.8.7");
}

TEST_F(BidsExportTest, ASimulatedStudyHasNoDate) {
  (void)write({});
  EXPECT_EQ(read_file(out("CHANGES")).find("1970"), std::string::npos);
  EXPECT_TRUE(read_file(out("CHANGES")).starts_with("1.0.0\n"));
}

TEST_F(BidsExportTest, ParticipantsHaveTheAgeGenderAndHandednessThatWereAsked) {
  HandMadeStudy study(R"({"name": "asked", "stages": [
      {"kind": "questionnaire", "name": "about_you", "items": [
        {"name": "handedness", "kind": "choice", "question": {"en": "Which hand?"},
         "options": [{"value": "left", "label": {"de": "Links", "en": "The left one"}},
                     {"value": "right", "label": {"de": "Rechts", "en": "The right one"}}]},
        {"name": "safety", "kind": "scale", "num_steps": 7, "question": {"en": "How safe?"},
         "low_label": {"en": "in danger"}, "high_label": {"en": "safe"}},
        {"name": "age_years", "kind": "number", "unit": "years", "question": {"en": "Age?"}},
        {"name": "gender", "kind": "choice", "question": {"en": "Gender?"}}]}]})");
  study.add("P01");
  study.say("about_you", "handedness", "left");
  study.say("about_you", "age_years", "44");
  export_bids(study.store(), out(""), {}, "");
  const auto rows = cells(out("participants.tsv"));
  EXPECT_EQ(value(rows, 1, "age"), "44");
  EXPECT_EQ(value(rows, 1, "gender"), "n/a");
  EXPECT_EQ(value(rows, 1, "handedness"), "left");
  const nlohmann::json sidecar = json(out("participants.json"));
  EXPECT_EQ(sidecar["age"]["Units"], "years");
  EXPECT_EQ(sidecar["handedness"]["Levels"],
            (nlohmann::json{{"left", "The left one"}, {"right", "The right one"}}));
  EXPECT_FALSE(sidecar["age"].contains("Levels"));
  EXPECT_EQ(json(out("phenotype/aboutyou.json"))["safety"]["Levels"],
            (nlohmann::json{{"1", "in danger"}, {"7", "safe"}}));
  EXPECT_EQ(sidecar["handedness"]["Description"],
            "Which hand?, as answered in the stage about_you");
}

TEST_F(BidsExportTest, NoAnswerIsAFormulaToASpreadsheetAndTheReadmeSaysHow) {
  HandMadeStudy study(R"({"name": "asked", "participant_fields": [
      {"name": "hand", "question": {"en": "Hand?"}, "options": [{"value": "-left"}]}],
    "stages": [{"kind": "questionnaire", "name": "about_you", "items": [
        {"name": "remark", "kind": "text", "question": {"en": "What else?"}},
        {"name": "shift", "kind": "number", "question": {"en": "Shift?"}}]}]})");
  study.add("P01");
  study.say("participant", "hand", "-left");
  study.say("about_you", "remark", "\t=1+1");
  study.say("about_you", "shift", "-3.2");
  export_bids(study.store(), out(""), {}, "");
  EXPECT_EQ(value(cells(out("participants.tsv")), 1, "hand"), "'-left");
  const auto form = cells(out("phenotype/aboutyou.tsv"));
  EXPECT_EQ(value(form, 1, "remark"), "' =1+1");
  EXPECT_EQ(value(form, 1, "shift"), "-3.2");
  EXPECT_NE(read_file(out("README.md")).find("apostrophe"), std::string::npos);
}

TEST_F(BidsExportTest, ParticipantsHaveTheFieldsOfTheStudyBeforeWhatAFormAsked) {
  HandMadeStudy study(R"({"name": "asked", "participant_fields": [
      {"name": "sex", "question": {"de": "Geschlecht?", "en": "Sex?"}, "options": [
        {"value": "female", "label": {"de": "weiblich", "en": "a woman"}},
        {"value": "male", "label": {"de": "männlich", "en": "a man"}}]},
      {"name": "pseudonym", "question": {"en": "Known?"}, "options": [{"value": "yes"}]}],
    "stages": [{"kind": "questionnaire", "name": "about_you", "items": [
        {"name": "sex", "kind": "text", "question": {"en": "Which sex?"}}]}]})");
  study.add("P01");
  study.say("participant", "sex", "female");
  study.say("participant", "pseudonym", "yes");
  study.say("about_you", "sex", "none of them");
  export_bids(study.store(), out(""), {}, "");
  const auto rows = cells(out("participants.tsv"));
  EXPECT_EQ(rows[0], (std::vector<std::string>{"participant_id", "pseudonym", "data_origin",
                                               "num_sessions", "sex", "field_pseudonym"}));
  EXPECT_EQ(value(rows, 1, "sex"), "female");
  EXPECT_EQ(value(rows, 1, "pseudonym"), "P01");
  EXPECT_EQ(value(rows, 1, "field_pseudonym"), "yes");
  const nlohmann::json sidecar = json(out("participants.json"));
  EXPECT_EQ(sidecar["sex"]["Levels"],
            (nlohmann::json{{"female", "a woman"}, {"male", "a man"}}));
  EXPECT_EQ(sidecar["sex"]["Description"], "Sex?, as was known before the session");
  const auto form = cells(out("phenotype/aboutyou.tsv"));
  EXPECT_EQ(value(form, 1, "sex"), "none of them") << "the form keeps its own";
}

TEST_F(BidsExportTest, ScansNameFilesThatAreThere) {
  record();
  (void)write({.recordings = true});
  const auto rows = cells(out("sub-P01/ses-01/sub-P01_ses-01_scans.tsv"));
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t row = 1; row < rows.size(); ++row) {
    EXPECT_TRUE(fs::exists(out("sub-P01/ses-01/" + rows[row][0]))) << rows[row][0];
    EXPECT_EQ(rows[row][1], "n/a") << "a simulated session has no date";
  }
}

TEST_F(BidsExportTest, PilotsStayOutOfEverythingUnlessAskedFor) {
  (void)write({});
  for (const auto& entry : fs::recursive_directory_iterator(out(""))) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(read_file(entry.path()).find("PILOT"), std::string::npos) << entry.path();
  }
  (void)write({.pilot = true}, "with");
  EXPECT_TRUE(fs::exists(temporary_.path() / "with" / "sub-PILOT"));
  const core::StudyStore source(temporary_.path() / "with" / "sourcedata" / "jnd.study",
                                core::StudyStore::Mode::kReadOnly);
  EXPECT_EQ(source.sessions().size(), 2U);
}

TEST_F(BidsExportTest, TheSourceIsAStudyThatOpensAndIsStillAppendOnly) {
  record();
  (void)write({.recordings = true});
  const fs::path study = out("sourcedata/jnd.study");
  for (const char* ending : {"-wal", "-shm", "-journal"}) {
    EXPECT_FALSE(fs::exists(study / (std::string("study.sqlite") + ending)));
  }
  const core::StudyStore source(study, core::StudyStore::Mode::kReadOnly);
  ASSERT_EQ(source.sessions().size(), 1U);
  EXPECT_EQ(source.trials(1).size(), 1U);
  EXPECT_EQ(core::RecordingReader(source.recording_file(1)).missing_ticks(), 3);
  EXPECT_NE(read_file(study / "study.sqlite").find("trials are never deleted"),
            std::string::npos);
  EXPECT_EQ(read_file(out("sourcedata/study_files/by_hand.json")),
            source.protocols().front().text);
}

TEST_F(BidsExportTest, TheSourceKnowsNobodyWhoWasNotAskedFor) {
  const std::int64_t other = study_.add("P_77", /*pilot=*/false, R"({"name": "made"})");
  study_.report_adverse_event(other, "a pinched finger of another person");
  study_.happens("note_added", R"({"text": "a secret of P_77"})");
  // The original study is open for writing, so the appointment is added to a copy.
  const fs::path copy = temporary_.path() / "copy.study";
  fs::copy(study_.folder(), copy, fs::copy_options::recursive);
  (void)core::add_appointment(copy, "P_77", 1, 1);
  (void)export_bids(core::StudyStore(copy, core::StudyStore::Mode::kReadOnly), out(""),
                    {.selection = {.participants = {"P_01"}}}, R"({"study": "x"})");
  const std::string bytes = read_file(out("sourcedata/jnd.study/study.sqlite"));
  for (const char* told : {"P_77", "pinched", "secret"}) {
    EXPECT_EQ(bytes.find(told), std::string::npos) << told;
  }
  EXPECT_NE(bytes.find("P_01"), std::string::npos);
}

TEST_F(BidsExportTest, WhatWasMeasuredOfADeviceIsAmongItsSources) {
  (void)write({}, "without");
  EXPECT_FALSE(fs::exists(temporary_.path() / "without" / "sourcedata" / "device_profiles"));
  const std::string hash = study_.add_measured("P09", "{\"name\": \"left\"}\n");
  (void)write({});
  EXPECT_EQ(read_file(out("sourcedata/device_profiles/" + hash + ".device.json")),
            "{\"name\": \"left\"}\n");
  const core::StudyStore source(out("sourcedata/jnd.study"), core::StudyStore::Mode::kReadOnly);
  EXPECT_EQ(source.device_profile(hash).text, "{\"name\": \"left\"}\n");
}

TEST_F(BidsExportTest, TheSameStudyGivesTheSameBytes) {
  record();
  (void)write({.recordings = true});
  (void)write({.recordings = true}, "again");
  int num_files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out(""))) {
    if (!entry.is_regular_file()) continue;
    ++num_files;
    const fs::path other =
        temporary_.path() / "again" / fs::relative(entry.path(), temporary_.path() / "out");
    EXPECT_EQ(read_file(entry.path()), read_file(other)) << other;
  }
  EXPECT_GT(num_files, 15);
}

TEST_F(BidsExportTest, RefusesAStudyOfPilotsAloneAndLeavesNothing) {
  HandMadeStudy pilots;
  pilots.add("P01", /*pilot=*/true);
  EXPECT_THROW(export_bids(pilots.store(), out(""), {}, ""), core::Error);
  EXPECT_TRUE(fs::is_empty(temporary_.path()));
}

}  // namespace bids_export_test
}  // namespace jnd::analysis
