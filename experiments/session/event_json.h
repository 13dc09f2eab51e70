#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>

#include "core/error.h"
#include "core/stored_column.h"
#include "experiments/study/shown_text.h"

namespace jnd::experiments {

// Reading and writing of values in the data of events. The reading functions throw if they do
// not find a value.

/// The largest integer on which JSON and SQL agree.
inline constexpr std::int64_t kLargestWhole = std::int64_t{1} << 53;

/// Returns a whole number of the data. The library itself would truncate 1.5 to 1, and 2^40 to
/// an int.
template <typename Whole = std::int64_t>
[[nodiscard]] Whole whole_number(const nlohmann::json& value, const char* key) {
  constexpr std::int64_t kLargest =
      std::min<std::int64_t>(kLargestWhole, std::numeric_limits<Whole>::max());
  const bool fits = value.is_number_unsigned()
                        ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(kLargest)
                        : value.is_number_integer() && value.get<std::int64_t>() >= -kLargest;
  if (fits) return value.get<Whole>();
  throw core::Error(std::string(key) + ": expected a whole number up to " +
                    std::to_string(kLargest) + ", found " + shown_text(value.dump()));
}

/// Returns null for a missing value.
template <typename Value>
[[nodiscard]] nlohmann::json json_of(const Value& value) {
  return value;
}
template <typename Value>
[[nodiscard]] nlohmann::json json_of(const std::optional<Value>& value) {
  return value ? json_of(*value) : nlohmann::json(nullptr);
}

template <typename Value>
void read_json(const nlohmann::json& value, const char* key, Value& to) {
  if constexpr (std::integral<Value> && !std::same_as<Value, bool>) {
    to = whole_number<Value>(value, key);
  } else {
    value.get_to(to);
  }
}
template <typename Value>
void read_json(const nlohmann::json& value, const char* key, std::optional<Value>& to) {
  to.reset();
  if (!value.is_null()) read_json(value, key, to.emplace());
}

/// Writes the columns of a struct as keys of the data, as each column's `EventKey` says.
template <typename Part>
void write_columns(const Part& part, nlohmann::json& data) {
  core::for_each_column<Part>([&](const auto& column, const auto& value_in) {
    const auto& value = value_in(part);
    const bool is_something = value != std::remove_cvref_t<decltype(value)>{};
    if (column.key == core::EventKey::kWhereThere && !is_something) return;
    data[column.name] = json_of(value);
  });
}

/// The inverse. Fields whose keys may be absent and are absent stay as they are.
template <typename Part>
void read_columns(const nlohmann::json& data, Part& part) {
  core::for_each_column<Part>([&](const auto& column, const auto& value_in) {
    if (column.key != core::EventKey::kAlways && !data.contains(column.name)) return;
    read_json(data.at(column.name), column.name, value_in(part));
  });
}

}  // namespace jnd::experiments
