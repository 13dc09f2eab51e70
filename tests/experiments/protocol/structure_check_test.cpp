#include "experiments/protocol/structure_check.h"

#include <gtest/gtest.h>

#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace structure_check_test {

TEST(StructureCheck, FindsNothingWrongWithASoundStudy) {
  EXPECT_EQ(problems_of(kSoundStudy), "");
}

TEST(StructureCheck, ReportsAMisspelledKeyAndTheOneThatIsMissing) {
  EXPECT_EQ(problems_of(broken("\"repetitions\": 3", "\"repetitons\": 3")),
            "x.json:13:5: /stages/1/repetitions: expected a whole number >= 1 and <= 1000, "
            "found nothing\n"
            "x.json:14:45: /stages/1/repetitons: expected a key of `block`, found the unknown "
            "key `repetitons`; did you mean `repetitions`?");
}

TEST(StructureCheck, ReportsEveryProblemOfAFileInTheOrderOfItsLines) {
  std::string text = broken("\"name\": \"sound\"", "\"name\": \"Sound!\"");
  text = broken("\"format\": 1", "\"format\": 2", text);
  text = broken("\"duration_s\": 180", "\"duration_s\": -1", text);
  EXPECT_EQ(problems_of(text),
            "x.json:2:13: /format: expected 1, found 2\n"
            "x.json:3:11: /name: expected a name of at most 64 lower-case letters, digits and "
            "_, found "
            "the text \"Sound!\"\n"
            "x.json:31:71: /stages/2/between/0/duration_s: expected a number >= 0 and <= 7200 "
            "(s), found -1");
}

TEST(StructureCheck, CoercesNothing) {
  EXPECT_EQ(problems_of(broken("\"repetitions\": 3", "\"repetitions\": 3.0")),
            "x.json:14:60: /stages/1/repetitions: expected a whole number >= 1 and <= 1000, "
            "found 3.0");
  EXPECT_EQ(problems_of(broken("\"repetitions\": 3", "\"repetitions\": \"3\"")),
            "x.json:14:60: /stages/1/repetitions: expected a whole number >= 1 and <= 1000, "
            "found the text \"3\"");
  EXPECT_EQ(problems_of(broken("\"high_is_good\": true", "\"high_is_good\": 1")),
            "x.json:41:25: /stages/3/items/2/high_is_good: expected true or false, found 1");
  EXPECT_EQ(problems_of(broken("\"blinding\": \"none\"", "\"blinding\": null")),
            "x.json:7:15: /blinding: expected `none`, `participant` or `double`, found null");
}

TEST(StructureCheck, HoldsNumbersToTheirRange) {
  EXPECT_EQ(problems_of(broken("\"repetitions\": 3", "\"repetitions\": 0")),
            "x.json:14:60: /stages/1/repetitions: expected a whole number >= 1 and <= 1000, "
            "found 0");
  EXPECT_EQ(problems_of(broken("[0, 1, 2]", "[0, -1, 250]")),
            "x.json:14:38: /stages/1/scale/1: expected a number >= 0 and <= 99, found -1\n"
            "x.json:14:42: /stages/1/scale/2: expected a number >= 0 and <= 99, found 250");
}

TEST(StructureCheck, TakesNoViscosityOfZeroAndNoneInMilliPascalSeconds) {
  EXPECT_EQ(problems_of(broken("[10.5, 20]", "[0, 20]")),
            "x.json:26:50: /stages/2/arms/1/stages/0/viscosity_pa_s/0: expected a number > 0 "
            "and <= 1000 (Pa s), found 0");
  EXPECT_EQ(problems_of(broken("[10.5, 20]", "[10.5, 20000]")),
            "x.json:26:56: /stages/2/arms/1/stages/0/viscosity_pa_s/1: expected a number > 0 "
            "and <= 1000 (Pa s), found 20000");
}

TEST(StructureCheck, WantsTheQuantityOfTheMedium) {
  EXPECT_EQ(problems_of(broken("\"scale\": [0, 1, 2]", "\"viscosity_pa_s\": [1, 2]")),
            "x.json:13:5: /stages/1/scale: expected a list of one or more numbers, found "
            "nothing\n"
            "x.json:14:25: /stages/1/viscosity_pa_s: expected this key only where `medium` is "
            "`viscous`, `viscous_stokes`, `viscous_sphere`, `viscous_schiller_naumann` or "
            "`viscous_ellipsoid`, "
            "found it where `medium` is `water`");
}

TEST(StructureCheck, WantsWhatTheProcedureNeedsAndNothingOfAnother) {
  EXPECT_EQ(
      problems_of(broken(", \"reference_viscosity_pa_s\": 16", "")),
      "x.json:25:9: /stages/2/arms/1/stages/0/reference_viscosity_pa_s: expected a number "
      "> 0 and <= 1000 (Pa s), found nothing");
  EXPECT_EQ(problems_of(broken("\"target_percent\": [100, 50],", "")),
            "x.json:19:9: /stages/2/arms/0/stages/0/target_percent: expected a list of one or "
            "more numbers, found nothing");
  EXPECT_EQ(problems_of(broken("\"coarse_step_scale\": 0.5, \"fine_step_scale\": 0.1, ", "")),
            "x.json:19:9: /stages/2/arms/0/stages/0/coarse_step_scale: expected a number > 0 "
            "and <= 99, found nothing\n"
            "x.json:19:9: /stages/2/arms/0/stages/0/fine_step_scale: expected a number > 0 and "
            "<= 99, found nothing");
  EXPECT_EQ(
      problems_of(broken("\"repetitions\": 3", "\"repetitions\": 3, \"target_percent\": [50]")),
      "x.json:14:63: /stages/1/target_percent: expected this key only where `procedure` is "
      "`magnitude_production`, found it where `procedure` is `magnitude_estimation`");
}

TEST(StructureCheck, NamesTheNearestMediumProcedureAndStage) {
  EXPECT_EQ(problems_of(broken("\"medium\": \"viscous\"", "\"medium\": \"viscuos\"")),
            "x.json:26:20: /stages/2/arms/1/stages/0/medium: expected `water`, `viscous`, "
            "`viscous_stokes`, `viscous_sphere`, `water_map`, `viscous_schiller_naumann`, "
            "`viscous_ellipsoid` or "
            "`solid`, found `viscuos`; did you mean `viscous`?");
  EXPECT_EQ(problems_of(broken("\"constant_stimuli\"", "\"constant_stimulus\"")),
            "x.json:25:62: /stages/2/arms/1/stages/0/procedure: expected "
            "`magnitude_estimation`, `magnitude_production`, `matching`, `rating`, "
            "`constant_stimuli`, `limits`, `staircase` or `quest_plus`, found "
            "`constant_stimulus`; did you mean `constant_stimuli`?");
  EXPECT_EQ(problems_of(broken("\"kind\": \"break\"", "\"kind\": \"brake\"")),
            "x.json:11:18: /stages/0/arms/0/stages/0/kind: expected `checklist`, `consent`, "
            "`explore`, `training`, `block`, `interleaved`, `break`, `post_experiment`, "
            "`questionnaire` or "
            "`counterbalance`, found `brake`; did you mean `break`?");
}

TEST(StructureCheck, WantsTextsInEveryLanguageOfTheStudy) {
  EXPECT_EQ(problems_of(broken("{\"en\": \"Say.\", \"de\": \"Sag.\"}", "{\"en\": \"Say.\"}")),
            "x.json:15:21: /stages/1/instruction/de: expected the text in `de` too, as "
            "`languages` says, found nothing");
  EXPECT_EQ(problems_of(broken("\"de\": \"Sag.\"}", "\"de\": \" \", \"fr\": \"Dis.\"}")),
            "x.json:15:42: /stages/1/instruction/de: expected a text in quotes, found the text "
            "\" \"\n"
            "x.json:15:47: /stages/1/instruction/fr: expected one of the study's `languages` "
            "(`en` or `de`), found `fr`");
}

TEST(StructureCheck, ShowsHowATextIsWrittenWhereItFindsABareOne) {
  EXPECT_EQ(problems_of(broken("{\"en\": \"Say.\", \"de\": \"Sag.\"}", "\"Say.\"")),
            "x.json:15:21: /stages/1/instruction: expected a text by language such as "
            "{\"en\": \"Say.\"}, found the text \"Say.\"");
}

TEST(StructureCheck, ChecksTheListOfLanguages) {
  EXPECT_EQ(
      problems_of(broken("[\"en\", \"de\"]", "[\"en\", \"german\"]")),
      "x.json:4:23: /languages/1: expected a code of two or three lower-case letters such "
      "as `en`, found the text \"german\"");
  EXPECT_EQ(problems_of(broken("[\"en\", \"de\"]", "[\"en\", \"de\", \"en\"]")),
            "x.json:4:29: /languages/2: expected each language once, found `en` a second time");
}

TEST(StructureCheck, WantsListsThatAreNotEmpty) {
  EXPECT_EQ(problems_of(broken("[0, 1, 2]", "[]")),
            "x.json:14:34: /stages/1/scale: expected a list of one or more numbers, found an "
            "empty list");
  EXPECT_EQ(problems_of(broken(",\n                    {\"value\": \"left\", \"label\": "
                               "{\"en\": \"left\", \"de\": \"links\"}}",
                               "")),
            "x.json:37:20: /stages/3/items/1/options: expected a list of 2 or more objects, "
            "found a list of 1");
}

TEST(StructureCheck, ReadsTheNeedsOfTheDevice) {
  EXPECT_EQ(problems_of(broken("\"blinding\": \"none\"",
                               "\"device\": {\"rate_hz\": 10, \"min_contact_points\": 6,"
                               " \"immersion\": {\"radius_m\": 0}}")),
            "x.json:7:25: /device/rate_hz: expected a number >= 100 and <= 10000 (Hz), found "
            "10\n"
            "x.json:7:51: /device/min_contact_points: expected a whole number >= 1 and <= 5, "
            "found 6\n"
            "x.json:7:80: /device/immersion/radius_m: expected a number > 0 and <= 100 (m), "
            "found 0");
}

TEST(StructureCheck, AllowsACommentInEveryObject) {
  std::string text =
      broken("{\"priming\": \"primed\"}", "{\"comment\": \"c\", \"priming\": \"primed\"}");
  text = broken("\"format\": 1", "\"comment\": \"c\", \"$schema\": \"s.json\", \"format\": 1",
                text);
  text = broken("{\"en\": \"Say.\"", "{\"comment\": \"c\", \"en\": \"Say.\"", text);
  text = broken("{\"value\": \"right\"", "{\"comment\": \"c\", \"value\": \"right\"", text);
  EXPECT_EQ(problems_of(text), "");
  EXPECT_EQ(problems_of(broken("\"format\": 1", "\"comment\": 1, \"format\": 1")),
            "x.json:2:14: /comment: expected a text in quotes, found 1");
  EXPECT_EQ(
      problems_of(broken("\"kind\": \"break\"", "\"$schema\": \"s\", \"kind\": \"break\"")),
      "x.json:11:10: /stages/0/arms/0/stages/0/$schema: expected a key of `break`, found "
      "the unknown key `$schema`; `$schema` is a key of `study` (the whole file)");
}

TEST(StructureCheck, WantsObjectsWhereObjectsBelong) {
  EXPECT_EQ(problems_of("[]"), "x.json:1:1: /: expected an object, found an empty list");
  EXPECT_EQ(problems_of(broken("{\"priming\": \"primed\"}", "\"primed\"")),
            "x.json:30:54: /stages/2/between/0/only_for: expected an object such as "
            "{\"priming\": \"primed\"}, found the text \"primed\"");
  EXPECT_EQ(problems_of(broken("\"stages\": []", "\"stages\": [3]")),
            "x.json:12:39: /stages/0/arms/1/stages/0: expected a stage, an object with `kind`, "
            "found 3");
}

}  // namespace structure_check_test
}  // namespace jnd::experiments
