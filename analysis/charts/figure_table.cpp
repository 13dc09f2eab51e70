#include "analysis/charts/figure_table.h"

#include <algorithm>

namespace jnd::analysis {

std::size_t FigureTable::place_of(const std::string& column) const {
  return static_cast<std::size_t>(std::ranges::find(columns, column) - columns.begin());
}

std::string file_word(const std::string& text) {
  std::string word;
  for (const char letter : text) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= '0' && letter <= '9');
    word += plain ? letter : '_';
  }
  return word.empty() ? "_" : word;
}

}  // namespace jnd::analysis
