#include "experiments/device_profile/device_profile_table.h"

#include "core/safety/force_limiter.h"
#include "core/safety/workspace.h"
#include "experiments/protocol/reference_writer.h"
#include "experiments/protocol/schema_writer.h"

namespace jnd::experiments {
namespace {

Parameter number_key(std::string key, std::string meaning, std::string unit, Range range) {
  return {.key = std::move(key),
          .kind = ValueKind::kNumber,
          .meaning = std::move(meaning),
          .unit = std::move(unit),
          .range = range};
}

Parameter measured_key(std::string key, std::string meaning, std::string unit, Range range) {
  return {.key = std::move(key),
          .kind = ValueKind::kMeasured,
          .meaning = std::move(meaning),
          .required = false,
          .unit = std::move(unit),
          .range = range};
}

Parameter object_key(std::string key, const ParameterTable& nested, bool required = false) {
  return {.key = std::move(key),
          .kind = ValueKind::kObject,
          .meaning = nested.meaning,
          .required = required,
          .nested = &nested};
}

Parameter optional(Parameter parameter) {
  parameter.required = false;
  return parameter;
}

Parameter three(Parameter parameter) {
  parameter.kind = ValueKind::kNumbers;
  parameter.min_items = parameter.max_items = 3;
  return parameter;
}

const ParameterTable& profiled_device_table() {
  static const ParameterTable kTable = {
      .name = "device",
      .meaning =
          "Which device it is, in its own words. The profile is used for this one alone.",
      .parameters = {
          {.key = "model", .meaning = "What it calls itself."},
          {.key = "serial",
           .meaning = "Its number; empty: it does not say.",
           .may_be_empty = true},
          {.key = "firmware",
           .meaning = "Version of its own program; empty: it does not say.",
           .may_be_empty = true},
      }};
  return kTable;
}

const ParameterTable& frame_table() {
  static const ParameterTable kTable = {
      .name = "frame",
      .meaning =
          "From the robot's own frame to the workspace, in which +x is to the participant's "
          "right, +y away, +z up, and a fluid's surface is the height 0: workspace position = "
          "rotation * robot position + offset.",
      .example = R"({"rotation": [0, -1, 0, 1, 0, 0, 0, 0, 1], "offset_m": [0, 0.4, -0.2]})",
      .parameters = {
          {.key = "rotation",
           .kind = ValueKind::kNumbers,
           .meaning = "A matrix, row by row: rows of length 1 at right angles to one another, "
                      "with the determinant 1, within 0.000001.",
           .range = {-1.000001, 1.000001},
           .min_items = 9,
           .max_items = 9},
          three(number_key("offset_m", "Where the robot's origin is in the workspace.", "m",
                           {-10.0, 10.0})),
          optional(number_key("surface_above_origin_m",
                              "How far above the robot's origin the fluid's surface is: for "
                              "people, who measure it with a ruler. The negative of the third "
                              "number of `offset_m`.",
                              "m", {-10.0, 10.0})),
          optional(number_key("rotation_ci95_rad",
                              "Half width of the 95 % confidence interval of the angle of "
                              "rotation, about any axis.",
                              "rad", {0.0, 3.2})),
          optional(number_key(
              "offset_ci95_m",
              "Half width of the 95 % confidence interval of each number of `offset_m`.", "m",
              {0.0, 10.0})),
          {.key = "num_points",
           .kind = ValueKind::kInteger,
           .meaning = "Positions that were compared.",
           .required = false,
           .range = {3, 1000000}},
          optional(number_key("residual_m",
                              "Root of the mean squared distance of the compared positions "
                              "from where the frame has them.",
                              "m", {0.0, 1.0})),
      }};
  return kTable;
}

std::vector<Parameter> limit_keys(const core::ForceLimiter::Parameters& most,
                                  double half_width_m) {
  return {number_key("max_force_per_point_n", "Force at one point.", "N",
                     {0.0, most.per_point_n, true}),
          number_key("max_total_force_n", "Sum of the forces at all points.", "N",
                     {0.0, most.total_n, true}),
          number_key("max_slew_n_per_s", "Change of the force at one point.", "N/s",
                     {0.0, most.slew_n_per_s, true}),
          number_key("max_speed_m_per_s",
                     "Speed of a point, above which the device is taken for broken.", "m/s",
                     {0.0, most.max_speed_m_per_s, true}),
          three(number_key("workspace_half_width_m",
                           "Half widths of the box around the workspace's origin in which "
                           "there may be force: x, y, z.",
                           "m", {0.0, half_width_m, true}))};
}

const ParameterTable& limits_table() {
  static const ParameterTable kTable = {
      .name = "limits",
      .meaning =
          "What a session on this device keeps to. People may narrow it; nothing here "
          "may be wider than `measured_limits`, nor than what the program allows.",
      .parameters = limit_keys({}, core::Workspace{}.half_width_x_m)};
  return kTable;
}

const ParameterTable& measured_limits_table() {
  static const ParameterTable kTable = {
      .name = "measured_limits",
      .meaning =
          "What the device was found to do, or is said to by its maker where it was not "
          "tried.",
      .parameters = limit_keys({.per_point_n = 1000.0,
                                .total_n = 5000.0,
                                .slew_n_per_s = 1e6,
                                .max_speed_m_per_s = 100.0},
                               10.0)};
  return kTable;
}

const ParameterTable& force_table() {
  static const ParameterTable kTable = {
      .name = "force",
      .meaning =
          "How true its forces are. The program does not correct for it: a session "
          "renders what the study says, and whoever analyses the data can.",
      .example = R"({"gain": {"value": 0.97, "ci95": [0.96, 0.98]}})",
      .parameters = {
          measured_key("gain", "Newtons delivered for each newton commanded; 1 is true.", "",
                       {0.0, 10.0, true}),
          measured_key("offset_n",
                       "Vertical force on the hand where none is commanded; up is positive.",
                       "N", {-100.0, 100.0}),
          measured_key("hysteresis_n",
                       "Largest difference between the forces delivered on the way up and on "
                       "the way down.",
                       "N", {0.0, 100.0}),
          optional(number_key("load_uncertainty_ratio",
                              "Standard uncertainty of the loads that it was compared with, "
                              "over the load.",
                              "", {0.0, 1.0})),
          optional(number_key("pose_spread_ratio",
                              "Standard deviation of the gain over the places where it was "
                              "measured, over its mean.",
                              "", {0.0, 10.0})),
      }};
  return kTable;
}

const ParameterTable& tool_table() {
  static const ParameterTable kTable = {
      .name = "tool",
      .meaning = "What is held by the hand.",
      .parameters = {measured_key("weight_n",
                                  "Of it that the device does not carry by itself, so that the "
                                  "hand does.",
                                  "N", {-100.0, 100.0})}};
  return kTable;
}

const ParameterTable& mechanics_table() {
  static const ParameterTable kTable = {
      .name = "mechanics",
      .meaning = "What a hand feels of the device itself, in free space.",
      .parameters = {
          measured_key("mass_kg", "Inertia.", "kg", {0.0, 100.0}),
          measured_key("damping_n_s_per_m", "Resistance that grows with speed.", "N s/m",
                       {0.0, 1000.0}),
          measured_key("friction_n", "Resistance that does not.", "N", {0.0, 100.0})}};
  return kTable;
}

const ParameterTable& noise_table() {
  static const ParameterTable kTable = {
      .name = "noise",
      .meaning = "Of its measurements while nothing moves.",
      .parameters = {
          optional(number_key("position_sd_m", "Standard deviation of a coordinate.", "m",
                              {0.0, 1.0})),
          optional(number_key("position_resolution_m",
                              "Smallest difference between two values of a coordinate.", "m",
                              {0.0, 1.0})),
          optional(number_key("velocity_sd_m_per_s",
                              "Standard deviation of a component of the velocity.", "m/s",
                              {0.0, 100.0})),
          optional(number_key("force_sd_n",
                              "Standard deviation of a component of the measured force.", "N",
                              {0.0, 100.0})),
      }};
  return kTable;
}

const ParameterTable& stable_up_to_table() {
  static const ParameterTable kTable = {
      .name = "stable_up_to",
      .meaning = "The largest value of a ladder at which the device came to rest.",
      .example = R"({"value": 20, "is_beyond_ladder": false})",
      .parameters = {
          {.key = "value",
           .kind = ValueKind::kNumber,
           .meaning = "In the unit of the key that holds it; 0: none was stable.",
           .range = {0.0, 1e6}},
          {.key = "is_beyond_ladder",
           .kind = ValueKind::kBoolean,
           .meaning = "Every value that was tried was stable: the limit is this or more."},
      }};
  return kTable;
}

Parameter stable_key(std::string key, std::string meaning, std::string unit) {
  return {.key = std::move(key),
          .kind = ValueKind::kObject,
          .meaning = std::move(meaning),
          .unit = std::move(unit),
          .nested = &stable_up_to_table()};
}

const ParameterTable& profile_stability_table() {
  static const ParameterTable kTable = {
      .name = "stability",
      .meaning =
          "Up to which stimuli the device is stable, with no hand in it. "
          "`jnd plan` and the check before a session compare the study with it.",
      .parameters = {
          number_key("rate_hz", "Rate of the haptic loop.", "Hz", {100.0, 10000.0}),
          number_key("phantom_mass_kg",
                     "Mass that was held in place of a hand; 0: nothing was in it, which is "
                     "the lightest.",
                     "kg", {0.0, 100.0}),
          stable_key("viscosity_pa_s", "Of a viscous fluid.", "Pa s"),
          stable_key("stiffness_n_per_m", "Of a solid.", "N/m"),
          optional(
              number_key("quiet_viscosity_pa_s",
                         "Thickest fluid through which it was drawn without a fault of the "
                         "loop. Less than what is stable where its velocities are noisy.",
                         "Pa s", {0.0, 1e6})),
          optional(number_key("force_limit_n", "The most force in all while it was measured.",
                              "N", {0.0, 100.0, true})),
      }};
  return kTable;
}

const ParameterTable& daily_check_table() {
  static const ParameterTable kTable = {
      .name = "daily_check",
      .meaning = "Whether the device was still the one of the profile, and what was found.",
      .parameters = {
          {.key = "checked_on", .kind = ValueKind::kDate, .meaning = "Day of the check."},
          measured_key("gain", "As in `force`.", "", {0.0, 10.0, true}),
          measured_key("weight_n", "As in `tool`.", "N", {-100.0, 100.0}),
          measured_key("damping_n_s_per_m",
                       "As in `mechanics`; noise may make it less than nothing.", "N s/m",
                       {-1000.0, 1000.0}),
          measured_key("friction_n", "Likewise.", "N", {-100.0, 100.0}),
          optional(number_key("turned_rad",
                              "Angle by which the device's frame had turned since it was "
                              "measured.",
                              "rad", {0.0, 3.2})),
          optional(number_key("shifted_m",
                              "How far it had moved, at the middle of the marks that were "
                              "touched.",
                              "m", {0.0, 10.0})),
          optional(number_key("position_sd_m", "As in `noise`.", "m", {0.0, 1.0})),
          optional(number_key("velocity_sd_m_per_s", "As in `noise`.", "m/s", {0.0, 100.0})),
          {.key = "passed",
           .kind = ValueKind::kBoolean,
           .meaning = "It was. Where the last check says `false`, the profile is not used."},
      }};
  return kTable;
}

Parameter signature_key(std::string key, bool required) {
  std::string meaning = "Of `" + key + "`.";
  if (key == "origin") {
    meaning = "Of `device`, `measured_on`, `program_version` and `simulated`.";
  }
  return {.key = std::move(key), .meaning = std::move(meaning), .required = required};
}

const ParameterTable& signature_table() {
  static const ParameterTable kTable = {
      .name = "signature",
      .meaning =
          "SHA-256 of each part as it was measured, by which an edited one is found. It keeps "
          "nobody from forging a profile; it finds what was changed by mistake.",
      .parameters = {signature_key("origin", true), signature_key("frame", true),
                     signature_key("measured_limits", true), signature_key("force", false),
                     signature_key("tool", false), signature_key("mechanics", false),
                     signature_key("noise", false), signature_key("delay_s", false),
                     signature_key("stability", false), signature_key("checks", false)}};
  return kTable;
}

constexpr const char* kIntroduction = R"md(# Device profiles

This page is made by `jnd schema --device-profile --markdown` from the tables that the program reads profiles with. Do not
edit it.

A profile says what was measured of one device before a hand is in it. `jnd commission` makes it, as a file
`NAME.device.json`; people look at it, may write a `comment` into any object, and may change `name`, `valid_until` and
`limits` (to narrower ones). Everything else was measured and is not changed by hand: the key `signature` tells where it
was, and the profile is not used then. What a profile is for, and when it is refused: [docs/devices.md](../docs/devices.md#the-profile-of-a-device).

A *measured number* is an object `{"value": 0.97, "ci95": [0.96, 0.98]}`: what was measured, and the lower and the upper end
of the interval that holds the true value with 95 %. A *date* is written as `2026-11-25`. A key that is optional is left out
where it was not measured.
)md";

}  // namespace

const ParameterTable& device_profile_table() {
  static const ParameterTable kTable = {
      .name = "device_profile",
      .meaning = "What was measured of one device before a hand is in it.",
      .parameters = {
          {.key = "$schema",
           .meaning = "Where an editor finds the JSON Schema. Without effect.",
           .required = false},
          {.key = "format",
           .kind = ValueKind::kInteger,
           .meaning = "Version of the format of profiles; this is version 1.",
           .range = {1, 1}},
          {.key = "name",
           .kind = ValueKind::kName,
           .meaning = "Short name of the profile, for its file."},
          object_key("device", profiled_device_table(), true),
          {.key = "measured_on",
           .kind = ValueKind::kDate,
           .meaning = "The last day of the measurements."},
          {.key = "valid_until",
           .kind = ValueKind::kDate,
           .meaning = "The last day on which the profile is used. For the laboratory to say."},
          {.key = "program_version", .meaning = "Of the jnd that measured."},
          {.key = "simulated",
           .kind = ValueKind::kBoolean,
           .meaning = "The device was SIMULATED. Such a profile is not used for a real one."},
          object_key("frame", frame_table(), true),
          object_key("limits", limits_table(), true),
          object_key("measured_limits", measured_limits_table(), true),
          object_key("force", force_table()),
          object_key("tool", tool_table()),
          object_key("mechanics", mechanics_table()),
          object_key("noise", noise_table()),
          measured_key("delay_s", "From a force that is sent until its effect is measured.",
                       "s", {0.0, 1.0}),
          object_key("stability", profile_stability_table()),
          {.key = "checks",
           .kind = ValueKind::kObjects,
           .meaning = "Daily checks, in the order of their days.",
           .required = false,
           .nested = &daily_check_table()},
          object_key("signature", signature_table(), true),
      }};
  return kTable;
}

std::vector<const ParameterTable*> device_profile_tables() {
  return tables_below(device_profile_table());
}

std::string device_profile_schema() {
  return file_schema(device_profile_tables(), "jnd device profile, format 1");
}

std::string device_profile_reference() {
  return file_reference(device_profile_table(), kIntroduction);
}

}  // namespace jnd::experiments
