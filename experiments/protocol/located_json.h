#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// A place in a text.
struct TextPosition {
  int line = 1;          ///< Counted from 1.
  int column = 1;        ///< Counted from 1, in characters.
  std::size_t byte = 0;  ///< Counted from 0.
};

/// A JSON text in which every value and every key has a known place. nlohmann::json parses it.
/// A second pass of our own finds the places, because the library does not keep them.
///
/// Syntax errors, zero bytes, bytes that are not UTF-8, numbers too large for a double, keys
/// that occur twice in one object, and nesting deeper than `kMaxDepth` are problems. The memory
/// is in proportion to the text, whatever the text is. Not real time.
class LocatedJson {
 public:
  static constexpr int kMaxDepth = 32;

  /// Appends to `problems`. After any problem but a duplicate key, `usable` is false and `root`
  /// null.
  LocatedJson(std::string_view text, std::string file, std::vector<StudyProblem>& problems);

  [[nodiscard]] bool usable() const noexcept { return usable_; }
  [[nodiscard]] const nlohmann::json& root() const noexcept { return root_; }

  /// Returns where the value at this JSON pointer begins, or the nearest enclosing value if it
  /// is absent.
  [[nodiscard]] TextPosition value_position(const std::string& pointer) const;
  /// Returns where its key begins, or `value_position` if it has no key.
  [[nodiscard]] TextPosition key_position(const std::string& pointer) const;

  [[nodiscard]] const std::string& file() const noexcept { return file_; }

 private:
  friend class PositionPass;

  /// The place of a value, and of everything in it.
  struct Place {
    TextPosition value;
    TextPosition key;   ///< Equal to `value` if it has no key.
    std::string token;  ///< Its key as in a pointer; "" in a list.
    bool is_list = false;
    std::vector<Place> inner;
  };

  void parse(std::string_view text, std::vector<StudyProblem>& problems);
  /// Returns the place at this pointer, or, unless `exact`, the nearest one that encloses it.
  [[nodiscard]] const Place* find(std::string_view pointer, bool exact) const;

  std::string file_;
  nlohmann::json root_;
  bool usable_ = false;
  Place places_;
};

/// Returns a key as it stands in a JSON pointer (RFC 6901), with ~ and / escaped.
[[nodiscard]] std::string pointer_token(std::string_view key);

}  // namespace jnd::experiments
