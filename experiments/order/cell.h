#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// What one counterbalance gives a participant: all of its arms in an order, or one of them.
/// A block whose stimuli come in a square assigns "row_1", "row_2" ..., and a field assigns
/// what the participant brings, its value.
struct Assignment {
  std::string counterbalance;     ///< Name of its stage, of the block, or of the field.
  std::vector<std::string> arms;  ///< Names, in the order in which they are run.

  bool operator==(const Assignment&) const = default;
};

/// One assignment for each field of a study, then for each counterbalance and square in the
/// order of its stages.
using Cell = std::vector<Assignment>;

/// "sex=female;priming=primed;method_order=estimation,production"; "" where nothing differs
/// between participants. This form is what is stored and shown.
[[nodiscard]] std::string to_string(const Cell& cell);

/// Reads that form back. Throws `Error` if it is not a cell of this study.
[[nodiscard]] Cell cell_from_text(const Study& study, const std::string& text);

/// Throws `Error` if it is not a cell of this study.
void require_cell(const Study& study, const Cell& cell);

/// Every cell: fields, counterbalances and squares crossed. `order` gives all orders of two or
/// three arms, of more the rows of a Williams square; `latin` those of a Latin square. One
/// empty cell for a study in which nothing differs.
[[nodiscard]] std::vector<Cell> cells_of(const Study& study);

/// One thing that differs between participants, with all that it can be.
struct Factor {
  std::string name;  ///< See `Assignment`.
  std::vector<std::vector<std::string>> alternatives;
  bool is_field = false;    ///< The participant brings it; nobody assigns it.
  std::string stratify_by;  ///< The field within whose values it is balanced; "": all together.
};

/// In the order of cells.
[[nodiscard]] std::vector<Factor> factors_of(const Study& study);

/// What participants bring: name of a field to one of its values.
using FieldValues = std::map<std::string, std::string>;

/// The part of a cell that the participant brought.
[[nodiscard]] FieldValues field_values(const Study& study, const Cell& cell);

/// Why these are not the values of the study's fields, each one of its own: "expected
/// `sex=VALUE`, VALUE being `female` or `male`, found nothing"; "" if they are.
[[nodiscard]] std::string field_problem(const Study& study, const FieldValues& values);

/// The row of its square, from 0, that a participant of this cell begins a block with; 0 for
/// one without a square.
[[nodiscard]] std::size_t order_row(const Cell& cell, const std::string& block);

/// Counterbalance or field to the one arm or value that a participant of this cell has; nothing
/// of orders.
[[nodiscard]] Levels people_levels(const Cell& cell);

/// What a cell says of this counterbalance, block or field; null for nothing.
[[nodiscard]] const Assignment* find_assignment(const Cell& cell,
                                                const std::string& counterbalance);

}  // namespace jnd::experiments
