#include "experiments/protocol/stage_tables.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/media.h"

#include <iterator>
#include <map>

namespace jnd::experiments {
namespace {

std::vector<Parameter> joined(std::vector<Parameter> first, std::vector<Parameter> second) {
  first.insert(first.end(), std::make_move_iterator(second.begin()),
               std::make_move_iterator(second.end()));
  return first;
}

Parameter text(std::string key, std::string meaning, bool required = true) {
  return {.key = std::move(key),
          .kind = ValueKind::kText,
          .meaning = std::move(meaning),
          .required = required};
}

const ParameterTable& checklist_item_table() {
  static const ParameterTable kTable = {
      .name = "checklist_item",
      .meaning = "One thing for the experimenter to do and tick off.",
      .parameters = {
          text("text", "What to do."),
          text("say", "What to say meanwhile, word for word, so that everyone hears the same.",
               false)}};
  return kTable;
}

const ParameterTable& exploration_table() {
  static const ParameterTable kTable = {
      .name = "exploration",
      .meaning = "A medium to feel for some time, outside of any trial.",
      .parameters = setting_parameters(
          {{.key = "duration_s",
            .kind = ValueKind::kNumber,
            .meaning = "How long.",
            .unit = "s",
            .range = {0.0, 3600.0, true}},
           text("say", "What the experimenter says meanwhile, word for word.", false)})};
  return kTable;
}

const ParameterTable& post_experiment_item_table() {
  static const ParameterTable kTable = {
      .name = "post_experiment_item",
      .meaning = "A medium to feel, and one question about it.",
      .parameters = joined(
          {{.key = "name",
            .kind = ValueKind::kName,
            .meaning = "Name of the answer in the data, unique in the study."}},
          setting_parameters(
              {text("instruction", "What the participant is asked to do."),
               text("question", "What the participant is asked."),
               {.key = "answer",
                .kind = ValueKind::kString,
                .meaning = "What an answer is: yes or no, free words, or a number of single "
                           "words.",
                .allowed = {"yes_no", "text", "words"}},
               {.key = "num_words",
                .kind = ValueKind::kInteger,
                .meaning = "How many words are asked for.",
                .range = {1, 20},
                .only_where = {{"answer", {"words"}}}}}))};
  return kTable;
}

const ParameterTable& counterbalance_table() {
  static const ParameterTable kTable = {
      .name = "counterbalance",
      .meaning =
          "Alternatives between participants. Several of them are crossed; each new "
          "participant gets the cell with the fewest completed sessions.",
      .example = R"json({"kind": "counterbalance", "name": "group_order", "method": "order",
  "arms": [
    {"name": "low", "stages": [{"kind": "break", "name": "a", "instruction": {"en": "A."}, "duration_s": 5}]},
    {"name": "high", "stages": [{"kind": "break", "name": "b", "instruction": {"en": "B."}, "duration_s": 5}]}],
  "between": [{"kind": "break", "name": "rest", "instruction": {"en": "Rest."}, "duration_s": 180}]})json",
      .parameters = stage_parameters(
          "counterbalance",
          {{.key = "method",
            .kind = ValueKind::kString,
            .meaning =
                "`order`: everyone gets every arm, the order differs (every order of 2 "
                "or 3 arms, a Williams square of more). `latin`: the same with as many orders "
                "as arms, the rows of a cyclic Latin square: every arm stands equally often "
                "in every place, but the same arms follow each other. `one_of`: everyone gets "
                "one arm.",
            .allowed = {"order", "latin", "one_of"}},
           {.key = "stratify_by",
            .kind = ValueKind::kString,
            .meaning = "The name of one of the study's `participant_fields`: the alternatives "
                       "are given equally often to the participants of each of its values. "
                       "Absent: to all participants together.",
            .required = false},
           {.key = "arms",
            .kind = ValueKind::kObjects,
            .meaning = "The alternatives.",
            .min_items = 2,
            .max_items = 12,
            .nested = &arm_table()},
           {.key = "between",
            .kind = ValueKind::kStages,
            .meaning = "What happens between two arms, for example a break.",
            .required = false,
            .min_items = 0,
            .only_where = {{"method", {"order", "latin"}}}}})};
  return kTable;
}

const ParameterTable& checklist_table() {
  static const ParameterTable kTable = {
      .name = "checklist",
      .meaning = "What the experimenter does, point by point; each is ticked off and stored.",
      .example = R"json({"kind": "checklist", "name": "before",
  "items": [{"text": {"en": "Greet the participant."}, "say": {"en": "Thank you for coming."}}]})json",
      .parameters = stage_parameters("checklist", {{.key = "items",
                                                    .kind = ValueKind::kObjects,
                                                    .meaning = "The points, in order.",
                                                    .nested = &checklist_item_table()}})};
  return kTable;
}

const ParameterTable& consent_table() {
  static const ParameterTable kTable = {
      .name = "consent",
      .meaning = "What the participant reads and agrees to before anything else.",
      .example = R"json({"kind": "consent", "name": "consent",
  "paragraphs": [{"en": "You will move your hand through virtual fluids for one hour."}],
  "agreement": {"en": "I have read this and take part of my own free will."}})json",
      .parameters = stage_parameters(
          "consent", {{.key = "paragraphs",
                       .kind = ValueKind::kTexts,
                       .meaning = "The information, paragraph by paragraph."},
                      text("agreement", "The one sentence that is agreed to.")})};
  return kTable;
}

const ParameterTable& explore_table() {
  static const ParameterTable kTable = {
      .name = "explore",
      .meaning = "Free exploration before anything is asked, for example of free space.",
      .example = R"json({"kind": "explore", "name": "free_space",
  "instruction": {"en": "Move about and get used to the device."},
  "media": [{"medium": "free_space", "duration_s": 150}]})json",
      .parameters = stage_parameters(
          "explore", {text("instruction", "What the participant is asked to do."),
                      {.key = "media",
                       .kind = ValueKind::kObjects,
                       .meaning = "The media, one after the other.",
                       .nested = &exploration_table()}})};
  return kTable;
}

const ParameterTable& training_table() {
  static const ParameterTable kTable = {
      .name = "training",
      .meaning = "Example stimuli that show the range to come; nothing is scored.",
      .example = R"json({"kind": "training", "name": "examples",
  "instruction": {"en": "Feel these examples."},
  "examples": [{"medium": "water", "scale": 0.5, "duration_s": 20},
               {"medium": "viscous", "viscosity_pa_s": 10, "duration_s": 20}]})json",
      .parameters = stage_parameters(
          "training", {text("instruction", "What the participant is asked to do."),
                       {.key = "examples",
                        .kind = ValueKind::kObjects,
                        .meaning = "The examples, one after the other.",
                        .nested = &exploration_table()}})};
  return kTable;
}

const ParameterTable& break_table() {
  static const ParameterTable kTable = {
      .name = "break",
      .meaning = "A rest, with the hand free of the device.",
      .example = R"json({"kind": "break", "name": "rest",
  "instruction": {"en": "Take your hand out and rest."}, "duration_s": 180})json",
      .parameters = stage_parameters(
          "break", {text("instruction", "What the participant is told."),
                    {.key = "duration_s",
                     .kind = ValueKind::kNumber,
                     .meaning = "The least rest; the experimenter may give more.",
                     .unit = "s",
                     .range = {0.0, 7200.0}}})};
  return kTable;
}

const ParameterTable& post_experiment_table() {
  static const ParameterTable kTable = {
      .name = "post_experiment",
      .meaning = "A few media to feel after the experiment, each with a question.",
      .example = R"json({"kind": "post_experiment", "name": "afterwards", "items": [
  {"name": "is_it_solid", "medium": "solid", "stiffness_n_per_m": 1000,
   "instruction": {"en": "Lower your hand until you touch something."},
   "question": {"en": "Is it solid?"}, "answer": "yes_no"},
  {"name": "fluid_words", "medium": "viscous", "viscosity_pa_s": 16,
   "instruction": {"en": "Move your hand."},
   "question": {"en": "Which three words describe it?"}, "answer": "words", "num_words": 3}]})json",
      .parameters = stage_parameters("post_experiment",
                                     {{.key = "items",
                                       .kind = ValueKind::kObjects,
                                       .meaning = "The media and their questions, in order.",
                                       .nested = &post_experiment_item_table()}})};
  return kTable;
}

}  // namespace

const ParameterTable& arm_table() {
  static const ParameterTable kTable = {
      .name = "arm",
      .meaning = "One alternative of a counterbalance.",
      .parameters = {{.key = "name",
                      .kind = ValueKind::kName,
                      .meaning = "Name of the arm in the data, unique in its counterbalance."},
                     {.key = "stages",
                      .kind = ValueKind::kStages,
                      .meaning = "What happens in this arm; may be empty with `one_of`. A "
                                 "counterbalance cannot stand inside an arm.",
                      .min_items = 0}}};
  return kTable;
}

std::vector<Parameter> stage_parameters(const std::string& kind, std::vector<Parameter> own) {
  std::vector<Parameter> parameters = {
      {.key = "kind",
       .kind = ValueKind::kString,
       .meaning = "What kind of stage this is.",
       .allowed = {kind}},
      {.key = "name",
       .kind = ValueKind::kName,
       .meaning = "Name of the stage in the data, unique in the study."},
      text("title", "Heading of the stage for the experimenter.", false)};
  // A counterbalance runs for everyone, because its arms are the choice.
  if (kind != "counterbalance") {
    parameters.push_back(
        {.key = "only_for",
         .kind = ValueKind::kArms,
         .meaning = "Runs only for participants of this arm: name of a `one_of` counterbalance "
                    "and name of its arm. With several counterbalances only for those who have "
                    "every one of these arms. Absent: runs for everyone.",
         .required = false});
  }
  return joined(std::move(parameters), std::move(own));
}

std::vector<Parameter> setting_parameters(std::vector<Parameter> own) {
  std::vector<Parameter> parameters = {
      {.key = "medium", .kind = ValueKind::kString, .meaning = "What is felt."}};
  std::map<std::string, std::size_t> index_of;  // Two media may share a quantity.
  for (const Medium& entry : media()) {
    parameters.front().allowed.push_back(entry.name);
    if (entry.quantity.empty()) continue;
    if (const auto known = index_of.find(entry.quantity); known != index_of.end()) {
      parameters[known->second].only_where.front().values.push_back(entry.name);
      continue;
    }
    index_of[entry.quantity] = parameters.size();
    parameters.push_back({.key = entry.quantity,
                          .kind = ValueKind::kNumber,
                          .meaning = "How much of it: " + entry.meaning + ".",
                          .unit = quantity_unit(entry.quantity),
                          .range = entry.range,
                          .only_where = {{"medium", {entry.name}}}});
  }
  for (const Parameter& detail : medium_details()) parameters.push_back(detail);
  return joined(std::move(parameters), std::move(own));
}

const std::vector<const ParameterTable*>& stage_tables() {
  static const std::vector<const ParameterTable*> kTables = {
      &checklist_table(),     &consent_table(),         &explore_table(),
      &training_table(),      &block_table(),           &interleaved_table(),
      &break_table(),         &post_experiment_table(), &questionnaire_table(),
      &counterbalance_table()};
  return kTables;
}

}  // namespace jnd::experiments
