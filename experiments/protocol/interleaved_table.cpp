#include "experiments/protocol/stage_tables.h"

namespace jnd::experiments {

const ParameterTable& interleaved_table() {
  static const ParameterTable kTable = {
      .name = "interleaved",
      .meaning =
          "Several blocks whose trials are mixed: several references, media or conditions of "
          "which nobody knows which one comes next. Each block is written as it would stand by "
          "itself and keeps its procedure, question, feedback, factor levels and results; "
          "they only take turns, trial by trial. Before the first trial participants are told "
          "the `instruction` of each block, of the same ones one. A rest between them is a "
          "stage `break` between two groups, whose blocks have the same `levels`.",
      .example =
          R"json({"kind": "interleaved", "name": "three_fluids", "turns": "rounds", "blocks": [
  {"kind": "block", "name": "thin", "procedure": "constant_stimuli", "medium": "viscous",
   "viscosity_pa_s": [1, 1.5, 3, 4], "reference_viscosity_pa_s": 2, "repetitions": 5,
   "instruction": {"en": "First comes the reference, then the test."},
   "question": {"en": "Was the test thicker than the reference?"}, "expected_trial_s": 15},
  {"kind": "block", "name": "thick", "procedure": "constant_stimuli", "medium": "viscous",
   "viscosity_pa_s": [5, 7.5, 15, 20], "reference_viscosity_pa_s": 10, "repetitions": 5,
   "instruction": {"en": "First comes the reference, then the test."},
   "question": {"en": "Was the test thicker than the reference?"}, "expected_trial_s": 15}]})json",
      .parameters = stage_parameters(
          "interleaved",
          {{.key = "turns",
            .kind = ValueKind::kString,
            .meaning =
                "Whose trial comes next. `rounds`: in every round each block that has trials "
                "left comes once, in an order drawn anew; so all of them keep pace, and none "
                "comes more than twice in a row while others have trials left. `random`: the "
                "next trial is drawn from all that are left, whatever their block; so nobody "
                "can tell which block comes, and a longer block comes more often. Turns are "
                "drawn from the session's seed.",
            .required = false,
            .default_json = R"("rounds")",
            .allowed = {"rounds", "random"}},
           {.key = "blocks",
            .kind = ValueKind::kStages,
            .meaning = "The blocks that take turns, each with its `kind`.",
            .allowed = {"block"},
            .min_items = 2,
            .max_items = 12}})};
  return kTable;
}

}  // namespace jnd::experiments
