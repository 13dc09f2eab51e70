#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// What one counterbalance assigns to a participant: all of its arms in an order, or one of
/// them. A block whose stimuli come in a square assigns "row_1", "row_2" and so on. A
/// participant field assigns the value that the participant has.
struct Assignment {
  std::string counterbalance;     ///< Name of its stage, of the block, or of the field.
  std::vector<std::string> arms;  ///< Names in the order in which they are run.

  bool operator==(const Assignment&) const = default;
};

/// One assignment for each field of a study, then for each counterbalance and square in the
/// order of the stages.
using Cell = std::vector<Assignment>;

/// Returns the form that is stored and shown, such as
/// "sex=female;priming=primed;method_order=estimation,production"; "" if participants do not
/// differ.
[[nodiscard]] std::string to_string(const Cell& cell);

/// Reads that form. Throws `Error` if it is no cell of this study.
[[nodiscard]] Cell cell_from_text(const Study& study, const std::string& text);

/// Throws `Error` if it is no cell of this study.
void require_cell(const Study& study, const Cell& cell);

/// Returns every cell, by crossing fields, counterbalances and squares. `order` gives all
/// orders of two or three arms, and the rows of a Williams square for more. `latin` gives the
/// rows of a Latin square. A study whose participants do not differ has one empty cell.
[[nodiscard]] std::vector<Cell> cells_of(const Study& study);

/// One thing in which participants differ, with all its alternatives.
struct Factor {
  std::string name;  ///< As in `Assignment`.
  std::vector<std::vector<std::string>> alternatives;
  bool is_field = false;  ///< The participant has this value; nobody assigns it.
  /// Field within whose values the factor is balanced; "" for all participants together.
  std::string stratify_by;
};

/// Returns the factors in the order of cells.
[[nodiscard]] std::vector<Factor> factors_of(const Study& study);

/// The fields of a participant: name of a field to one of its values.
using FieldValues = std::map<std::string, std::string>;

/// Returns the part of a cell that are the participant's fields.
[[nodiscard]] FieldValues field_values(const Study& study, const Cell& cell);

/// Returns why these are not one value for each field of the study, such as "expected
/// `sex=VALUE`, VALUE being `female` or `male`, found nothing"; "" if they are.
[[nodiscard]] std::string field_problem(const Study& study, const FieldValues& values);

/// Returns the row of the square with which a participant of this cell begins the block, from
/// 0. Returns 0 for a block without a square.
[[nodiscard]] std::size_t order_row(const Cell& cell, const std::string& block);

/// Returns counterbalance or field to the arm or value of a participant of this cell. Orders
/// are left out.
[[nodiscard]] Levels people_levels(const Cell& cell);

/// Returns the cell's assignment of this counterbalance, block or field, or null if there is
/// none.
[[nodiscard]] const Assignment* find_assignment(const Cell& cell,
                                                const std::string& counterbalance);

}  // namespace jnd::experiments
