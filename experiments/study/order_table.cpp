#include "experiments/study/order_table.h"

namespace jnd::experiments {

const ParameterTable& order_table() {
  static const std::vector<Condition> kDrawn = {{"method", {"shuffled", "mixed"}}};
  static const ParameterTable kTable = {
      .name = "order",
      .meaning =
          "In which order the stimuli of a block come. What is asked of it holds within "
          "repetitions and from each to the next.",
      .example = R"({"method": "shuffled", "min_distance": 3, "not_first": [24]})",
      .parameters = {
          {.key = "method",
           .kind = ValueKind::kString,
           .meaning =
               "`shuffled`: each repetition by itself in random order. `mixed`: the trials of "
               "all repetitions together in random order. `latin`: a row of a cyclic Latin "
               "square, in which every stimulus stands once in every place; the next row in "
               "the next repetition. `williams`: the same with a Williams square, in which "
               "also every stimulus follows every other one equally often. Which row a "
               "participant begins with is counterbalanced like the arms of a "
               "`counterbalance`.",
           .required = false,
           .default_json = R"("shuffled")",
           .allowed = {"shuffled", "mixed", "latin", "williams"}},
          {.key = "max_in_a_row",
           .kind = ValueKind::kInteger,
           .meaning = "How many trials of the same stimulus may follow each other. Absent: any "
                      "number.",
           .required = false,
           .range = {1, 1000},
           .only_where = kDrawn},
          {.key = "min_distance",
           .kind = ValueKind::kInteger,
           .meaning = "How many trials later the same stimulus may come again: 1 at once, 2 "
                      "after one other, 3 after two others.",
           .required = false,
           .default_json = "1",
           .range = {1, 200},
           .only_where = {{"method", {"shuffled"}}}},
          {.key = "not_first",
           .kind = ValueKind::kNumbers,
           .meaning = "Stimuli that the block does not begin with, as they stand in its list.",
           .required = false,
           .max_items = 200,
           .only_where = kDrawn}}};
  return kTable;
}

}  // namespace jnd::experiments
