#include "analysis/data/cell_arms.h"

#include <algorithm>

namespace jnd::analysis {

std::map<std::string, std::string> arms_of(const std::string& cells) {
  std::map<std::string, std::string> arms;
  for (std::size_t begin = 0; begin < cells.size();) {
    const std::size_t end = std::min(cells.find(';', begin), cells.size());
    const std::string cell = cells.substr(begin, end - begin);
    if (const std::size_t equals = cell.find('='); equals != std::string::npos) {
      arms[cell.substr(0, equals)] = cell.substr(equals + 1);
    }
    begin = end + 1;
  }
  return arms;
}

}  // namespace jnd::analysis
