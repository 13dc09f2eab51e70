#include "experiments/procedures/block_key.h"

#include <utility>

#include "experiments/study/media.h"
#include "experiments/study/order_table.h"

namespace jnd::experiments {
namespace {

BlockKey answer_label(const char* key, const char* meaning, std::vector<std::string> tasks) {
  return {.parameter = {.key = key,
                        .kind = ValueKind::kText,
                        .meaning = meaning,
                        .required = false,
                        .only_where = {{"task", std::move(tasks)}}}};
}

const ParameterTable& practice_table() {
  static const ParameterTable kTable = {
      .name = "practice",
      .meaning =
          "When a block that is practice ends: its trials are run and stored like any, "
          "and left out of results.",
      .parameters = {
          {.key = "min_correct_ratio",
           .kind = ValueKind::kNumber,
           .meaning = "Of the answers judged, so many have to be right: 0.8 is 8 of 10.",
           .range = {0.0, 1.0, true}},
          {.key = "num_trials_judged",
           .kind = ValueKind::kInteger,
           .meaning = "How many answers are judged: the last ones that could be right.",
           .range = {1, 1000}},
          {.key = "max_trials",
           .kind = ValueKind::kInteger,
           .meaning = "The block ends after so many trials though they were not; at least "
                      "`num_trials_judged`.",
           .range = {1, 1000}}}};
  return kTable;
}

}  // namespace

std::string BlockKey::name_for(const std::string& quantity) const {
  if (!names_quantity()) return parameter.key;
  return parameter.key.empty() ? quantity : parameter.key + '_' + quantity;
}

BlockKey amount_key(const char* name, const char* meaning, bool required) {
  return {.parameter = {.key = name,
                        .kind = ValueKind::kNumber,
                        .meaning = meaning,
                        .required = required},
          .of_quantity = true,
          .is_positive = true};
}

BlockKey whole_number_key(const char* name, const char* meaning, Range range,
                          const std::string& default_json) {
  return {.parameter = {.key = name,
                        .kind = ValueKind::kInteger,
                        .meaning = meaning,
                        .required = false,
                        .default_json = default_json,
                        .range = range}};
}

BlockKey stimuli_key() {
  return {
      .parameter = {.key = "",
                    .kind = ValueKind::kNumbers,
                    .meaning = "The test stimuli, or in `magnitude_production` and `matching` "
                               "the values that an adjustment starts from. Each repetition "
                               "shows every one of them once, in random order; in `matching` "
                               "once with every standard. No value may stand twice.",
                    .max_items = 200},
      .of_quantity = true};
}

BlockKey task_key() {
  return {.parameter = {
              .key = "task",
              .kind = ValueKind::kString,
              .meaning = "`reminder`: the reference first, then the test, and a question "
                         "that compares them. `yes_no`: the test alone, and whether it is "
                         "felt, for absolute thresholds. `two_interval`: reference and "
                         "test in drawn order, and in which interval there was more. "
                         "`same_different`: likewise, or the reference twice, and whether "
                         "they differed. `three_interval`: the test and the reference "
                         "twice, and which had more. `oddity`: one of the two once and the "
                         "other twice, and which was the odd one. `abx`: both, then one of "
                         "them again, and which of the two it was. `match_to_sample`: one of "
                         "them, then both, and which of the two it was. In these four every "
                         "order comes equally often, and what is measured is the share of "
                         "right answers, 1/3 or 1/2 by guessing.",
              .required = false,
              .default_json = R"("reminder")",
              .allowed = {"reminder", "yes_no", "two_interval", "same_different",
                          "three_interval", "oddity", "abx", "match_to_sample"}}};
}

BlockKey reference_key() {
  BlockKey key =
      amount_key("reference",
                 "The stimulus that every test stimulus is compared with; of "
                 "`constant_stimuli` between the smallest and the largest of them, of "
                 "`quest_plus` not beyond either, in `same_different`, `oddity`, `abx` and "
                 "`match_to_sample` none of them, in `three_interval` below all. Of a "
                 "`staircase` that aims at more "
                 "than 50 %, levels may all lie above it.");
  key.parameter.only_where = {{"task",
                               {"reminder", "two_interval", "same_different", "three_interval",
                                "oddity", "abx", "match_to_sample"}}};
  return key;
}

BlockKey interval_order_key() {
  return {.parameter = {.key = "interval_order",
                        .kind = ValueKind::kString,
                        .meaning = "Which interval holds the test. `random`: drawn in every "
                                   "trial by itself. `balanced`: over the repetitions each "
                                   "stimulus is in the first as often as in the second, or "
                                   "once more; where the next trial follows from the answers, "
                                   "in one of every two trials.",
                        .required = false,
                        .default_json = R"("random")",
                        .allowed = {"random", "balanced"},
                        .only_where = {{"task", {"two_interval", "same_different"}}}}};
}

BlockKey catch_trials_key() {
  return {.parameter = {.key = "catch_trials",
                        .kind = ValueKind::kInteger,
                        .meaning =
                            "Catch trials in each repetition, at random places: in `yes_no` "
                            "nothing is there, otherwise the test equals the reference. They "
                            "tell how often \"yes\" is said without cause, and are in no curve "
                            "of `reminder` and `two_interval`. Absent: none; in "
                            "`same_different` as many as there are test stimuli, so that half "
                            "of the trials are the same.",
                        .required = false,
                        .range = {0, 100}}};
}

BlockKey catch_probability_key() {
  return {.parameter = {.key = "catch_probability",
                        .kind = ValueKind::kNumber,
                        .meaning = "Every trial is a catch trial with this probability, so "
                                   "that none can be foreseen: in `yes_no` nothing is there, "
                                   "otherwise the test equals the reference. It moves no "
                                   "level and counts for no end of the block.",
                        .required = false,
                        .default_json = "0.0",
                        .range = {0.0, 0.5}}};
}

std::vector<BlockKey> right_answer_keys() {
  return {
      {.parameter = {.key = "feedback",
                     .kind = ValueKind::kBoolean,
                     .meaning =
                         "Whether participant and experimenter are told after each answer "
                         "if it was right. Where test and reference are equal, so that a "
                         "trial without feedback would be found out, \"not more\" is called "
                         "right in `reminder`, and of intervals the one that was drawn for "
                         "the answer. Not in a double-blind study.",
                     .required = false,
                     .default_json = "false"}},
      {.parameter = {.key = "practice",
                     .kind = ValueKind::kObject,
                     .meaning = "The block is practice, until enough answers are right; "
                                "its trials are no data.",
                     .required = false,
                     .nested = &practice_table()}}};
}

BlockKey cannot_tell_key() {
  return {
      .parameter = {.key = "cannot_tell",
                    .kind = ValueKind::kBoolean,
                    .meaning =
                        "Whether \"cannot tell\" is an answer, too. It is stored with its time "
                        "and without a response, is in no curve or rate, neither right nor "
                        "wrong nor half of either, and is counted in the results. `practice` "
                        "takes it for an answer that is not right. Adaptive procedures go by "
                        "every answer and have no such key.",
                    .required = false,
                    .default_json = "false"}};
}

std::vector<BlockKey> standard_keys() {
  BlockKey medium{.parameter = {.key = "standard_medium",
                                .kind = ValueKind::kString,
                                .meaning =
                                    "What is felt as the standard: in `matching` always, "
                                    "in `magnitude_estimation` where `modulus` is "
                                    "`standard`. It may be the medium of the block, or in "
                                    "`matching` a solid where the block's is a fluid; how "
                                    "far matches then lie from it is the constant "
                                    "error.",
                                .required = false,
                                .default_json = R"("none")",
                                .allowed = {"none"}}};
  for (const Medium& one : media()) {
    if (!one.quantity.empty()) medium.parameter.allowed.push_back(one.name);
  }
  BlockKey standards{.parameter = {.key = "standard",
                                   .kind = ValueKind::kNumbers,
                                   .meaning = "How much of `standard_medium` is felt as the "
                                              "standard: one value or several in `matching`, "
                                              "one in `magnitude_estimation`.",
                                   .max_items = 50},
                     .of_standard = true,
                     .is_positive = true};
  return {medium, standards};
}

BlockKey max_returns_key() {
  return {.parameter = {.key = "max_returns",
                        .kind = ValueKind::kInteger,
                        .meaning = "How often in a trial a stimulus may be presented that was "
                                   "presented before: 0 is each once. Absent: any number.",
                        .required = false,
                        .range = {0, 1000}}};
}

BlockKey repetitions_key() {
  return {.parameter = {.key = "repetitions",
                        .kind = ValueKind::kInteger,
                        .meaning = "How often every test stimulus is shown.",
                        .range = {1, 1000}}};
}

BlockKey order_key() {
  return {.parameter = {.key = "order",
                        .kind = ValueKind::kObject,
                        .meaning = "In which order the stimuli come. Absent: each repetition "
                                   "by itself in random order.",
                        .required = false,
                        .nested = &order_table()}};
}

std::vector<BlockKey> answer_label_keys() {
  const std::vector<std::string> one_question = {"reminder", "yes_no", "same_different"};
  const std::vector<std::string> first = {"two_interval", "three_interval", "oddity", "abx"};
  const std::vector<std::string> second = {"two_interval", "three_interval", "oddity", "abx",
                                           "match_to_sample"};
  const std::vector<std::string> third = {"three_interval", "oddity", "match_to_sample"};
  return {
      answer_label("yes_label", "What the answer that is stored as 1 is called: \"Thicker\".",
                   one_question),
      answer_label("no_label",
                   "What the answer that is stored as 0 is called: \"Not thicker\".",
                   one_question),
      answer_label("first_label", "What the first interval is called as an answer.", first),
      answer_label("second_label", "What the second interval is called as an answer.", second),
      answer_label("third_label", "What the third interval is called as an answer.", third)};
}

std::vector<BlockKey> step_keys() {
  return {amount_key("coarse_step", "How much one large step of the adjustment changes."),
          amount_key("fine_step",
                     "How much one small step changes; less than the large one. In `matching` "
                     "the least that can be set, unless a start is less."),
          amount_key(
              "max",
              "No step goes beyond this; at least the largest starting value. Absent: no end.",
              false)};
}

}  // namespace jnd::experiments
