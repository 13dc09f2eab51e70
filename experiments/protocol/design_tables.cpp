#include "experiments/protocol/design_tables.h"

#include "experiments/study/design.h"

namespace jnd::experiments {
namespace {

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const ContrastMeasure measure : contrast_measures()) names.push_back(to_string(measure));
  return names;
}

}  // namespace

const ParameterTable& factor_table() {
  static const ParameterTable kTable = {
      .name = "factor",
      .meaning =
          "Something that the study varies on purpose. Where its name is that of a `one_of` "
          "counterbalance or of a participant field, people differ in it, and its levels are "
          "the names of the arms or the values of the field. Otherwise everybody meets all of "
          "its levels, and each block says in `levels` which ones it has. Blocks with the same "
          "levels are one condition, and contrasts take their answers together.",
      .example = R"({"name": "fluid", "levels": ["thin", "thick"]})",
      .parameters = {
          {.key = "name",
           .kind = ValueKind::kName,
           .meaning = "Name of the factor, unlike that of any other. `block` is a factor that "
                      "every study has: each block is a level of it."},
          {.key = "levels",
           .kind = ValueKind::kStrings,
           .meaning = "Names of its levels, each of lower-case letters, digits and `_`.",
           .min_items = 2,
           .max_items = 20}}};
  return kTable;
}

const ParameterTable& contrast_table() {
  static const ParameterTable kTable = {
      .name = "contrast",
      .meaning =
          "A comparison of conditions that is planned before anybody takes part. The results "
          "tell planned contrasts first, and call every other comparison exploratory.",
      .example =
          R"json({"name": "thin_against_thick", "measure": "weber_fraction", "role": "primary",
  "of": {"fluid": {"thin": 1, "thick": -1}}, "direction": "greater", "smallest_effect": 1.25})json",
      .parameters = {
          {.key = "name",
           .kind = ValueKind::kName,
           .meaning = "Name of the contrast in results and report, unlike that of any other."},
          {.key = "hypothesis",
           .kind = ValueKind::kText,
           .meaning = "What is expected, in a sentence for readers of the report.",
           .required = false},
          {.key = "measure",
           .kind = ValueKind::kString,
           .meaning =
               "What the conditions are compared in. `weber_fraction`: blocks whose `task` is "
               "`reminder` or `two_interval`. `pse`, the point of subjective equality (a bias, "
               "priming, an aftereffect): blocks whose `task` is `reminder`. `exponent`: "
               "blocks "
               "of `magnitude_estimation` or `magnitude_production`. `magnitude`: blocks of "
               "`magnitude_estimation`. `match`: blocks of `matching`. `rating`, the mean "
               "step: "
               "blocks of `rating`. `question`, the mean answer to one of the `questions` "
               "after "
               "the trials, such as how sure somebody is: blocks that ask it, whatever their "
               "procedure. `response_time`: any blocks. Blocks of other tasks, such as "
               "`yes_no` "
               "and `oddity`, can be compared in `response_time` and `question` alone.",
           .allowed = measure_names()},
          {.key = "question",
           .kind = ValueKind::kName,
           .meaning = "Which question is compared: the `name` of one of the `questions` of the "
                      "blocks, of kind `scale`, `number` or `yes_no` (yes counts 1 and no 0).",
           .only_where = {{"measure", {"question"}}}},
          {.key = "of",
           .kind = ValueKind::kWeights,
           .meaning =
               "Factors with weights of their levels. Weights that add up to 0 compare: the "
               "weighted mean of the levels above 0 with that of the levels below 0. Of one "
               "such factor this is a main effect, of several their interaction. A factor "
               "whose "
               "weights are all above 0 restricts the contrast to these levels. Over the "
               "levels "
               "of factors that are not named the contrast takes the mean. `block` with the "
               "names of blocks compares any blocks."},
          {.key = "role",
           .kind = ValueKind::kString,
           .meaning = "`primary`: the study is there to answer it. `secondary`: it is planned, "
                      "too.",
           .allowed = {"primary", "secondary"}},
          {.key = "direction",
           .kind = ValueKind::kString,
           .meaning =
               "What is expected. `greater`: the levels with weights above 0 have more. "
               "`less`: they have less. Both make the test one-sided. `either`: the test "
               "is two-sided.",
           .required = false,
           .default_json = R"("either")",
           .allowed = {"either", "greater", "less"}},
          {.key = "smallest_effect",
           .kind = ValueKind::kNumber,
           .meaning =
               "Smallest effect of interest: of an `exponent`, a `rating` or a `question` a "
               "difference, of every other measure a ratio above 1 (1.25 stands for a quarter "
               "more and for a fifth less). "
               "With it, two one-sided tests tell whether the effect is smaller than that. "
               "Absent: nothing is said about equivalence.",
           .required = false,
           .range = {0.0, 1000.0, true}},
          {.key = "alpha",
           .kind = ValueKind::kNumber,
           .meaning = "How often the tests may err where nothing differs.",
           .required = false,
           .default_json = "0.05",
           .range = {0.0, 0.5, true}},
          {.key = "family",
           .kind = ValueKind::kName,
           .meaning = "Contrasts whose p values are adjusted together have the same word here. "
                      "Absent: the contrast is in a family with all others of its role that "
                      "name none.",
           .required = false},
          {.key = "correction",
           .kind = ValueKind::kString,
           .meaning = "How the p values of the family are adjusted; all of a family say the "
                      "same.",
           .required = false,
           .default_json = R"("holm")",
           .allowed = {"holm", "bonferroni", "none"}}}};
  return kTable;
}

const ParameterTable& sequential_table() {
  static const ParameterTable kTable = {
      .name = "sequential",
      .meaning =
          "Looks at the study before all have taken part, and the rule that ends it. After so "
          "many complete sessions `jnd look` tests one primary contrast by people's own values "
          "and says only \"go on\" or \"stop\". Results stay sealed until the rule has ended "
          "the study, and their estimates of that contrast are adjusted for the looks.",
      .example =
          R"({"contrast": "thin_against_thick", "looks": [12, 18, 24], "spending": "obrien_fleming"})",
      .parameters = {
          {.key = "contrast",
           .kind = ValueKind::kName,
           .meaning = "Name of the primary contrast that decides. It is alone in its `family`, "
                      "and its `alpha` and `direction` are those of the whole study."},
          {.key = "looks",
           .kind = ValueKind::kNumbers,
           .meaning =
               "After how many complete sessions the study is looked at, ascending. The last "
               "one is the largest number of participants, at which it ends in any case.",
           .range = {4.0, 100000.0},
           .min_items = 2,
           .max_items = 20},
          {.key = "spending",
           .kind = ValueKind::kString,
           .meaning =
               "How alpha is spent over the looks (Lan and DeMets 1983). `obrien_fleming`: "
               "hardly any of it early, so that the last test is nearly that of a study "
               "without looks. `pocock`: about as much at every look, so that large effects "
               "end the study earlier and small ones need more people.",
           .required = false,
           .default_json = R"("obrien_fleming")",
           .allowed = {"obrien_fleming", "pocock"}}}};
  return kTable;
}

Parameter levels_parameter() {
  return {.key = "levels",
          .kind = ValueKind::kLevels,
          .meaning =
              "Which level the block has of each of the study's `factors` that blocks "
              "differ in. A block without levels is in no contrast of these factors.",
          .required = false};
}

}  // namespace jnd::experiments
