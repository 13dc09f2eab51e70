#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::experiments {

/// What a value of a study file, or of another file with such tables, is.
enum class ValueKind {
  kString,  ///< Words for people or one of `allowed`; not empty, but where `may_be_empty`.
  kName,    ///< [a-z0-9_], 1 to 64 of them.
  kText,    ///< Words in every language of the study: {"en": "...", "de": "..."}.
  kNumber,
  kInteger,
  kBoolean,
  kDate,      ///< "2026-11-25"
  kMeasured,  ///< What was measured, and how surely: an object with the keys of
              ///< `measured_table`.
  kNumbers,   ///< List of numbers.
  kStrings,   ///< List of strings.
  kTexts,     ///< List of texts.
  kObject,    ///< Object with the keys of `nested`.
  kObjects,   ///< List of such objects.
  kStages,    ///< List of stages; the table of each follows from its `kind`.
  kArms,      ///< Object: name of a `one_of` counterbalance to name of its arm.
  kLevels,    ///< Object: name of a factor to name of one of its levels.
  kWeights,   ///< Object: name of a factor to an object, names of levels to their weights.
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_is_open = false;  ///< x > low instead of x >= low.

  [[nodiscard]] bool contains(double value) const noexcept {
    return (low_is_open ? value > low : value >= low) && value <= high;
  }
};

/// Another key of the same object that has one of these values.
struct Condition {
  std::string key;
  std::vector<std::string> values;
};

struct ParameterTable;

/// One key of the study format. Everything that is true of it stands here and nowhere else:
/// reader, JSON Schema and reference documentation are made from these.
struct Parameter {
  std::string key{};
  ValueKind kind = ValueKind::kString;
  std::string meaning{};
  bool required = true;  ///< Where `only_where` holds.
  std::string
      default_json{};  ///< What an absent optional key stands for; "" is nothing at all.
  std::string unit{};  ///< In words: "Pa s"; "" for numbers that have none.
  Range range{};       ///< Of a number, measured or not, or of each number of a list.
  std::vector<std::string> allowed{};            ///< Words; of kStages their kinds, none: any.
  bool may_be_empty = false;                     ///< Of a kString: "" means not known.
  std::size_t min_items = 1, max_items = 10000;  ///< Of a list.
  const ParameterTable* nested = nullptr;
  std::vector<Condition> only_where{};  ///< The key belongs here only where all of these hold.
};

/// The keys of one kind of object. `comment` is allowed in every object besides.
struct ParameterTable {
  std::string name{};
  std::string meaning{};
  std::string example{};  ///< JSON; "" where an enclosing table's example shows it.
  std::vector<Parameter> parameters{};

  [[nodiscard]] const Parameter* find(std::string_view key) const noexcept;
};

/// The tables of a kind of file: that of the whole file, and each that is nested in it, once.
[[nodiscard]] std::vector<const ParameterTable*> tables_below(const ParameterTable& root);

/// The keys of a kMeasured: `value` in the parameter's range, and `ci95`, the lower and the
/// upper end of the interval that holds the true value with 95 %, in the same unit.
[[nodiscard]] ParameterTable measured_table(const Parameter& parameter);

/// A day of the calendar, written as 2026-11-25; such texts are in the order of time.
[[nodiscard]] bool is_date(std::string_view text) noexcept;

/// `comment`, the key that every object may have.
[[nodiscard]] const Parameter& comment_parameter();

/// "a number > 0 and <= 1000 (Pa s)", "a list of texts", "`yes_no` or `text`".
[[nodiscard]] std::string expectation(const Parameter& parameter);
/// How many a list has to hold: "2 ", "2 or more "; "" where one is enough.
[[nodiscard]] std::string item_count(const Parameter& parameter);
/// Expectation of one element of a list of numbers.
[[nodiscard]] std::string number_expectation(const Parameter& parameter);
/// A number as a person writes it: "0.5", "1000".
[[nodiscard]] std::string plain_number(double value);
/// "`a`, `b` or `c`".
[[nodiscard]] std::string one_of_words(const std::vector<std::string>& words);

}  // namespace jnd::experiments
