#include "core/storage/study_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/storage/row_statements.h"
#include "core/storage/study_store.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace study_rows_test {

struct Place {
  std::size_t from = 0, size = 0, alignment = 0;
};

template <typename Value>
Place place_in(const void* row, const Value& value) {
  return {static_cast<std::size_t>(reinterpret_cast<const char*>(&value) -
                                   static_cast<const char*>(row)),
          sizeof(Value), alignof(Value)};
}

template <typename Row, typename Value>
Place place_of(const Row& row, const StoredColumn<Row, Value>& column) {
  return place_in(&row, row.*column.field);
}
template <typename Row, typename Part>
Place place_of(const Row& row, const StoredPart<Row, Part>& whole) {
  return place_in(&row, row.*whole.part);
}

std::size_t aligned(std::size_t from, std::size_t alignment) {
  return (from + alignment - 1) / alignment * alignment;
}

template <typename Row>
class StudyRowsTest : public ::testing::Test {};
using Rows = ::testing::Types<EventRow, DesignRow, PresentationMeasures, PresentationRow,
                              AnswerMeasures, TrialRow, AnswerRow, SessionRow>;
TYPED_TEST_SUITE(StudyRowsTest, Rows);

TYPED_TEST(StudyRowsTest, EveryFieldHasAColumn) {
  const TypeParam row;
  std::vector<Place> places;
  std::apply([&](const auto&... column) { (places.push_back(place_of(row, column)), ...); },
             kColumns<TypeParam>);
  std::ranges::sort(places, {}, &Place::from);
  std::size_t end = 0;
  for (const Place& place : places) {
    EXPECT_EQ(place.from, aligned(end, place.alignment)) << "behind byte " << end;
    end = place.from + place.size;
  }
  EXPECT_EQ(sizeof(TypeParam), aligned(end, alignof(TypeParam))) << "the last field";
}

TYPED_TEST(StudyRowsTest, EveryColumnHasANameOfItsOwn) {
  std::set<std::string> names;
  std::size_t num_columns = 0;
  for_each_column<TypeParam>([&](const auto& column, const auto&) {
    names.insert(column.name);
    ++num_columns;
  });
  EXPECT_EQ(names.size(), num_columns);
}

/// Returns a row in which every column differs from that of a new row.
template <typename Row>
Row filled() {
  Row row;
  std::int64_t number = 1;
  const auto fill = [&]<typename Value>(Value& value) {
    if constexpr (std::same_as<Value, std::string>) {
      value = "text " + std::to_string(number);
    } else if constexpr (std::same_as<Value, bool>) {
      value = !value;
    } else {
      value = static_cast<Value>(number);
    }
    ++number;
  };
  for_each_column<Row>([&](const auto&, const auto& value_in) { fill(value_in(row)); });
  return row;
}

template <typename Row>
std::string text_of(const Row& row) {
  std::string text;
  const auto add = [&]<typename Value>(const Value& value) {
    if constexpr (std::same_as<Value, std::string>) {
      text += value + '|';
    } else if constexpr (requires { value.has_value(); }) {
      text += (value ? std::to_string(*value) : "-") + '|';
    } else {
      text += std::to_string(value) + '|';
    }
  };
  for_each_column<Row>([&](const auto&, const auto& value_in) { add(value_in(row)); });
  return text;
}

template <typename Row>
void expect_comes_back(Database& database, const std::string& table) {
  for (const Row& row : {filled<Row>(), Row{}}) {
    Statement statement(database, insert_into<Row>(table));
    insert(row, statement);
    Statement rows(database, select_from<Row>(table) + " ORDER BY rowid DESC");
    ASSERT_TRUE(rows.step());
    EXPECT_EQ(text_of(read_row<Row>(rows)), text_of(row)) << table;
  }
}

TEST(StudyRows, EveryColumnComesBackFromTheDatabaseAsItWas) {
  Database database;
  const auto table = [&]<typename Row>(const std::string& name, const Row&) {
    database.execute("CREATE TABLE " + name + " (" + column_names<Row>() + ")");
    expect_comes_back<Row>(database, name);
  };
  table("events", EventRow{});
  table("designs", DesignRow{});
  table("presentations", PresentationRow{});
  table("trials", TrialRow{});
  table("answers", AnswerRow{});
  table("sessions", SessionRow{});
}

TEST(StudyRows, ASeedOf64BitsLosesNone) {
  const test_support::TemporaryFolder temporary;
  StudyStore store(temporary.path() / "a.study", StudyStore::Mode::kCreate);
  const std::string hash = store.add_protocol("a.json", "{}");
  store.add_session({.participant = "P01", .protocol_sha256 = hash, .seed = UINT64_MAX - 1});
  EXPECT_EQ(store.session(1).seed, UINT64_MAX - 1);
}

struct Narrow {
  int number = 0;
  std::optional<int> other;
};
struct Wide {
  std::string between;
  std::optional<std::int64_t> other;
  std::int64_t number = 0;
};

}  // namespace study_rows_test

template <>
inline constexpr auto kColumns<study_rows_test::Narrow> =
    std::tuple{StoredColumn{&study_rows_test::Narrow::number, "number"},
               StoredColumn{&study_rows_test::Narrow::other, "other"}};
template <>
inline constexpr auto kColumns<study_rows_test::Wide> =
    std::tuple{StoredColumn{&study_rows_test::Wide::between, "between"},
               StoredColumn{&study_rows_test::Wide::other, "other"},
               StoredColumn{&study_rows_test::Wide::number, "number"}};

namespace study_rows_test {

TEST(StoredColumn, AreCopiedAndComparedByTheirNames) {
  Wide wide{.between = "kept"};
  copy_columns(Narrow{.number = 3, .other = 4}, wide);
  EXPECT_EQ(wide.number, 3);
  EXPECT_EQ(wide.other, 4);
  EXPECT_EQ(wide.between, "kept");
  EXPECT_TRUE(has_same_columns(Narrow{.number = 3, .other = 4}, wide));
  EXPECT_FALSE(has_same_columns(Narrow{.number = 3}, wide));
  EXPECT_FALSE(has_same_columns(Narrow{.number = 2, .other = 4}, wide));
}

}  // namespace study_rows_test
}  // namespace jnd::core
