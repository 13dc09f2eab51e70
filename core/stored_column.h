#pragma once

#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>

namespace jnd::core {

/// How the JSON of an event stores the value of a column.
enum class EventKey {
  /// Left out if the value is missing or 0. Use it for every new column, because events of
  /// older programs do not have it.
  kWhereThere,
  kLater,   ///< null if the value is missing; left out only by older programs.
  kAlways,  ///< null if the value is missing; an event without it is damaged.
};

/// Whether the events of a BIDS data set have a column for this measure of a presentation.
enum class BidsEvents { kHave, kHaveNot };

/// A column of a stored row: a field, and everything about it. The SQL, reading and writing,
/// the key of the event's JSON, and the column and codebook of every data set follow from it.
/// The field's type says how it is stored: bool, integer, double, text, or a number that may be
/// missing. An unsigned integer of 64 bits is stored as text.
template <typename Row, typename Value>
struct StoredColumn {
  Value Row::*field;
  /// The one spelling of its name, for the field, SQL, JSON and data sets.
  const char* name;
  const char* unit = "";   ///< "" if it has no unit.
  const char* words = "";  ///< Words for the codebook; "" if data sets do not have this column.
  EventKey key = EventKey::kWhereThere;
  BidsEvents bids_events = BidsEvents::kHave;
};
template <typename Row, typename Value, typename... Rest>
StoredColumn(Value Row::*, Rest...) -> StoredColumn<Row, Value>;

/// The columns of a struct that is a member of the row.
template <typename Row, typename Part>
struct StoredPart {
  Part Row::*part;
};
template <typename Row, typename Part>
StoredPart(Part Row::*) -> StoredPart<Row, Part>;

/// The columns of a row, in the order in which data sets have them: a tuple of `StoredColumn`
/// and `StoredPart`, defined beside the struct.
template <typename Row>
inline constexpr std::tuple<> kColumns{};

template <typename Row, typename Visit>
constexpr void for_each_column(const Visit& visit);

template <typename Row, typename Value, typename Visit>
constexpr void visit_column(const StoredColumn<Row, Value>& column, const Visit& visit) {
  visit(
      column, [field = column.field](auto& row) -> auto& { return row.*field; });
}

template <typename Row, typename Part, typename Visit>
constexpr void visit_column(const StoredPart<Row, Part>& whole, const Visit& visit) {
  for_each_column<Part>([&](const auto& column, auto value_in) {
    visit(
        column,
        [ part = whole.part, value_in ](auto& row) -> auto& { return value_in(row.*part); });
  });
}

/// Calls `visit(column, value_in)` for every column in order, with those of parts in their
/// place. `value_in(row)` is a reference to the column's value in a row.
template <typename Row, typename Visit>
constexpr void for_each_column(const Visit& visit) {
  static_assert(std::tuple_size_v<decltype(kColumns<Row>)> > 0, "the row has no columns");
  std::apply([&](const auto&... column) { (visit_column(column, visit), ...); }, kColumns<Row>);
}

template <typename Row, typename Value>
constexpr std::string_view name_of(const StoredColumn<Row, Value>& column) {
  return column.name;
}
template <typename Row, typename Part>
constexpr std::string_view name_of(const StoredPart<Row, Part>&) {
  return "";
}

/// Returns the place of the column with this name in the table of a row, or the number of
/// columns if there is none.
template <typename Row>
constexpr std::size_t place_of_column(std::string_view name) {
  std::size_t place = 0;
  bool found = false;
  const auto look = [&](const auto& column) {
    found = found || name_of(column) == name;
    place += found ? 0 : 1;
  };
  std::apply([&](const auto&... column) { (look(column), ...); }, kColumns<Row>);
  return place;
}

/// Calls `visit(value_in_a, value_in_b)` with pointers to members for every column of `A`. `B`
/// must have a column of each name.
template <typename A, typename B, typename Visit>
constexpr void for_each_shared_column(const Visit& visit) {
  [&]<std::size_t... kPlaces>(std::index_sequence<kPlaces...>) {
    (visit(
         std::get<kPlaces>(kColumns<A>).field,
         std::get<place_of_column<B>(std::get<kPlaces>(kColumns<A>).name)>(kColumns<B>).field),
     ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(kColumns<A>)>>());
}

/// Copies to `to` the columns that `from` has.
template <typename From, typename To>
void copy_columns(const From& from, To& to) {
  for_each_shared_column<From, To>(
      [&](auto in_from, auto in_to) { to.*in_to = from.*in_from; });
}

/// Whether `b` has the same values as `a` in the columns of `a`.
template <typename A, typename B>
[[nodiscard]] bool has_same_columns(const A& a, const B& b) {
  bool same = true;
  for_each_shared_column<A, B>(
      [&](auto in_a, auto in_b) { same = same && a.*in_a == b.*in_b; });
  return same;
}

}  // namespace jnd::core
