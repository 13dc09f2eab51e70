#pragma once

#include <string>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// One column of the data that a stage writes, under the name it has in `jnd export csv`.
struct WrittenColumn {
  std::string file;  ///< "trials.csv".
  std::string column;
  std::string unit;  ///< "" where there is none.
  std::string meaning;
  std::vector<Condition> only_where{};  ///< Of the stage; empty otherwise.
};

/// What a stage of this kind writes, beside the identifying columns that every row has
/// (`session`, `participant`, `stage`). A procedure without columns of its own has the common
/// ones of all blocks.
[[nodiscard]] std::vector<WrittenColumn> written_columns(const ParameterTable& stage);

}  // namespace jnd::experiments
