#include "experiments/protocol/stage_tables.h"

namespace jnd::experiments {

const ParameterTable& questionnaire_item_table() {
  static const std::vector<Condition> kOnlyScale = {{"kind", {"scale"}}};
  static const std::vector<Condition> kOnlyNumber = {{"kind", {"number"}}};
  static const ParameterTable kTable = {
      .name = "questionnaire_item",
      .meaning = "One question: of a questionnaire, or after every trial of a block.",
      .parameters = {
          {.key = "name",
           .kind = ValueKind::kName,
           .meaning = "Name of the answer in the data, unique in the study; of a question "
                      "after trials unique in its block, so that blocks can ask the same one. "
                      "A number's name ends in its unit: `body_height_m`."},
          {.key = "kind",
           .kind = ValueKind::kString,
           .meaning =
               "What an answer is: a number, free words, one of `options`, yes or no, yes "
               "or no and which, or a step on a scale.",
           .allowed = {"number", "text", "choice", "yes_no", "yes_no_which", "scale"}},
          {.key = "question",
           .kind = ValueKind::kText,
           .meaning = "What the participant is asked."},
          {.key = "required",
           .kind = ValueKind::kBoolean,
           .meaning = "Whether an answer is waited for; else it can be left out, which is "
                      "stored as `no_answer`.",
           .required = false,
           .default_json = "true"},
          {.key = "unit",
           .kind = ValueKind::kString,
           .meaning = "Unit of the number, shown behind it.",
           .required = false,
           .only_where = kOnlyNumber},
          {.key = "minimum",
           .kind = ValueKind::kNumber,
           .meaning = "The smallest number that can be true; a smaller one is asked again.",
           .required = false,
           .only_where = kOnlyNumber},
          {.key = "maximum",
           .kind = ValueKind::kNumber,
           .meaning = "The largest number that can be true; a larger one is asked again.",
           .required = false,
           .only_where = kOnlyNumber},
          {.key = "options",
           .kind = ValueKind::kObjects,
           .meaning = "The answers to choose from.",
           .min_items = 2,
           .max_items = 50,
           .nested = &option_table(),
           .only_where = {{"kind", {"choice"}}}},
          {.key = "num_steps",
           .kind = ValueKind::kInteger,
           .meaning = "Steps of the scale, counted from 1. An even number has no middle.",
           .required = false,
           .default_json = "10",
           .range = {2, 100},
           .only_where = kOnlyScale},
          {.key = "low_label",
           .kind = ValueKind::kText,
           .meaning = "What stands at step 1.",
           .only_where = kOnlyScale},
          {.key = "high_label",
           .kind = ValueKind::kText,
           .meaning = "What stands at the last step.",
           .only_where = kOnlyScale},
          {.key = "high_is_good",
           .kind = ValueKind::kBoolean,
           .meaning = "Whether the last step is the favourable end, so that scales printed in "
                      "different directions can be averaged. Absent: neither end is, and "
                      "results are told in the steps as they were printed.",
           .required = false,
           .only_where = kOnlyScale},
      }};
  return kTable;
}

const ParameterTable& questionnaire_table() {
  static const ParameterTable kTable = {
      .name = "questionnaire",
      .meaning = "Questions answered outside of any trial.",
      .example = R"json({"kind": "questionnaire", "name": "about_you",
  "instruction": {"en": "A few questions about you."},
  "items": [
    {"name": "body_height_m", "kind": "number", "unit": "m", "minimum": 1, "maximum": 2.5,
     "question": {"en": "How tall are you?"}},
    {"name": "handedness", "kind": "choice", "question": {"en": "Which hand do you write with?"},
     "options": [{"value": "right", "label": {"en": "right"}}, {"value": "left", "label": {"en": "left"}}]},
    {"name": "freedom", "kind": "scale", "question": {"en": "How free was your hand?"},
     "low_label": {"en": "very restricted"}, "high_label": {"en": "very free"}, "high_is_good": true}]})json",
      .parameters =
          stage_parameters("questionnaire", {{.key = "instruction",
                                              .kind = ValueKind::kText,
                                              .meaning = "What stands above the questions."},
                                             {.key = "items",
                                              .kind = ValueKind::kObjects,
                                              .meaning = "The questions, in order.",
                                              .nested = &questionnaire_item_table()}})};
  return kTable;
}

}  // namespace jnd::experiments
