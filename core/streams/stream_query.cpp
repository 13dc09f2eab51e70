#include "core/streams/stream_query.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string>

namespace jnd::core {
namespace {

/// Thrown and caught in this file: this parser does not understand the query.
struct NotUnderstood {};

constexpr int kDeepestQuery = 16;

/// The value of a path or a text, or nothing if there is no such element.
struct Operand {
  std::optional<std::string> text;
  bool is_number = false;
};

class QueryReader {
 public:
  QueryReader(const XmlElement& info, std::string_view query) : info_(info), query_(query) {}

  bool read() {
    const bool holds = disjunction();
    skip_spaces();
    if (at_ != query_.size()) throw NotUnderstood{};
    return holds;
  }

 private:
  void skip_spaces() {
    while (at_ < query_.size() && std::isspace(static_cast<unsigned char>(query_[at_])) != 0) {
      ++at_;
    }
  }

  bool take(std::string_view mark) {
    skip_spaces();
    if (!query_.substr(at_).starts_with(mark)) return false;
    at_ += mark.size();
    return true;
  }

  /// Takes a whole word, not the beginning of a longer one.
  bool take_word(std::string_view word) {
    skip_spaces();
    const std::string_view rest = query_.substr(at_);
    if (!rest.starts_with(word)) return false;
    if (rest.size() > word.size() && is_of_name(rest[word.size()])) return false;
    at_ += word.size();
    return true;
  }

  static bool is_of_name(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' ||
           letter == '-' || letter == '.';
  }

  void expect(std::string_view mark) {
    if (!take(mark)) throw NotUnderstood{};
  }

  bool disjunction() {
    if (++depth_ > kDeepestQuery) throw NotUnderstood{};
    bool holds = conjunction();
    while (take_word("or")) {
      const bool other = conjunction();
      holds = holds || other;
    }
    --depth_;
    return holds;
  }

  bool conjunction() {
    bool holds = term();
    while (take_word("and")) {
      const bool other = term();
      holds = holds && other;
    }
    return holds;
  }

  bool term() {
    if (take("(")) {
      const bool holds = disjunction();
      expect(")");
      return holds;
    }
    if (take_word("not")) {
      expect("(");
      const bool holds = disjunction();
      expect(")");
      return !holds;
    }
    for (const bool is_start : {true, false}) {
      if (!take_word(is_start ? "starts-with" : "contains")) continue;
      expect("(");
      const std::string whole = operand().text.value_or("");
      expect(",");
      const std::string part = operand().text.value_or("");
      expect(")");
      return is_start ? whole.starts_with(part) : whole.find(part) != std::string::npos;
    }
    const Operand left = operand();
    if (take("!=")) return left.text && !is_same(left, operand());
    if (take("=")) return is_same(left, operand());
    // A path alone is true if there is such an element.
    return left.text.has_value() && !left.is_number;
  }

  static bool is_same(const Operand& left, const Operand& right) {
    if (!left.text || !right.text) return false;
    if (!left.is_number && !right.is_number) return *left.text == *right.text;
    const auto a = number_of(*left.text), b = number_of(*right.text);
    return a && b && *a == *b;
  }

  static std::optional<double> number_of(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
  }

  Operand operand() {
    skip_spaces();
    if (at_ == query_.size()) throw NotUnderstood{};
    const char first = query_[at_];
    if (first == '\'' || first == '"') {
      const std::size_t end = query_.find(first, at_ + 1);
      if (end == std::string_view::npos) throw NotUnderstood{};
      std::string text(query_.substr(at_ + 1, end - at_ - 1));
      at_ = end + 1;
      return {.text = std::move(text)};
    }
    if (std::isdigit(static_cast<unsigned char>(first)) != 0) {
      return {.text = name_here(), .is_number = true};
    }
    const XmlElement* found = &info_;
    do {
      const std::string name = name_here();
      if (found != nullptr) found = found->child(name);
    } while (take("/"));
    if (found == nullptr) return {};
    return {.text = found->text};
  }

  std::string name_here() {
    skip_spaces();
    std::size_t end = at_;
    while (end < query_.size() && is_of_name(query_[end])) ++end;
    if (end == at_) throw NotUnderstood{};
    std::string name(query_.substr(at_, end - at_));
    at_ = end;
    return name;
  }

  const XmlElement& info_;
  std::string_view query_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

bool matches_query(const XmlElement& info, std::string_view query) {
  if (query.find_first_not_of(" \t\r\n") == std::string_view::npos) return true;
  try {
    return QueryReader(info, query).read();
  } catch (const NotUnderstood&) {
    return false;
  }
}

std::string quoted_for_query(std::string_view text) {
  if (text.find('\'') == std::string_view::npos) return "'" + std::string(text) + "'";
  std::string kept(text);
  std::erase(kept, '"');
  return '"' + kept + '"';
}

}  // namespace jnd::core
