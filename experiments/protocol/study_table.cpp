#include "experiments/protocol/study_table.h"

#include <array>

#include "core/marker.h"
#include "experiments/protocol/design_tables.h"
#include "experiments/protocol/sound_tables.h"
#include "experiments/protocol/stage_tables.h"

namespace jnd::experiments {
namespace {

const ParameterTable& force_map_row_table() {
  static const ParameterTable kTable = {
      .name = "force_map_row",
      .meaning = "Coefficients of the hand's drag and lift at one angle and one speed.",
      .parameters = {
          {.key = "angle_of_attack_rad",
           .kind = ValueKind::kNumber,
           .meaning = "Between the hand plane and its motion: 0 edge on, pi/2 head on.",
           .unit = "rad",
           .range = {0.0, 1.571}},
          {.key = "speed_m_per_s",
           .kind = ValueKind::kNumber,
           .meaning = "Of the hand.",
           .unit = "m/s",
           .range = {0.0, 100.0}},
          {.key = "drag_coefficient",
           .kind = ValueKind::kNumber,
           .meaning = "Drag over 1/2 density speed^2 area.",
           .range = {0.0, 100.0}},
          {.key = "lift_coefficient",
           .kind = ValueKind::kNumber,
           .meaning = "Lift over the same; 0 at the angles 0 and pi/2.",
           .required = false,
           .default_json = "0.0",
           .range = {-100.0, 100.0}},
      }};
  return kTable;
}

const ParameterTable& immersion_table() {
  static const ParameterTable kTable = {
      .name = "immersion",
      .meaning =
          "Where the fluid is: below a surface, in a cylinder with a vertical axis. "
          "Workspace frame, z up. With a stiffness the cylinder is a solid container: with "
          "`radius_m` and `depth_m` a bucket, with `depth_m` alone a floor below the fluid.",
      .example = R"({"radius_m": 0.25, "depth_m": 0.3, "wall_stiffness_n_per_m": 1000})",
      .parameters = {
          {.key = "radius_m",
           .kind = ValueKind::kNumber,
           .meaning = "Radius of the cylinder. Absent: the fluid has no walls.",
           .required = false,
           .unit = "m",
           .range = {0.0, 100.0, true}},
          {.key = "depth_m",
           .kind = ValueKind::kNumber,
           .meaning = "Depth of the fluid below its surface. Absent: bottomless.",
           .required = false,
           .unit = "m",
           .range = {0.0, 100.0, true}},
          {.key = "origin_x_m",
           .kind = ValueKind::kNumber,
           .meaning = "Axis of the cylinder, to the participant's right.",
           .required = false,
           .default_json = "0.0",
           .unit = "m",
           .range = {-10.0, 10.0}},
          {.key = "origin_y_m",
           .kind = ValueKind::kNumber,
           .meaning = "Axis of the cylinder, away from the participant.",
           .required = false,
           .default_json = "0.0",
           .unit = "m",
           .range = {-10.0, 10.0}},
          {.key = "origin_z_m",
           .kind = ValueKind::kNumber,
           .meaning = "Height of the surface of the fluid.",
           .required = false,
           .default_json = "0.0",
           .unit = "m",
           .range = {-10.0, 10.0}},
          {.key = "wall_stiffness_n_per_m",
           .kind = ValueKind::kNumber,
           .meaning = "Stiffness of wall and bottom against the whole hand, in free space too. "
                      "Absent: the fluid ends there, and nothing else.",
           .required = false,
           .unit = "N/m",
           .range = {0.0, 100000.0, true}},
          {.key = "wall_friction_ratio",
           .kind = ValueKind::kNumber,
           .meaning = "Friction of wall and bottom over the force pressing on them.",
           .required = false,
           .default_json = "0.0",
           .range = {0.0, 10.0}},
      }};
  return kTable;
}

const ParameterTable& device_table() {
  static const ParameterTable kTable = {
      .name = "device",
      .meaning = "What the study asks of the apparatus. A session does not start on less.",
      .example = R"({"min_contact_points": 5, "rate_hz": 1000, "ramp_s": 0.05})",
      .parameters = {
          {.key = "min_contact_points",
           .kind = ValueKind::kInteger,
           .meaning = "How many points of the hand must be held by the device.",
           .required = false,
           .default_json = "5",
           .range = {1, 5}},
          {.key = "rate_hz",
           .kind = ValueKind::kNumber,
           .meaning = "Rate of the haptic loop.",
           .required = false,
           .default_json = "1000.0",
           .unit = "Hz",
           .range = {100.0, 10000.0}},
          {.key = "ramp_s",
           .kind = ValueKind::kNumber,
           .meaning = "Time in which one medium turns into the next; a force never steps.",
           .required = false,
           .default_json = "0.05",
           .unit = "s",
           .range = {0.0, 10.0}},
          {.key = "max_missed_ratio",
           .kind = ValueKind::kNumber,
           .meaning =
               "Share of a presentation's ticks that may not run, because the machine or "
               "the device held the loop up; a trial with more is repeated. A hundredth "
               "is a tenth of the smallest Weber fractions of viscosity, and 50 ms of a "
               "presentation of 5 s.",
           .required = false,
           .default_json = "0.01",
           .range = {0.0, 1.0}},
          {.key = "immersion",
           .kind = ValueKind::kObject,
           .meaning = "Where the fluid is. Absent: everywhere below the height 0.",
           .required = false,
           .nested = &immersion_table()},
          {.key = "force_map",
           .kind = ValueKind::kObjects,
           .meaning = "Drag and lift of the hand in `water_map`: every angle with every speed. "
                      "Absent: the fit of the thesis, without lift.",
           .required = false,
           .min_items = 2,
           .nested = &force_map_row_table()},
      }};
  return kTable;
}

const ParameterTable& session_limits_table() {
  static const ParameterTable kTable = {
      .name = "session_limits",
      .meaning =
          "What can be asked of a participant in one session. A study that is expected "
          "to go beyond is refused; a session that does all the same is told so.",
      .example = R"({"max_duration_s": 5400, "max_trials_without_break": 60})",
      .parameters = {
          {.key = "max_duration_s",
           .kind = ValueKind::kNumber,
           .meaning =
               "From the first stage to the last. Absent: no limit but the 8 hours of any "
               "study.",
           .required = false,
           .unit = "s",
           .range = {0.0, 28800.0, true}},
          {.key = "max_trials_without_break",
           .kind = ValueKind::kInteger,
           .meaning = "Trials from one `break` to the next, blocks in between taken together. "
                      "Absent: any number.",
           .required = false,
           .range = {1, 50000}},
          {.key = "max_force_time_n_s",
           .kind = ValueKind::kNumber,
           .meaning =
               "Force times time that a hand is exposed to, the magnitudes of all points "
               "summed up. A session that reaches it begins no further trial. Absent: no "
               "limit.",
           .required = false,
           .unit = "N s",
           .range = {0.0, 1e9, true}},
          {.key = "max_under_force_s",
           .kind = ValueKind::kNumber,
           .meaning = "Time in which the points together give 0.1 N and more. A session that "
                      "reaches it begins no further trial. Absent: no limit.",
           .required = false,
           .unit = "s",
           .range = {0.0, 28800.0, true}},
      }};
  return kTable;
}

const ParameterTable& markers_table() {
  static const ParameterTable kTable = [] {
    constexpr std::array<const char*, core::kNumMarkerKinds> kMeanings = {
        "A stage was entered.",
        "A trial began, or began again.",
        "The medium is about to be switched: to a stimulus, or to free space within a trial.",
        "A trial was answered, whatever the answer.",
        "The device or the loop had a fault; the emergency stop is one.",
        "The session ended, or was left to go on later."};
    ParameterTable table{
        .name = "markers",
        .meaning =
            "The codes of the pulses that a session sends to another recorder, such as an EEG "
            "amplifier, where `jnd run --marker-port` names a port. 0: no pulse. No two kinds "
            "have one code. What was presented and what was answered has no code, so that "
            "pulses unblind nobody: the exported table `markers` says which event each pulse "
            "belongs to.",
        .example = R"({"presentation": 10, "answer": 20, "stage": 0})"};
    for (std::size_t kind = 0; kind < core::kNumMarkerKinds; ++kind) {
      table.parameters.push_back(
          {.key = std::string(core::kMarkerNames[kind]),
           .kind = ValueKind::kInteger,
           .meaning = kMeanings[kind],
           .required = false,
           .default_json = std::to_string(core::MarkerCodes{}.codes[kind]),
           .range = {0, 255}});
    }
    return table;
  }();
  return kTable;
}

}  // namespace

const ParameterTable& study_table() {
  static const ParameterTable kTable = {
      .name = "study",
      .meaning =
          "A psychophysical study: what happens in one session, from the greeting to the "
          "backup, stage by stage.",
      .example = R"json({"format": 1, "name": "honey", "languages": ["en"],
  "title": {"en": "How thick is honey?"}, "authors": ["A. Author"],
  "stages": [{"kind": "break", "name": "rest", "instruction": {"en": "Rest."}, "duration_s": 60}]})json",
      .parameters = {
          {.key = "$schema",
           .kind = ValueKind::kString,
           .meaning = "Where an editor finds the JSON Schema. Without effect.",
           .required = false},
          {.key = "format",
           .kind = ValueKind::kInteger,
           .meaning = "Version of the study format; this is version 1.",
           .range = {1, 1}},
          {.key = "name",
           .kind = ValueKind::kName,
           .meaning = "Short name of the study, for folders and files."},
          {.key = "languages",
           .kind = ValueKind::kStrings,
           .meaning = "Codes of the languages that every text of the study has, such as `en` "
                      "and `de`. The first is shown unless another is chosen.",
           .max_items = 20},
          {.key = "title", .kind = ValueKind::kText, .meaning = "Title of the study."},
          {.key = "description",
           .kind = ValueKind::kText,
           .meaning = "What the study is about, for whoever chooses it from a list.",
           .required = false},
          {.key = "authors", .kind = ValueKind::kStrings, .meaning = "Who wrote the study."},
          {.key = "citation",
           .kind = ValueKind::kString,
           .meaning = "The publication that the study follows.",
           .required = false},
          {.key = "device",
           .kind = ValueKind::kObject,
           .meaning = "What the study asks of the apparatus.",
           .required = false,
           .nested = &device_table()},
          {.key = "blinding",
           .kind = ValueKind::kString,
           .meaning = "Who does not see which stimulus is presented: nobody is blind (`none`), "
                      "the participant is, or participant and experimenter are (`double`).",
           .required = false,
           .default_json = R"("none")",
           .allowed = {"none", "participant", "double"}},
          {.key = "session_limits",
           .kind = ValueKind::kObject,
           .meaning = "What can be asked of a participant in one session.",
           .required = false,
           .nested = &session_limits_table()},
          masking_noise_parameter(/*of_block=*/false),
          cues_parameter(/*of_block=*/false),
          {.key = "markers",
           .kind = ValueKind::kObject,
           .meaning = "The codes of pulses to another recorder. Absent: those of the table.",
           .required = false,
           .nested = &markers_table()},
          {.key = "participant_fields",
           .kind = ValueKind::kObjects,
           .meaning =
               "What counterbalances are stratified by; each is the `stratify_by` of one "
               "or more.",
           .required = false,
           .max_items = 10,
           .nested = &participant_field_table()},
          {.key = "factors",
           .kind = ValueKind::kObjects,
           .meaning = "What the study varies on purpose; see `contrasts`.",
           .required = false,
           .max_items = 6,
           .nested = &factor_table()},
          {.key = "contrasts",
           .kind = ValueKind::kObjects,
           .meaning = "Comparisons of conditions that are planned before anybody takes part.",
           .required = false,
           .max_items = 40,
           .nested = &contrast_table()},
          {.key = "sequential",
           .kind = ValueKind::kObject,
           .meaning =
               "Looks at the study before all have taken part, and the rule that ends it. "
               "Absent: nobody looks before the last session.",
           .required = false,
           .nested = &sequential_table()},
          {.key = "stages",
           .kind = ValueKind::kStages,
           .meaning = "What happens in a session, in order."},
      }};
  return kTable;
}

const ParameterTable* stage_table(std::string_view kind) noexcept {
  for (const ParameterTable* table : stage_tables()) {
    if (table->name == kind) return table;
  }
  return nullptr;
}

const std::vector<const ParameterTable*>& all_tables() {
  static const std::vector<const ParameterTable*> kAll = [] {
    std::vector<const ParameterTable*> tables = {&study_table(),
                                                 &device_table(),
                                                 &immersion_table(),
                                                 &force_map_row_table(),
                                                 &participant_field_table(),
                                                 &session_limits_table(),
                                                 &masking_noise_table(),
                                                 &cue_table(),
                                                 &markers_table(),
                                                 &factor_table(),
                                                 &contrast_table(),
                                                 &sequential_table()};
    for (const ParameterTable* stage : stage_tables()) {
      tables.push_back(stage);
      for (const Parameter& parameter : stage->parameters) {
        if (parameter.nested == nullptr) continue;
        tables.push_back(parameter.nested);
        for (const Parameter& inner : parameter.nested->parameters) {
          if (inner.nested != nullptr) tables.push_back(inner.nested);
        }
      }
    }
    std::vector<const ParameterTable*> unique;
    for (const ParameterTable* table : tables) {
      bool known = false;
      for (const ParameterTable* other : unique) known = known || other == table;
      if (!known) unique.push_back(table);
    }
    return unique;
  }();
  return kAll;
}

}  // namespace jnd::experiments
