#include "experiments/protocol/stage_tables.h"

namespace jnd::experiments {

const ParameterTable& option_table() {
  static const ParameterTable kTable = {
      .name = "option",
      .meaning = "One answer to choose from.",
      .parameters = {{.key = "value",
                      .kind = ValueKind::kName,
                      .meaning = "What is stored, whatever the language shown."},
                     {.key = "label",
                      .kind = ValueKind::kText,
                      .meaning = "What the participant reads."}}};
  return kTable;
}

const ParameterTable& participant_field_table() {
  static const ParameterTable kTable = {
      .name = "participant_field",
      .meaning =
          "What is known of a participant before the session begins, so that what follows can "
          "be balanced within it. What is only asked, a `questionnaire` asks.",
      .example =
          R"json({"name": "handedness", "question": {"en": "Which hand do you write with?"},
  "options": [{"value": "right", "label": {"en": "right"}}, {"value": "left", "label": {"en": "left"}}]})json",
      .parameters = {
          {.key = "name",
           .kind = ValueKind::kName,
           .meaning = "Name of the field in the data, unlike that of any stage, question or "
                      "other field. `jnd run` takes its value: `--field handedness=left`."},
          {.key = "question",
           .kind = ValueKind::kText,
           .meaning = "What the experimenter is asked while a session is prepared."},
          {.key = "options",
           .kind = ValueKind::kObjects,
           .meaning = "What the value can be.",
           .min_items = 2,
           .max_items = 20,
           .nested = &option_table()}}};
  return kTable;
}

}  // namespace jnd::experiments
