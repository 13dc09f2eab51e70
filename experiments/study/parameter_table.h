#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::experiments {

/// The kind of a value in a study file, or in another file with such tables.
enum class ValueKind {
  kString,  ///< Words for people or one of `allowed`; not empty unless `may_be_empty`.
  kName,    ///< [a-z0-9_], 1 to 64 of them.
  kText,    ///< Words in every language of the study: {"en": "...", "de": "..."}.
  kNumber,
  kInteger,
  kBoolean,
  kDate,  ///< "2026-11-25"
  /// A measured value with its uncertainty: an object with the keys of `measured_table`.
  kMeasured,
  kNumbers,  ///< A list of numbers.
  kStrings,  ///< A list of strings.
  kTexts,    ///< A list of texts.
  kObject,   ///< An object with the keys of `nested`.
  kObjects,  ///< A list of such objects.
  kStages,   ///< A list of stages; the table of each follows from its `kind`.
  kArms,     ///< An object: name of a `one_of` counterbalance to name of its arm.
  kLevels,   ///< An object: name of a factor to name of one of its levels.
  kWeights,  ///< An object: name of a factor to an object of level names with their weights.
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

/// One key of the study format, with everything that is known about it. Reader, JSON Schema and
/// reference documentation are all made from this.
struct Parameter {
  std::string key{};
  ValueKind kind = ValueKind::kString;
  std::string meaning{};
  bool required = true;        ///< Applies where `only_where` holds.
  std::string default_json{};  ///< The default of an absent optional key; "" for no value.
  std::string unit{};          ///< In words: "Pa s"; "" for a number without a unit.
  Range range{};               ///< Of a number, measured or not, or of each number of a list.
  /// Allowed words; for kStages the allowed kinds, where empty allows any.
  std::vector<std::string> allowed{};
  bool may_be_empty = false;                     ///< For kString: "" means not known.
  std::size_t min_items = 1, max_items = 10000;  ///< Of a list.
  const ParameterTable* nested = nullptr;
  std::vector<Condition> only_where{};  ///< The key belongs here only if all of these hold.
};

/// The keys of one kind of object. Every object may also have a `comment`.
struct ParameterTable {
  std::string name{};
  std::string meaning{};
  std::string example{};  ///< JSON; "" if the example of an enclosing table shows it.
  std::vector<Parameter> parameters{};

  [[nodiscard]] const Parameter* find(std::string_view key) const noexcept;
};

/// Returns the tables of a kind of file: that of the whole file, and each table nested in it,
/// once.
[[nodiscard]] std::vector<const ParameterTable*> tables_below(const ParameterTable& root);

/// Returns the keys of a kMeasured: `value`, in the parameter's range, and `ci95`, the lower
/// and the upper end of its 95 % confidence interval, in the same unit.
[[nodiscard]] ParameterTable measured_table(const Parameter& parameter);

/// Whether the text is a day of the calendar, written as 2026-11-25. Such texts sort in the
/// order of time.
[[nodiscard]] bool is_date(std::string_view text) noexcept;

/// Returns `comment`, the key that every object may have.
[[nodiscard]] const Parameter& comment_parameter();

/// Returns "a number > 0 and <= 1000 (Pa s)", "a list of texts", "`yes_no` or `text`".
[[nodiscard]] std::string expectation(const Parameter& parameter);
/// Returns how many items a list has to hold: "2 ", "2 or more ", or "" if one is enough.
[[nodiscard]] std::string item_count(const Parameter& parameter);
/// Returns the expectation of one element of a list of numbers.
[[nodiscard]] std::string number_expectation(const Parameter& parameter);
/// Returns a number as a person writes it: "0.5", "1000".
[[nodiscard]] std::string plain_number(double value);
/// Returns "`a`, `b` or `c`".
[[nodiscard]] std::string one_of_words(const std::vector<std::string>& words);

}  // namespace jnd::experiments
