#include <gtest/gtest.h>

#include <map>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/tiny_study.h"
#include "core/storage/study_store.h"
#include "support/program.h"

namespace jnd::app {
namespace participant_fields_test {

using test_support::ProgramOutcome;

/// Returns a study of ten trials, which gives each arm to half of the women and half of the
/// men.
std::string stratified_study() {
  const std::string fields = R"json("participant_fields": [
    {"name": "sex", "question": {"en": "Sex?"}, "options": [
      {"value": "female", "label": {"en": "female"}}, {"value": "male", "label": {"en": "male"}}]}],
  "stages": [
    {"kind": "counterbalance", "name": "priming", "method": "one_of", "stratify_by": "sex",
     "arms": [{"name": "primed", "stages": [
       {"kind": "break", "name": "bucket", "instruction": {"en": "Stir."}, "duration_s": 1}]},
       {"name": "unprimed", "stages": []}]},)json";
  return replaced(kTinyStudy, "\"stages\": [", fields);
}

class ParticipantFieldsTest : public CommandTest {
 protected:
  ParticipantFieldsTest() { write_file(temporary_.path() / "study.json", stratified_study()); }

  ProgramOutcome run(const std::string& participant, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"run",        "study.json",    "--study",
                                      "s.study",    "--participant", participant,
                                      "--headless", "--seed",        "3"};
    words.insert(words.end(), more.begin(), more.end());
    return jnd(words);
  }
  [[nodiscard]] core::StudyStore store() const {
    return {temporary_.path() / "s.study", core::StudyStore::Mode::kReadOnly};
  }
};

TEST_F(ParticipantFieldsTest, ASessionWantsThemAndKeepsThem) {
  ASSERT_EQ(run("P01", {"--field", "sex=female"}).exit_code, 0);
  const core::StudyStore stored = store();
  EXPECT_TRUE(stored.session(1).cells.starts_with("sex=female;priming="));
  const core::EventRow begin = stored.events(1).front();
  EXPECT_EQ(begin.kind, "session_started");
  EXPECT_EQ(nlohmann::json::parse(begin.data)["fields"]["sex"], "female");
  const std::vector<core::AnswerRow> answers = stored.answers(1);
  ASSERT_FALSE(answers.empty());
  EXPECT_EQ(answers.front().stage, "participant");
  EXPECT_EQ(answers.front().item, "sex");
  EXPECT_EQ(answers.front().answer, "female");
  EXPECT_EQ(jnd({"verify", "s.study"}).exit_code, 0);
}

TEST_F(ParticipantFieldsTest, ASessionWithoutThemOrWithOthersDoesNotBegin) {
  const std::map<std::string, std::vector<std::string>> wrong = {
      {"--field: expected `sex=VALUE`, VALUE being `female` or `male`, found nothing", {}},
      {"--field: expected `sex=VALUE`, VALUE being `female` or `male`, found `woman`",
       {"--field", "sex=woman"}},
      {"--field: expected a field of the study `tiny`, found `age`",
       {"--field", "sex=male", "--field", "age=30"}},
      {"--field: expected each field once, found `sex` a second time",
       {"--field", "sex=male", "--field", "sex=male"}},
      {"--field: expected NAME=VALUE, found `male`", {"--field", "male"}}};
  for (const auto& [sentence, options] : wrong) {
    const ProgramOutcome outcome = run("P01", options);
    EXPECT_EQ(outcome.exit_code, 2) << sentence;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(temporary_.path() / "s.study"));
}

TEST_F(ParticipantFieldsTest, ArmsEvenOutAmongThoseWhoBringTheSame) {
  std::map<std::string, int> cells;
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(run("W" + std::to_string(i), {"--field", "sex=female"}).exit_code, 0);
  }
  ASSERT_EQ(run("M1", {"--field", "sex=male"}).exit_code, 0);
  ASSERT_EQ(run("M2", {"--field", "sex=male"}).exit_code, 0);
  for (const core::SessionRow& row : store().sessions()) ++cells[row.cells];
  EXPECT_EQ(cells, (std::map<std::string, int>{{"sex=female;priming=primed", 2},
                                               {"sex=female;priming=unprimed", 2},
                                               {"sex=male;priming=primed", 1},
                                               {"sex=male;priming=unprimed", 1}}));
}

TEST_F(ParticipantFieldsTest, APlanForetellsWhatSimulatedParticipantsBring) {
  const ProgramOutcome planned =
      jnd({"plan", "study.json", "--participants", "6", "--seed", "5", "--json"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  const ProgramOutcome simulated = jnd({"simulate", "study.json", "--participants", "6",
                                        "--seed", "5", "--study", "s.study", "--fast"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  std::vector<std::string> foretold, stored;
  const auto plan = document(planned.out);
  for (const auto& participant : plan["participants"]) {
    foretold.push_back(participant["cells"]);
  }
  for (const core::SessionRow& row : store().sessions()) stored.push_back(row.cells);
  EXPECT_EQ(foretold, stored);
  const auto of_men =
      document(jnd({"plan", "study.json", "--field", "sex=male", "--json"}).out);
  for (const auto& participant : of_men["participants"]) {
    EXPECT_TRUE(participant["cells"].get<std::string>().starts_with("sex=male;"));
  }
}

}  // namespace participant_fields_test
}  // namespace jnd::app
