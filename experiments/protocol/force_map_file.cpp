#include "experiments/protocol/force_map_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "experiments/study/shown_text.h"

namespace jnd::experiments {
namespace {

constexpr std::string_view kHeader =
    "angle_of_attack_rad,speed_m_per_s,drag_coefficient,lift_coefficient";
constexpr std::array<std::string_view, 4> kColumns = {"angle_of_attack_rad", "speed_m_per_s",
                                                      "drag_coefficient", "lift_coefficient"};
// Far more than a measurement has. Each row costs memory that is locked for the loop.
constexpr std::size_t kMostRows = 20'000;

[[noreturn]] void refuse(const std::string& file_name, int line, const std::string& message) {
  throw core::Error(file_name + ": line " + std::to_string(line) + ": " + message);
}

/// Takes the next piece, up to `separator`, off `text` and returns it.
std::string_view next_piece(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view piece = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return piece;
}

double number_from(std::string_view cell, std::string_view column, const std::string& file_name,
                   int line) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) {
    refuse(file_name, line,
           std::string(column) + ": expected a number, found `" + shown_text(cell, 30) + "`");
  }
  return value;
}

core::ForceMap::Row row_from(std::string_view text, const std::string& file_name, int line) {
  const auto num_cells =
      static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')) + 1;
  if (num_cells != kColumns.size()) {
    refuse(file_name, line,
           "expected four numbers, one for each column, found " + std::to_string(num_cells));
  }
  std::array<double, kColumns.size()> values{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    values[i] = number_from(next_piece(text, ','), kColumns[i], file_name, line);
  }
  return {values[0], values[1], values[2], values[3], line};
}

}  // namespace

core::ForceMap parse_force_map(std::string_view text, const std::string& file_name) {
  std::vector<core::ForceMap::Row> rows;
  bool has_header = false;
  int line = 0;
  while (!text.empty()) {
    std::string_view here = next_piece(text, '\n');
    ++line;
    if (here.ends_with('\r')) here.remove_suffix(1);
    if (here.empty() || here.starts_with('#')) continue;
    if (!has_header) {
      if (here != kHeader) {
        refuse(file_name, line,
               "expected the words " + std::string(kHeader) + " above the numbers, found `" +
                   shown_text(here, 60) + "`");
      }
      has_header = true;
      continue;
    }
    if (rows.size() == kMostRows) {
      refuse(file_name, line,
             "expected at most " + std::to_string(kMostRows) + " rows, found more");
    }
    rows.push_back(row_from(here, file_name, line));
  }
  if (rows.empty()) {
    throw core::Error(file_name + ": expected the words " + std::string(kHeader) +
                      " and rows of four numbers below, found none");
  }
  try {
    return core::ForceMap(std::move(rows));
  } catch (const core::Error& error) {
    throw core::Error(file_name + ": " + error.what());
  }
}

core::ForceMap read_force_map(const std::filesystem::path& file) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  // Reading a folder would throw something else.
  if (!stream.is_open() || std::filesystem::is_directory(file, ignored)) {
    throw core::Error(file.string() +
                      ": expected a force map that can be read, found none; check its name");
  }
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_force_map(text, file.string());
}

}  // namespace jnd::experiments
