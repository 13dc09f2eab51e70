#include "analysis/export/hdf5_table_writer.h"

#include <cmath>

#include "core/error.h"

namespace jnd::analysis {

Hdf5TableWriter::Hdf5TableWriter(const std::vector<CsvColumn>& columns)
    : columns_(columns), data_(columns.size()) {}

/// A real column accepts whole numbers too. Any other mismatch of types is an error in the
/// program.
Hdf5TableWriter::Column& Hdf5TableWriter::next(ColumnType type) {
  if (num_cells_ < columns_.size() && columns_[num_cells_].type == type) {
    return data_[num_cells_++];
  }
  throw core::Error(
      "table: expected a cell of the type of its column, found another in column " +
      (num_cells_ < columns_.size() ? std::string(columns_[num_cells_].name) : "beyond"));
}

void Hdf5TableWriter::put_text(std::string_view text) {
  next(ColumnType::kText).texts.emplace_back(text);
}

void Hdf5TableWriter::put_count(std::int64_t number) {
  if (num_cells_ < columns_.size() && columns_[num_cells_].type == ColumnType::kReal) {
    return put_real(static_cast<double>(number));
  }
  next(ColumnType::kCount).counts.push_back(number);
}

void Hdf5TableWriter::put_real(double number) {
  next(ColumnType::kReal).reals.push_back(std::isfinite(number) ? number : NAN);
}

void Hdf5TableWriter::put_nothing() { put_real(NAN); }

void Hdf5TableWriter::end_row() {
  if (num_cells_ != columns_.size()) {
    throw core::Error("table: expected " + std::to_string(columns_.size()) +
                      " cells in a row, found " + std::to_string(num_cells_));
  }
  num_cells_ = 0;
}

void Hdf5TableWriter::write(const Hdf5Group& group) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const CsvColumn& column = columns_[i];
    switch (column.type) {
      case ColumnType::kText:
        group.texts(column.name, data_[i].texts, column.meaning);
        break;
      case ColumnType::kCount:
        group.column(column.name, Hdf5Number::kInt64, column.unit, column.meaning)
            .append(data_[i].counts);
        break;
      case ColumnType::kReal:
        group.column(column.name, Hdf5Number::kDouble, column.unit, column.meaning)
            .append(data_[i].reals);
        break;
    }
  }
}

}  // namespace jnd::analysis
