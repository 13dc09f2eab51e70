#include "experiments/study/stage_tables.h"

namespace jnd::experiments {
namespace {

constexpr const char* kEstimation = "magnitude_estimation";
constexpr const char* kProduction = "magnitude_production";
constexpr const char* kConstantStimuli = "constant_stimuli";

/// The keys that carry the block's quantity in their name, for one quantity.
void add_quantity(std::vector<Parameter>& parameters, const std::string& quantity,
                  const std::string& unit, const Range& range,
                  const std::vector<std::string>& media_of_it) {
  const Condition medium = {"medium", media_of_it};
  const auto number = [&](const std::string& key, const std::string& meaning, Range its_range,
                          const char* procedure, bool required) {
    parameters.push_back({.key = key,
                          .kind = ValueKind::kNumber,
                          .meaning = meaning,
                          .required = required,
                          .unit = unit,
                          .range = its_range,
                          .only_where = {{"procedure", {procedure}}, medium}});
  };
  const Range positive = {0.0, range.high, true};
  parameters.push_back({.key = quantity,
                        .kind = ValueKind::kNumbers,
                        .meaning =
                            "The test stimuli, or in `magnitude_production` the values "
                            "that an adjustment starts from. Each repetition shows every "
                            "one of them once, in random order. No value may stand twice.",
                        .unit = unit,
                        .range = range,
                        .max_items = 200,
                        .only_where = {medium}});
  number("reference_" + quantity,
         "The stimulus that every test stimulus is compared with; between the smallest and "
         "the largest of them.",
         positive, kConstantStimuli, true);
  number("coarse_step_" + quantity, "How much one large step of the adjustment changes.",
         positive, kProduction, true);
  number("fine_step_" + quantity, "How much one small step changes; less than the large one.",
         positive, kProduction, true);
  number("max_" + quantity,
         "No step goes beyond this; at least the largest starting value. Absent: no end.",
         positive, kProduction, false);
}

}  // namespace

const ParameterTable& block_table() {
  static const ParameterTable kTable = [] {
    std::vector<Parameter> own = {
        {.key = "procedure",
         .kind = ValueKind::kString,
         .meaning = "How the stimuli are asked about. `magnitude_estimation`: the participant "
                    "says how "
                    "strong each one feels, in percent. `magnitude_production`: the "
                    "participant adjusts "
                    "it until it feels like a target in percent. `constant_stimuli`: the "
                    "reference, then "
                    "a test stimulus, then a question answered yes or no.",
         .allowed = {kEstimation, kProduction, kConstantStimuli}},
        {.key = "medium",
         .kind = ValueKind::kString,
         .meaning =
             "What is felt. `water`: drag that grows with the square of speed, varied by "
             "`scale`. `viscous`: drag that grows with speed, varied by "
             "`viscosity_pa_s`. `viscous_stokes`: the same with the constant of a sphere. "
             "`water_map`: water with the drag and lift of the study's `force_map`. "
             "`viscous_schiller_naumann`: viscous with the fluid's inertia, up to a Reynolds "
             "number (100 speed / viscosity, SI units) of 800. `viscous_ellipsoid`: viscous "
             "about an ellipsoid that turns with the hand.",
         .allowed = {"water", "viscous", "viscous_stokes", "water_map",
                     "viscous_schiller_naumann", "viscous_ellipsoid"}}};
    add_quantity(own, "scale", "", {0.0, 99.0, false}, {"water", "water_map"});
    add_quantity(
        own, "viscosity_pa_s", "Pa s", {0.0, 1000.0, true},
        {"viscous", "viscous_stokes", "viscous_schiller_naumann", "viscous_ellipsoid"});
    own.push_back(buoyancy_parameter());
    own.push_back({.key = "target_percent",
                   .kind = ValueKind::kNumbers,
                   .meaning = "What the stimulus should feel like, one repetition for each.",
                   .unit = "%",
                   .range = {0.0, 10000.0, true},
                   .max_items = 100,
                   .only_where = {{"procedure", {kProduction}}}});
    own.push_back({.key = "repetitions",
                   .kind = ValueKind::kInteger,
                   .meaning = "How often every test stimulus is shown.",
                   .range = {1, 1000},
                   .only_where = {{"procedure", {kEstimation, kConstantStimuli}}}});
    own.push_back({.key = "instruction",
                   .kind = ValueKind::kText,
                   .meaning = "What the participant is told before the block."});
    own.push_back({.key = "question",
                   .kind = ValueKind::kText,
                   .meaning = "What the participant is asked in every trial."});
    const auto answer_label = [&](const char* key, const char* meaning) {
      own.push_back({.key = key,
                     .kind = ValueKind::kText,
                     .meaning = meaning,
                     .required = false,
                     .only_where = {{"procedure", {kConstantStimuli}}}});
    };
    answer_label("yes_label", "What the answer that is stored as 1 is called: \"Thicker\".");
    answer_label("no_label", "What the answer that is stored as 0 is called: \"Not thicker\".");
    own.push_back({.key = "free_space_between_s",
                   .kind = ValueKind::kNumber,
                   .meaning = "Free space before each trial.",
                   .required = false,
                   .default_json = "0.0",
                   .unit = "s",
                   .range = {0.0, 600.0}});
    own.push_back({.key = "expected_trial_s",
                   .kind = ValueKind::kNumber,
                   .meaning = "How long a trial is expected to take, free space not counted. "
                              "Only for planning the length of a session.",
                   .unit = "s",
                   .range = {0.0, 3600.0, true}});
    return ParameterTable{
        .name = "block",
        .meaning =
            "One procedure over one varied quantity: the part of a study that gives "
            "data. The keys that name the quantity carry its unit: `scale` for water, "
            "`viscosity_pa_s` for viscous fluids.",
        .example = R"json({"kind": "block", "name": "thick_fluids",
  "procedure": "constant_stimuli", "medium": "viscous",
  "viscosity_pa_s": [10, 12, 14, 18, 20, 24], "reference_viscosity_pa_s": 16, "repetitions": 5,
  "instruction": {"en": "First comes the reference, then the test."},
  "question": {"en": "Was the test thicker than the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json",
        .parameters = stage_parameters("block", std::move(own))};
  }();
  return kTable;
}

}  // namespace jnd::experiments
