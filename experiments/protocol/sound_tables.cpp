#include "experiments/protocol/sound_tables.h"

#include <cstddef>
#include <utility>

#include "core/sound/sound_level.h"

namespace jnd::experiments {
namespace {

Parameter level_db_spl(std::vector<Condition> only_where) {
  return {.key = "level_db_spl",
          .kind = ValueKind::kNumber,
          .meaning =
              "Sound pressure level at the ear. The output of the machine has to be calibrated "
              "for it (`jnd sound`). This or `level_dbfs`.",
          .required = false,
          .unit = "dB SPL",
          .range = {0.0, core::kLoudest_db_spl},
          .only_where = std::move(only_where)};
}

Parameter level_dbfs(double loudest_dbfs, std::vector<Condition> only_where) {
  return {.key = "level_dbfs",
          .kind = ValueKind::kNumber,
          .meaning =
              "Level of the samples, where a sine of full scale has 0. How loud that is "
              "depends on the machine. This or `level_db_spl`.",
          .required = false,
          .unit = "dB re full scale",
          .range = {-120.0, loudest_dbfs},
          .only_where = std::move(only_where)};
}

Parameter required_parameter(std::vector<Condition> only_where) {
  return {.key = "required",
          .kind = ValueKind::kBoolean,
          .meaning =
              "Whether a session may not begin where this cannot be heard. Otherwise it "
              "begins without, and the session keeps why.",
          .required = false,
          .default_json = "false",
          .only_where = std::move(only_where)};
}

}  // namespace

const ParameterTable& masking_noise_table() {
  static const std::vector<Condition> kHeard = {{"kind", {"white", "pink", "band"}}};
  static const std::vector<Condition> kBand = {{"kind", {"band"}}};
  static const ParameterTable kTable = {
      .name = "masking_noise",
      .meaning =
          "Noise in headphones against what could be heard of a device's motors. It goes on "
          "without a gap from the beginning of a session to its end, in pauses as well, and "
          "knows nothing of any stimulus. Simulated sessions play nothing.",
      .example = R"({"kind": "pink", "level_db_spl": 65, "ramp_s": 2, "required": true})",
      .parameters = {
          {.key = "kind",
           .kind = ValueKind::kString,
           .meaning = "`white`: the same power in every hertz. `pink`: the same power in every "
                      "octave. `band`: white between `low_hz` and `high_hz`, 24 dB less per "
                      "octave beyond. `none`: no noise, for a block.",
           .allowed = {"white", "pink", "band", "none"}},
          level_db_spl(kHeard),
          level_dbfs(core::kLoudestNoise_dbfs, kHeard),
          {.key = "low_hz",
           .kind = ValueKind::kNumber,
           .meaning = "Where a band begins: 3 dB are lost there.",
           .unit = "Hz",
           .range = {20.0, 20000.0},
           .only_where = kBand},
          {.key = "high_hz",
           .kind = ValueKind::kNumber,
           .meaning = "Where a band ends: 3 dB are lost there.",
           .unit = "Hz",
           .range = {20.0, 20000.0},
           .only_where = kBand},
          {.key = "ramp_s",
           .kind = ValueKind::kNumber,
           .meaning = "Time in which the noise comes, goes, or takes the place of another.",
           .required = false,
           .default_json = "0.5",
           .unit = "s",
           .range = {0.05, 60.0}},
          required_parameter(kHeard)}};
  return kTable;
}

const ParameterTable& cue_table() {
  static const ParameterTable kTable = {
      .name = "cue",
      .meaning =
          "A short tone that tells of a moment of a trial. It is the same for every stimulus, "
          "and the session keeps when it was heard.",
      .example = R"({"moment": "begin", "frequency_hz": 1000, "level_db_spl": 60})",
      .parameters = {
          {.key = "moment",
           .kind = ValueKind::kString,
           .meaning =
               "`ready`: the next trial can begin. `begin`: a stimulus begins, as seen from "
               "the "
               "participant: each interval, and no step of an adjustment. `end`: a stimulus is "
               "over, and none follows at once.",
           .allowed = {"ready", "begin", "end"}},
          {.key = "frequency_hz",
           .kind = ValueKind::kNumber,
           .meaning = "Frequency of the tone.",
           .unit = "Hz",
           .range = {100.0, 8000.0}},
          {.key = "duration_s",
           .kind = ValueKind::kNumber,
           .meaning = "How long it lasts, with 10 ms each in which it comes and goes.",
           .required = false,
           .default_json = "0.1",
           .unit = "s",
           .range = {0.02, 2.0}},
          level_db_spl({}),
          level_dbfs(core::kLoudestCue_dbfs, {}),
          required_parameter({})}};
  return kTable;
}

Parameter masking_noise_parameter(bool of_block) {
  return {.key = "masking_noise",
          .kind = ValueKind::kObject,
          .meaning = of_block
                         ? "Noise in this block in place of the study's. Blocks that are "
                           "interleaved sound alike, and so do all of a study with `blinding`. "
                           "Absent: as in the study."
                         : "Noise in headphones against what could be heard of a device's "
                           "motors. Absent: none.",
          .required = false,
          .nested = &masking_noise_table()};
}

Parameter cues_parameter(bool of_block) {
  return {.key = "cues",
          .kind = ValueKind::kObjects,
          .meaning =
              of_block ? "Tones in this block in place of the study's; an empty list is none. "
                         "Blocks that are interleaved sound alike, and so do all of a study "
                         "with `blinding`. Absent: as in the study."
                       : "Tones that tell of moments of trials, at most one of each moment. "
                         "Absent: none.",
          .required = false,
          .min_items = of_block ? std::size_t{0} : std::size_t{1},
          .max_items = 3,
          .nested = &cue_table()};
}

}  // namespace jnd::experiments
