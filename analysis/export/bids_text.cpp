#include "analysis/export/bids_text.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"

namespace jnd::analysis {
namespace {

/// Whether a unit of the tables is a unit for BIDS, which uses SI symbols.
bool is_unit(const std::string& unit) {
  return !unit.empty() && unit != "tick" && unit != "ticks" && unit != "unit of quantity";
}

std::string letters_and_digits(const std::string& name) {
  std::string label;
  for (const unsigned char letter : name) {
    if (letter < 128 && std::isalnum(letter) != 0) label += static_cast<char>(letter);
  }
  return label.empty() ? "x" : label;
}

std::string lower(std::string text) {
  for (char& letter : text) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return text;
}

struct UtcTime {
  std::chrono::year_month_day date;
  std::chrono::hh_mm_ss<std::chrono::microseconds> time;
};

UtcTime utc(std::int64_t time_ns) {
  using namespace std::chrono;
  const auto since_epoch = floor<microseconds>(nanoseconds(time_ns));
  const auto day = floor<days>(since_epoch);
  return {year_month_day(sys_days(day)), hh_mm_ss<microseconds>(since_epoch - day)};
}

}  // namespace

std::map<std::string, std::string> bids_labels(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  std::map<std::string, std::string> labels;
  std::set<std::string> taken;
  // A name that is a valid label keeps it, even if other names would give the same label.
  std::stable_partition(names.begin(), names.end(), [](const std::string& name) {
    return letters_and_digits(name) == name;
  });
  for (const std::string& name : names) {
    if (labels.contains(name)) continue;
    const std::string wanted = letters_and_digits(name);
    std::string label = wanted;
    for (int number = 2; !taken.insert(lower(label)).second; ++number) {
      label = wanted + "x" + std::to_string(number);
    }
    labels.emplace(name, label);
  }
  return labels;
}

std::string iso_date(std::int64_t time_ns) {
  const auto date = utc(time_ns).date;
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text;
}

std::string iso_time(std::int64_t time_ns) {
  const auto time = utc(time_ns).time;
  char text[64];
  std::snprintf(
      text, sizeof text, "T%02d:%02d:%02d.%06dZ", static_cast<int>(time.hours().count()),
      static_cast<int>(time.minutes().count()), static_cast<int>(time.seconds().count()),
      static_cast<int>(time.subseconds().count()));
  return iso_date(time_ns) + text;
}

nlohmann::ordered_json described(const std::vector<CsvColumn>& columns,
                                 std::size_t num_left_out) {
  nlohmann::ordered_json sidecar = nlohmann::ordered_json::object();
  for (std::size_t i = num_left_out; i < columns.size(); ++i) {
    nlohmann::ordered_json& column = sidecar[columns[i].name];
    column["Description"] = columns[i].meaning;
    if (is_unit(columns[i].unit)) column["Units"] = columns[i].unit;
  }
  return sidecar;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  errno = 0;
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  bool written = stream != nullptr;
  if (written) {
    written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    written = std::fclose(stream) == 0 && written;
  }
  if (written) return;
  throw core::Error(file.string() + ": expected to write this file, found that it cannot be: " +
                    std::strerror(errno));
}

void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) {
  write_text(file,
             json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace jnd::analysis
