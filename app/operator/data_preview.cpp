#include "app/operator/data_preview.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/data/answer_cells.h"
#include "analysis/data/answer_rows.h"

namespace jnd::app {
namespace {

/// Whether the reader of answers takes this cell for a yes or a no by itself.
bool is_plain_answer(std::string_view cell, bool decimal_comma) {
  const double value = analysis::number_of(cell, decimal_comma);
  if (value == 0.0 || value == 1.0 || value == -1.0) return true;
  return std::ranges::any_of(std::initializer_list<const char*>{"true", "false", "yes", "no"},
                             [&](const char* word) { return analysis::same_word(cell, word); });
}

/// Keeps the first rows, and what every column contains.
class PreviewSink final : public analysis::RowSink {
 public:
  PreviewSink(const std::filesystem::path& file, WorkControl& control)
      : RowSink(file.string()), control_(control) {
    preview_.file = file;
  }

  void set_header(std::vector<std::string> header, int /*line*/) override {
    for (std::string& name : header) preview_.columns.push_back({.name = std::move(name)});
    known_.resize(preview_.columns.size());
  }
  void add_row(const std::vector<std::string_view>& cells, int /*line*/,
               bool decimal_comma) override {
    constexpr std::int64_t kRowsBetweenLooks = 4096;
    if (preview_.num_rows % kRowsBetweenLooks == 0) control_.stop_if_cancelled();
    ++preview_.num_rows;
    preview_.decimal_comma = decimal_comma;
    for (std::size_t i = 0; i < preview_.columns.size(); ++i) {
      look_at(i, i < cells.size() ? cells[i] : std::string_view(), decimal_comma);
    }
    if (preview_.rows.size() >= DataPreview::kMostRows) return;
    std::vector<std::string>& row = preview_.rows.emplace_back();
    for (std::size_t i = 0; i < preview_.columns.size(); ++i) {
      row.emplace_back(i < cells.size() ? cells[i] : std::string_view());
    }
  }
  [[nodiscard]] DataPreview finish() {
    problems().throw_problems();
    for (PreviewColumn& column : preview_.columns) {
      // Nothing is known about a column without any cell.
      if (column.num_missing < preview_.num_rows) continue;
      column.is_numeric = column.is_whole = column.is_yes_or_no = false;
    }
    return std::move(preview_);
  }

 private:
  void look_at(std::size_t place, std::string_view cell, bool decimal_comma) {
    PreviewColumn& column = preview_.columns[place];
    if (analysis::is_missing(cell)) {
      ++column.num_missing;
      return;
    }
    std::set<std::string, std::less<>>& known = known_[place];
    if (known.contains(cell)) return;
    if (known.size() < PreviewColumn::kMost) {
      known.emplace(cell);
      column.cells.emplace_back(cell);
    } else {
      column.has_more_cells = true;
    }
    const double value = analysis::number_of(cell, decimal_comma);
    column.is_numeric = column.is_numeric && std::isfinite(value);
    column.is_whole = column.is_whole && value >= 0.0 && value == std::floor(value);
    column.is_yes_or_no = column.is_yes_or_no && is_plain_answer(cell, decimal_comma);
  }

  WorkControl& control_;
  DataPreview preview_;
  /// The different cells of each column.
  std::vector<std::set<std::string, std::less<>>> known_;
};

}  // namespace

std::size_t DataPreview::place_of(const std::string& column) const {
  const auto found = std::ranges::find(columns, column, &PreviewColumn::name);
  return static_cast<std::size_t>(found - columns.begin());
}

DataPreview read_preview(const std::filesystem::path& file, WorkControl& control) {
  PreviewSink sink(file, control);
  analysis::read_rows(file, sink);
  return sink.finish();
}

}  // namespace jnd::app
