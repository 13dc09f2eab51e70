#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/export/table_rows.h"
#include "analysis/export/table_writer.h"

namespace jnd::analysis {

/// The factors of the studies as columns of a table of trials, so that each trial shows its
/// condition. Not real time.
class FactorColumns {
 public:
  /// Collects the factors of these sessions' studies. `table` holds the other columns. If a
  /// factor's name is taken, its level is in `field_FACTOR`.
  FactorColumns(const core::StudyStore& store, const std::vector<core::SessionRow>& sessions,
                const std::vector<CsvColumn>& table);

  /// The columns of the table, and then those of the factors. They live as long as this object.
  [[nodiscard]] const std::vector<CsvColumn>& columns() const noexcept { return columns_; }
  /// Writes the trial's level of each factor: that of its block, or the participant's arm. A
  /// cell is empty if there is none. It does not end the row.
  void put(TableWriter& table, const core::SessionRow& session, const ExportedTrial& trial);

 private:
  struct Factor {
    std::string name, column, meaning;
  };

  StoredStudies studies_;
  std::vector<Factor> factors_;
  std::vector<CsvColumn> columns_;
};

}  // namespace jnd::analysis
