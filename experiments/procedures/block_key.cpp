#include "experiments/procedures/block_key.h"

namespace jnd::experiments {
namespace {

BlockKey amount(const char* name, const char* meaning, bool required) {
  return {.parameter = {.key = name,
                        .kind = ValueKind::kNumber,
                        .meaning = meaning,
                        .required = required},
          .of_quantity = true,
          .is_positive = true};
}

BlockKey answer_label(const char* key, const char* meaning) {
  return {.parameter = {
              .key = key, .kind = ValueKind::kText, .meaning = meaning, .required = false}};
}

}  // namespace

std::string BlockKey::name_for(const std::string& quantity) const {
  if (!of_quantity) return parameter.key;
  return parameter.key.empty() ? quantity : parameter.key + '_' + quantity;
}

BlockKey stimuli_key() {
  return {
      .parameter = {.key = "",
                    .kind = ValueKind::kNumbers,
                    .meaning = "The test stimuli, or in `magnitude_production` the values that "
                               "an adjustment starts from. Each repetition shows every one of "
                               "them once, in random order. No value may stand twice.",
                    .max_items = 200},
      .of_quantity = true};
}

BlockKey task_key() {
  return {.parameter = {.key = "task",
                        .kind = ValueKind::kString,
                        .meaning =
                            "`reminder`: the reference first, then the test, and a question "
                            "that compares them. `yes_no`: the test alone, and whether it is "
                            "felt, for absolute thresholds.",
                        .required = false,
                        .default_json = R"("reminder")",
                        .allowed = {"reminder", "yes_no"}}};
}

BlockKey reference_key() {
  BlockKey key = amount("reference",
                        "The stimulus that every test stimulus is compared with; between the "
                        "smallest and the largest of them.",
                        true);
  key.parameter.only_where = {{"task", {"reminder"}}};
  return key;
}

BlockKey repetitions_key() {
  return {.parameter = {.key = "repetitions",
                        .kind = ValueKind::kInteger,
                        .meaning = "How often every test stimulus is shown.",
                        .range = {1, 1000}}};
}

std::vector<BlockKey> answer_label_keys() {
  return {
      answer_label("yes_label", "What the answer that is stored as 1 is called: \"Thicker\"."),
      answer_label("no_label",
                   "What the answer that is stored as 0 is called: \"Not thicker\".")};
}

std::vector<BlockKey> step_keys() {
  return {
      amount("coarse_step", "How much one large step of the adjustment changes.", true),
      amount("fine_step", "How much one small step changes; less than the large one.", true),
      amount("max",
             "No step goes beyond this; at least the largest starting value. Absent: no end.",
             false)};
}

}  // namespace jnd::experiments
