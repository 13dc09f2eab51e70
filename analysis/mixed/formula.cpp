#include "analysis/mixed/formula.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace jnd::analysis {
namespace {

/// A set of variables, with one bit for each index. 0 is the intercept.
using TermBits = std::uint64_t;
constexpr std::size_t kMostVariables = 60;
/// Each term becomes a column of the design. Without this limit a product of thirty columns
/// would give a thousand million terms.
constexpr std::size_t kMostTerms = 500;
/// The deepest nesting of parentheses and functions.
constexpr int kDeepest = 100;

/// A part of a formula: its terms, and whether it contains 0, which removes the intercept.
struct TermList {
  std::vector<TermBits> terms;
  bool says_zero = false;

  /// One term above the limit is enough to detect that there are too many.
  void add(TermBits term) {
    if (!is_too_long() && std::ranges::find(terms, term) == terms.end()) terms.push_back(term);
  }
  [[nodiscard]] bool is_too_long() const { return terms.size() > kMostTerms; }
};

TermList crossed(const TermList& left, const TermList& right) {
  TermList result;
  for (const TermBits one : left.terms) {
    for (const TermBits other : right.terms) result.add(one | other);
    if (result.is_too_long()) break;
  }
  return result;
}

bool begins_name(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
         letter == '.' || letter == '_' || static_cast<unsigned char>(letter) >= 0x80;
}
bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

/// Reads one text from beginning to end.
class FormulaReader {
 public:
  explicit FormulaReader(const std::string& text) : text_(text) {}

  Formula whole_formula() {
    Formula formula = effects();
    if (!is_over()) fail_at_sign("an operator such as + or *");
    return formula;
  }

  std::vector<RandomTerm> whole_random_terms() {
    std::vector<RandomTerm> terms;
    skip_spaces();
    if (!random_is_in_parentheses()) {
      random_term(terms);
      if (!is_over()) fail_at_sign("the end; terms with a bar stand in parentheses");
      return terms;
    }
    while (true) {
      expect('(', "( before a random term");
      random_term(terms);
      expect(')', ") behind the groups");
      if (is_over()) return terms;
      expect('+', "+ between random terms");
    }
  }

 private:
  // --- Signs

  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool is_over() {
    skip_spaces();
    return at_ >= text_.size();
  }
  char sign() {
    skip_spaces();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char wanted) {
    if (sign() != wanted) return false;
    ++at_;
    return true;
  }
  void expect(char wanted, const std::string& words) {
    if (!take(wanted)) fail_at_sign(words);
  }
  [[noreturn]] void fail_at_sign(const std::string& expected) {
    std::string found = "the end";
    if (!is_over()) {
      std::size_t end = at_ + 1;  // A character of several bytes is shown whole.
      while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) {
        ++end;
      }
      found = "`" + text_.substr(at_, end - at_) + "`";
    }
    throw FormulaError("expected " + expected + ", found " + found, text_, at_);
  }

  // --- Effects, from the loosest operator to the tightest

  Formula effects() {
    variables_.clear();
    TermList all;
    all.add(0);
    const bool begins_with_minus = take('-');
    join(all, begins_with_minus, star());
    while (sign() == '+' || sign() == '-') {
      const bool is_minus = text_[at_++] == '-';
      join(all, is_minus, star());
      require_few(all);
    }
    Formula formula{
        .text = text_, .has_intercept = false, .variables = variables_, .terms = {}};
    std::ranges::stable_sort(all.terms, {}, [](TermBits term) { return std::popcount(term); });
    for (const TermBits term : all.terms) {
      if (term == 0) {
        formula.has_intercept = true;
        continue;
      }
      formula.terms.emplace_back();
      for (std::size_t i = 0; i < variables_.size(); ++i) {
        if ((term >> i & 1U) != 0) formula.terms.back().push_back(i);
      }
    }
    return formula;
  }

  static void join(TermList& all, bool is_minus, const TermList& part) {
    if (is_minus) {
      for (const TermBits term : part.terms) std::erase(all.terms, term);
      if (part.says_zero) all.add(0);
      return;
    }
    if (part.says_zero) {
      std::erase(all.terms, TermBits{0});
      all.says_zero = true;
    }
    for (const TermBits term : part.terms) all.add(term);
  }

  TermList sum() {
    TermList all;
    const bool begins_with_minus = take('-');
    if (begins_with_minus) all.add(0);
    join(all, begins_with_minus, star());
    while (sign() == '+' || sign() == '-') {
      const bool is_minus = text_[at_++] == '-';
      join(all, is_minus, star());
      require_few(all);
    }
    return all;
  }

  TermList star() {
    TermList left = product();
    while (sign() == '*' || sign() == '/') {
      const bool is_nested = text_[at_++] == '/';
      const TermList right = product();
      TermList within = left;
      if (is_nested) {
        TermBits all = 0;
        for (const TermBits term : left.terms) all |= term;
        within.terms = {all};
      }
      TermList result = left;
      if (!is_nested) {
        for (const TermBits term : right.terms) result.add(term);
      }
      for (const TermBits term : crossed(within, right).terms) result.add(term);
      require_few(result);
      left = result;
    }
    return left;
  }

  TermList product() {
    TermList left = power();
    while (take(':')) {
      left = crossed(left, power());
      require_few(left);
    }
    return left;
  }

  TermList power() {
    TermList base = atom();
    if (!take('^')) return base;
    if (const char digit = sign(); digit < '1' || digit > '9') {
      fail_at_sign("a whole number from 1 to 9 behind ^");
    }
    TermList result = base;
    for (int left = text_[at_++] - '0'; left > 1; --left) {
      for (const TermBits term : crossed(result, base).terms) result.add(term);
      require_few(result);
    }
    return result;
  }

  /// Reads what is inside a parenthesis or a function.
  template <typename Read>
  auto deeper(const Read& read) {
    if (++depth_ > kDeepest) {
      throw FormulaError("expected at most 100 parentheses within one another, found more",
                         text_, at_);
    }
    auto result = read();
    --depth_;
    return result;
  }

  void require_few(const TermList& list) const {
    if (!list.is_too_long()) return;
    throw FormulaError(
        "expected at most 500 terms, found more: a product of columns stands for every "
        "product of some of them; (a + b + c)^2 has those of two",
        text_, at_);
  }

  TermList atom() {
    if (take('(')) {
      TermList inside = deeper([this] { return sum(); });
      if (sign() == '|') fail_at_sign("no bar here; random terms go to --random");
      expect(')', ") or an operator");
      return inside;
    }
    TermList one;
    if (is_digit(sign())) {
      const std::size_t from = at_;
      while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) ++at_;
      const std::string number = text_.substr(from, at_ - from);
      if (number == "0") {
        one.says_zero = true;
      } else if (number == "1") {
        one.add(0);
      } else {
        throw FormulaError("expected a column, or 0 or 1 for the intercept, found the number " +
                               number + "; a column whose name is one needs backquotes",
                           text_, from);
      }
      return one;
    }
    one.add(TermBits{1} << place_of(variable()));
    return one;
  }

  FormulaVariable variable() {
    skip_spaces();
    FormulaVariable result;
    result.at = at_;
    const bool is_quoted = sign() == '`';
    std::string word = name();
    if (is_quoted || sign() != '(') {
      result.name = word;
      result.column = std::move(word);
      return result;
    }
    const std::string known = ", " + std::string(kFormulaFunctions) + ",";
    if (known.find(", " + word + ",") == std::string::npos) {
      throw FormulaError(
          "expected one of the functions " + std::string(kFormulaFunctions) + ", found " + word,
          text_, result.at);
    }
    ++at_;  // Skips the parenthesis.
    FormulaVariable inside = deeper([this] { return variable(); });
    expect(')', ") behind what " + word + " is of, which is one column");
    inside.name = word + "(" + inside.name + ")";
    inside.functions.push_back(std::move(word));
    inside.at = result.at;
    return inside;
  }

  std::string name() {
    if (take('`')) {
      const std::size_t end = text_.find('`', at_);
      if (end == std::string::npos || end == at_) {
        throw FormulaError("expected a name and a closing backquote, found none", text_,
                           at_ - 1);
      }
      std::string word = text_.substr(at_, end - at_);
      at_ = end + 1;
      return word;
    }
    if (!begins_name(sign())) fail_at_sign("the name of a column");
    const std::size_t from = at_;
    while (at_ < text_.size() && (begins_name(text_[at_]) || is_digit(text_[at_]))) ++at_;
    return text_.substr(from, at_ - from);
  }

  std::size_t place_of(const FormulaVariable& variable) {
    const auto found = std::ranges::find(variables_, variable.name, &FormulaVariable::name);
    if (found != variables_.end()) return static_cast<std::size_t>(found - variables_.begin());
    if (variables_.size() == kMostVariables) {
      throw FormulaError("expected at most 60 variables, found more", text_, variable.at);
    }
    variables_.push_back(variable);
    return variables_.size() - 1;
  }

  // --- Random terms

  /// Whether the first parenthesis contains a bar, so that it holds a random term.
  [[nodiscard]] bool random_is_in_parentheses() const {
    if (at_ >= text_.size() || text_[at_] != '(') return false;
    int depth = 0;
    for (std::size_t i = at_; i < text_.size(); ++i) {
      if (text_[i] == '(') ++depth;
      if (text_[i] == ')' && --depth == 0) return false;
      if (text_[i] == '|' && depth == 1) return true;
    }
    return false;
  }

  void random_term(std::vector<RandomTerm>& terms) {
    RandomTerm term;
    term.effects = effects();
    if (!take('|')) fail_at_sign("| and the column of the groups");
    term.is_correlated = !take('|');
    skip_spaces();
    term.group_at = at_;
    std::vector<std::string> columns = {name()};
    const bool is_nested = sign() == '/';
    while (is_nested ? take('/') : take(':')) columns.push_back(name());
    if (sign() == '/' || sign() == ':') fail_at_sign("either : or / between groups");
    for (std::size_t num = is_nested ? 1 : columns.size(); num <= columns.size(); ++num) {
      term.group_columns.assign(columns.begin(), columns.begin() + static_cast<long>(num));
      std::vector<std::string> named = term.group_columns;
      if (is_nested) std::ranges::reverse(named);
      term.group.clear();
      for (const std::string& column : named)
        term.group += (term.group.empty() ? "" : ":") + column;
      terms.push_back(term);
    }
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<FormulaVariable> variables_;
};

/// Replaces characters that a terminal interprets: control characters, and those from U+0080 to
/// U+009F.
std::string without_controls(std::string text, char instead) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (byte < 0x20 || byte == 0x7F) text[i] = instead;
    if (byte == 0xC2 && next >= 0x80 && next < 0xA0) text.replace(i, 2, 1, instead);
  }
  return text;
}

/// The caret stands below the character, not the byte.
std::string caret_picture(const std::string& formula, std::size_t at) {
  const std::string line = without_controls(formula, ' ');
  const auto before = std::string_view(line).substr(0, std::min(at, line.size()));
  const auto letters = std::ranges::count_if(
      before, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; });
  return "  " + line + "\n  " + std::string(static_cast<std::size_t>(letters), ' ') + "^";
}

}  // namespace

FormulaError::FormulaError(const std::string& sentence, const std::string& formula,
                           std::size_t at)
    : core::Error(without_controls(sentence, '?')), picture(caret_picture(formula, at)) {}

Formula parse_formula(const std::string& text) { return FormulaReader(text).whole_formula(); }

std::vector<RandomTerm> parse_random_terms(const std::string& text) {
  return FormulaReader(text).whole_random_terms();
}

}  // namespace jnd::analysis
