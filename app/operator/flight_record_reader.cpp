#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "app/language/words.h"
#include "app/operator/session_record.h"
#include "core/error.h"
#include "core/hand.h"

namespace jnd::app {
namespace {

std::vector<std::string_view> cells_of_row(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// NaN if the cell is no number.
double number_in(std::string_view cell) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

/// The places of a quantity's three columns for every point, such as "palm_inner_force_x_n".
class PointColumns {
 public:
  PointColumns(const std::vector<std::string_view>& names, const std::string& quantity,
               const std::string& unit, const std::filesystem::path& file) {
    for (std::size_t point = 0; point < columns_.size(); ++point) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string name = std::string(core::kContactPointNames[point]) + "_" + quantity +
                                 "_" + "xyz"[axis] + "_" + unit;
        const auto found = std::ranges::find(names, name);
        if (found == names.end()) {
          throw core::Error(
              tr("{}: expected the last second before a fault, found no column {}",
                 file.string(), name));
        }
        columns_[point][axis] = static_cast<std::size_t>(found - names.begin());
      }
    }
  }
  [[nodiscard]] std::array<double, 3> at(const std::vector<std::string_view>& cells,
                                         std::size_t point) const {
    std::array<double, 3> vector{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t column = columns_[point][axis];
      if (column < cells.size()) vector[axis] = number_in(cells[column]);
    }
    return vector;
  }

 private:
  std::array<std::array<std::size_t, 3>, core::kNumContactPoints> columns_{};
};

double size_of_vector(const std::array<double, 3>& vector) {
  return std::hypot(vector[0], vector[1], vector[2]);
}

}  // namespace

FlightRecord read_flight_record(const std::filesystem::path& file, double rate_hz) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  const std::string head = line;
  const std::vector<std::string_view> names = cells_of_row(head);
  const PointColumns forces(names, "force", "n", file);
  const PointColumns velocities(names, "velocity", "m_per_s", file);
  FlightRecord record;
  std::vector<double> ticks;
  while (std::getline(stream, line)) {
    const std::vector<std::string_view> cells = cells_of_row(line);
    ticks.push_back(number_in(cells.front()));
    std::array<double, 3> sum_n{};
    double fastest_m_per_s = 0.0;
    for (std::size_t point = 0; point < core::kNumContactPoints; ++point) {
      const std::array<double, 3> force_n = forces.at(cells, point);
      for (std::size_t axis = 0; axis < 3; ++axis) sum_n[axis] += force_n[axis];
      fastest_m_per_s = std::max(fastest_m_per_s, size_of_vector(velocities.at(cells, point)));
    }
    record.force_n.push_back(size_of_vector(sum_n));
    record.speed_m_per_s.push_back(fastest_m_per_s);
  }
  if (ticks.empty()) {
    throw core::Error(
        tr("{}: expected the last second before a fault, found no sample", file.string()));
  }
  for (const double tick : ticks) record.time_s.push_back((tick - ticks.back()) / rate_hz);
  return record;
}

}  // namespace jnd::app
