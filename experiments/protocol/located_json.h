#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// A place in a text.
struct TextPosition {
  int line = 1;          ///< From 1.
  int column = 1;        ///< From 1, in characters.
  std::size_t byte = 0;  ///< From 0.
};

/// A JSON text in which every value and every key knows where it stands. Parsed by
/// nlohmann::json; the places come from a second pass of our own, for the library keeps none.
///
/// Syntax errors, zero bytes, bytes that are not UTF-8, numbers too large for a double, keys
/// that appear twice in one object and nesting deeper than `kMaxDepth` are problems. Takes
/// memory in proportion to the text, whatever is in it. Not real time.
class LocatedJson {
 public:
  static constexpr int kMaxDepth = 32;

  /// Appends to `problems`; after any but a duplicate key, `usable` is false and `root` null.
  LocatedJson(std::string_view text, std::string file, std::vector<StudyProblem>& problems);

  [[nodiscard]] bool usable() const noexcept { return usable_; }
  [[nodiscard]] const nlohmann::json& root() const noexcept { return root_; }

  /// Where the value at this JSON pointer begins; of the nearest enclosing value if absent.
  [[nodiscard]] TextPosition value_position(const std::string& pointer) const;
  /// Where its key begins; `value_position` for what has no key.
  [[nodiscard]] TextPosition key_position(const std::string& pointer) const;

  [[nodiscard]] const std::string& file() const noexcept { return file_; }

 private:
  friend class PositionPass;

  /// Where a value stands, and all in it.
  struct Place {
    TextPosition value;
    TextPosition key;   ///< `value` for what has no key.
    std::string token;  ///< Its key as in a pointer; "" in a list.
    bool is_list = false;
    std::vector<Place> inner;
  };

  void parse(std::string_view text, std::vector<StudyProblem>& problems);
  /// The place at this pointer or, `exact` being false, the nearest that encloses it.
  [[nodiscard]] const Place* find(std::string_view pointer, bool exact) const;

  std::string file_;
  nlohmann::json root_;
  bool usable_ = false;
  Place places_;
};

/// A key as it stands in a JSON pointer (RFC 6901): ~ and / are escaped.
[[nodiscard]] std::string pointer_token(std::string_view key);

}  // namespace jnd::experiments
