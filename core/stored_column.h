#pragma once

#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>

namespace jnd::core {

/// How the data of an event has what a column holds, where an event tells of it.
enum class EventKey {
  kWhereThere,  ///< Left out where there is none, or 0. For every new column: events of older
                ///< programs know nothing of it.
  kLater,       ///< null where there is none; left out by older programs alone.
  kAlways,      ///< null where there is none; an event without it is damaged.
};

/// Whether BIDS tells of what was measured in a presentation, among the columns of its events.
enum class BidsEvents { kHave, kHaveNot };

/// A column of a stored row: a field with what everybody has to know of it. From here follow
/// the SQL, its values in and out, the key of the event's JSON, and column and codebook of
/// every data set. What may be stored is told by the type of the field: a bool, a whole number,
/// a double, a text, or a number that may be missing; one without sign of 64 bits is stored as
/// text.
template <typename Row, typename Value>
struct StoredColumn {
  Value Row::*field;
  const char* name;        ///< One spelling: of the field, in SQL, JSON and data sets.
  const char* unit = "";   ///< "" where there is none.
  const char* words = "";  ///< For the codebook; "": data sets have no such column.
  EventKey key = EventKey::kWhereThere;
  BidsEvents bids_events = BidsEvents::kHave;
};
template <typename Row, typename Value, typename... Rest>
StoredColumn(Value Row::*, Rest...) -> StoredColumn<Row, Value>;

/// Columns of a struct that the row holds, among its own.
template <typename Row, typename Part>
struct StoredPart {
  Part Row::*part;
};
template <typename Row, typename Part>
StoredPart(Part Row::*) -> StoredPart<Row, Part>;

/// The columns of a row, in the order in which data sets have them: a tuple of `StoredColumn`
/// and `StoredPart`, beside the struct.
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

/// Calls `visit(column, value_in)` for every column in its order, those of parts in their
/// place. `value_in(row)` is the column's value in a row, to be read or set.
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

/// Where the table of a row has the column of this name; behind its end where it has none.
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

/// Calls `visit(value_in_a, value_in_b)`, members of each, for every column of `A`: `B` has to
/// have one of each name.
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

/// Sets the columns of `to` that `from` has, too.
template <typename From, typename To>
void copy_columns(const From& from, To& to) {
  for_each_shared_column<From, To>(
      [&](auto in_from, auto in_to) { to.*in_to = from.*in_from; });
}

/// Whether `b` has in the columns of `a` what that has.
template <typename A, typename B>
[[nodiscard]] bool has_same_columns(const A& a, const B& b) {
  bool same = true;
  for_each_shared_column<A, B>(
      [&](auto in_a, auto in_b) { same = same && a.*in_a == b.*in_b; });
  return same;
}

}  // namespace jnd::core
