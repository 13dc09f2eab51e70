#include <algorithm>

#include "experiments/procedures/procedure_registry.h"
#include "experiments/protocol/design_tables.h"
#include "experiments/protocol/sound_tables.h"
#include "experiments/protocol/stage_tables.h"
#include "experiments/study/media.h"

namespace jnd::experiments {
namespace {

/// Returns what a block can vary: every medium but free space.
std::vector<Medium> block_media() {
  std::vector<Medium> found;
  for (const Medium& one : media()) {
    if (!one.quantity.empty()) found.push_back(one);
  }
  return found;
}

Parameter procedure_parameter() {
  Parameter parameter{.key = "procedure",
                      .kind = ValueKind::kString,
                      .meaning = "How the stimuli are asked about."};
  for (const Procedure* procedure : procedures()) {
    parameter.allowed.emplace_back(procedure->name());
    parameter.meaning += " `" + parameter.allowed.back() + "`: " + procedure->meaning();
  }
  return parameter;
}

Parameter medium_parameter() {
  Parameter parameter{.key = "medium", .kind = ValueKind::kString, .meaning = "What is felt."};
  for (const Medium& one : block_media()) {
    parameter.allowed.push_back(one.name);
    parameter.meaning += " `" + one.name + "`: " + one.about;
  }
  return parameter;
}

/// Returns the values of the condition if `parameters` has this key, or nullptr.
std::vector<std::string>* words_of(std::vector<Parameter>& parameters, const std::string& key,
                                   std::size_t condition) {
  const auto known = std::ranges::find(parameters, key, &Parameter::key);
  return known == parameters.end() ? nullptr : &known->only_where[condition].values;
}

void add_word(std::vector<std::string>& words, const std::string& word) {
  if (std::ranges::find(words, word) == words.end()) words.push_back(word);
}

/// Adds the key as blocks of this medium, or with this standard, have it. If another procedure
/// or a medium of the same quantity already has the key, it becomes valid for these blocks as
/// well.
void add_key(std::vector<Parameter>& parameters, const BlockKey& key,
             const std::string& procedure, const Medium& medium) {
  const std::string name = key.name_for(medium.quantity);
  if (std::vector<std::string>* known = words_of(parameters, name, 0)) {
    add_word(*known, procedure);
    if (key.names_quantity()) add_word(*words_of(parameters, name, 1), medium.name);
    return;
  }
  Parameter parameter = key.parameter;
  parameter.key = name;
  parameter.only_where = {{"procedure", {procedure}}};
  if (key.names_quantity()) {
    parameter.unit = quantity_unit(medium.quantity);
    parameter.range = medium.range;
    if (key.is_positive) parameter.range.low_is_open = true;
    parameter.only_where.push_back(
        {key.of_standard ? "standard_medium" : "medium", {medium.name}});
  }
  const std::vector<Condition>& more = key.parameter.only_where;
  parameter.only_where.insert(parameter.only_where.end(), more.begin(), more.end());
  parameters.push_back(std::move(parameter));
}

/// Keys that name a quantity come first, quantity by quantity.
std::vector<Parameter> procedure_parameters() {
  std::vector<Parameter> of_quantities, others;
  for (const Medium& medium : block_media()) {
    for (const Procedure* procedure : procedures()) {
      for (const BlockKey& key : procedure->keys()) {
        add_key(key.names_quantity() ? of_quantities : others, key,
                std::string(procedure->name()), medium);
      }
    }
  }
  for (const Parameter& detail : medium_details()) of_quantities.push_back(detail);
  of_quantities.insert(of_quantities.end(), others.begin(), others.end());
  return of_quantities;
}

}  // namespace

const ParameterTable& block_table() {
  static const ParameterTable kTable = [] {
    std::vector<Parameter> own = {procedure_parameter(), medium_parameter()};
    for (Parameter& parameter : procedure_parameters()) own.push_back(std::move(parameter));
    own.push_back(levels_parameter());
    own.push_back({.key = "instruction",
                   .kind = ValueKind::kText,
                   .meaning = "What the participant is told before the block."});
    own.push_back({.key = "question",
                   .kind = ValueKind::kText,
                   .meaning = "What the participant is asked in every trial."});
    own.push_back({.key = "questions",
                   .kind = ValueKind::kObjects,
                   .meaning =
                       "What is asked besides, after the answer to every trial and before "
                       "the next one: how sure somebody is, how pleasant it felt. They "
                       "are answered in this order, each is on disk before the next, and "
                       "feedback is told after the last. An answer to the trial that is "
                       "taken back takes them with it.",
                   .required = false,
                   .max_items = 20,
                   .nested = &questionnaire_item_table()});
    own.push_back(masking_noise_parameter(/*of_block=*/true));
    own.push_back(cues_parameter(/*of_block=*/true));
    own.push_back({.key = "free_space_between_s",
                   .kind = ValueKind::kNumber,
                   .meaning = "Free space before each trial.",
                   .required = false,
                   .default_json = "0.0",
                   .unit = "s",
                   .range = {0.0, 600.0}});
    own.push_back({.key = "min_stimulus_s",
                   .kind = ValueKind::kNumber,
                   .meaning = "How long a stimulus has to be felt before the trial is answered "
                              "or goes on: to another stimulus, to free space, or by a step of "
                              "an adjustment. A pause and the emergency stop do not wait.",
                   .required = false,
                   .default_json = "0.0",
                   .unit = "s",
                   .range = {0.0, 600.0}});
    own.push_back({.key = "max_stimulus_s",
                   .kind = ValueKind::kNumber,
                   .meaning =
                       "How long a stimulus is felt at most, from step to step of an "
                       "adjustment: then free space comes back over the device's "
                       "`ramp_s`. With `min_stimulus_s` of the same value every stimulus "
                       "is felt equally long. Absent: until the answer, or what comes "
                       "next.",
                   .required = false,
                   .unit = "s",
                   .range = {0.0, 600.0, true}});
    own.push_back({.key = "answer_deadline_s",
                   .kind = ValueKind::kNumber,
                   .meaning =
                       "Until when a trial has to be answered, from the start of the "
                       "stimulus with which all of its stimuli were felt once: from then "
                       "on the question is asked, and whoever goes back to a stimulus "
                       "gets no more time. At the deadline free space comes, and the "
                       "attempt counts as missed. The trial comes again later in the "
                       "block, at a drawn place; of a procedure that adapts, and where "
                       "it is the last, it comes again at once; "
                       "interleaved with other blocks, with a later turn of its own. Missed "
                       "answers are "
                       "counted in the results and are in no other number. Absent: there "
                       "is no deadline.",
                   .required = false,
                   .unit = "s",
                   .range = {0.0, 3600.0, true}});
    own.push_back({.key = "answered_by",
                   .kind = ValueKind::kString,
                   .meaning =
                       "Who gives the answers to trials. `experimenter`: the participant shows "
                       "or says them, and the experimenter enters them. `participant`: they "
                       "press a pedal or a button of their own, and the time of the press is "
                       "that of the answer; an answer that the experimenter enters for them is "
                       "stored as the experimenter's.",
                   .required = false,
                   .default_json = R"("experimenter")",
                   .allowed = {"experimenter", "participant"}});
    own.push_back(
        {.key = "expected_trial_s",
         .kind = ValueKind::kNumber,
         .meaning =
             "How long a trial is expected to take, its `questions` counted and "
             "free space not. Only for planning the length of a session; `jnd plan` counts "
             "no less than simulated participants feel stimuli.",
         .unit = "s",
         .range = {0.0, 3600.0, true}});
    return ParameterTable{
        .name = "block",
        .meaning =
            "One procedure over one varied quantity: the part of a study that gives "
            "data. The keys that name the quantity carry its unit: `scale` for water, "
            "`viscosity_pa_s` for viscous fluids, `stiffness_n_per_m` for solids.",
        .example = procedure_named("constant_stimuli").examples().front(),
        .parameters = stage_parameters("block", std::move(own))};
  }();
  return kTable;
}

}  // namespace jnd::experiments
