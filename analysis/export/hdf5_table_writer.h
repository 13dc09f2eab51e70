#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/export/hdf5_file.h"
#include "analysis/export/table_writer.h"

namespace jnd::analysis {

/// Collects a table and writes it as a group, with a dataset for each column and its unit and
/// meaning as attributes. Missing numbers are NaN, and missing texts are empty. Throws `Error`.
/// Not real time.
class Hdf5TableWriter final : public TableWriter {
 public:
  explicit Hdf5TableWriter(const std::vector<CsvColumn>& columns);

  void end_row() override;
  void write(const Hdf5Group& group) const;

 private:
  struct Column {
    std::vector<std::string> texts;
    std::vector<std::int64_t> counts;
    std::vector<double> reals;
  };

  void put_text(std::string_view text) override;
  void put_count(std::int64_t number) override;
  void put_real(double number) override;
  void put_nothing() override;
  Column& next(ColumnType type);

  const std::vector<CsvColumn>& columns_;
  std::vector<Column> data_;
  std::size_t num_cells_ = 0;
};

}  // namespace jnd::analysis
