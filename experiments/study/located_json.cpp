#include "experiments/study/located_json.h"

#include <algorithm>
#include <set>
#include <utility>

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Line and column of a byte of `text`; bytes that continue a UTF-8 character have no column.
TextPosition position_of(std::string_view text, std::size_t byte) {
  TextPosition position = {.byte = byte};
  for (std::size_t i = 0; i < byte && i < text.size(); ++i) {
    if (text[i] == '\n') {
      ++position.line;
      position.column = 1;
    } else if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) {
      ++position.column;
    }
  }
  return position;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// The run of characters around a byte that a person would call a word: `NaN`, `'none'`, `//`.
std::string_view word_at(std::string_view text, std::size_t& byte) {
  constexpr std::string_view kEnds = " \t\r\n,:[]{}\"";
  constexpr std::size_t kLongest = 30;
  byte = std::min(byte, text.size());
  while (byte > 0 && kEnds.find(text[byte - 1]) == kEnds.npos) --byte;
  const std::size_t end = std::min(text.find_first_of(kEnds, byte), text.size());
  return text.substr(byte, std::min(end - byte, kLongest));
}

/// One of the library's words for a token, in ours.
std::string token_words(const std::string& token) {
  static const std::map<std::string, std::string> kWords = {
      {"'[', '{', or a literal", "a value"},
      {"string literal", "a text in quotes"},
      {"number literal", "a number"},
      {"'}'", "`}`"},
      {"']'", "`]`"},
      {"'{'", "`{`"},
      {"'['", "`[`"},
      {"':'", "`:`"},
      {"','", "`,`"},
      {"end of input", "the end of the file"}};
  const auto found = kWords.find(token);
  return found == kWords.end() ? token : found->second;
}

/// What the library says went wrong, in the words of this program. `byte` is moved to where the
/// author has to look.
std::string worded(const std::string& what, std::string_view text, std::size_t& byte) {
  if (what.find("ill-formed UTF-8") != std::string::npos) {
    return "expected UTF-8, found a byte that is not; save the file as UTF-8";
  }
  const std::size_t unexpected = what.find("unexpected ");
  const std::size_t expected = what.find("; expected ");
  if (unexpected != std::string::npos && expected != std::string::npos) {
    const std::string found = what.substr(unexpected + 11, expected - unexpected - 11);
    std::string wanted = token_words(what.substr(expected + 11));
    if (wanted == "a text in quotes") wanted = "a key in quotes";  // It stands nowhere else.
    const bool is_close = found == "'}'" || found == "']'";
    std::string hint;
    if (is_close && (wanted == "a value" || wanted == "a key in quotes")) {
      hint = " (is there a comma too many?)";
    } else if (wanted == "`}`" || wanted == "`]`") {
      wanted = "`,` or " + wanted;
    }
    return "expected " + wanted + ", found " + token_words(found) + hint;
  }
  if (what.find("invalid string") != std::string::npos) {
    const std::size_t reason = what.find("invalid string: ") + 16;
    return "expected a text in quotes that is whole, found an error in it: " +
           what.substr(reason, what.find("; last read") - reason);
  }
  const std::string_view word = word_at(text, byte);
  if (what.find(".406]") != std::string::npos) {
    return "expected a number that fits a double, found " + std::string(word);
  }
  return "expected a value or a text in double quotes, found `" + std::string(word) + "`";
}

/// The byte of the first bracket or brace that opens one level too many; none: npos.
std::size_t too_deep_at(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      in_string = !in_string;
    } else if (!in_string && (text[i] == '[' || text[i] == '{')) {
      if (++depth > LocatedJson::kMaxDepth) return i;
    } else if (!in_string && (text[i] == ']' || text[i] == '}')) {
      --depth;
    }
  }
  return std::string_view::npos;
}

/// Listens to the parser only to know where in the document it stopped, and why.
class ErrorListener final : public nlohmann::json_sax<json> {
 public:
  explicit ErrorListener(std::string_view text) : text_(text) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(false); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_array() override { return close(); }
  bool key(string_t& key) override {
    levels_.back().token = pointer_token(key);
    return true;
  }
  bool parse_error(std::size_t num_read, const std::string&,
                   const nlohmann::detail::exception& error) override {
    error_byte = num_read == 0 ? 0 : num_read - 1;
    message = worded(error.what(), text_, error_byte);
    return false;
  }

  [[nodiscard]] std::string pointer() const {
    std::string pointer;
    for (const Level& level : levels_) {
      if (level.is_array) {
        pointer += '/' + std::to_string(level.index);
      } else if (!level.token.empty()) {
        pointer += '/' + level.token;
      }
    }
    return pointer;
  }

  std::size_t error_byte = 0;
  std::string message;

 private:
  struct Level {
    bool is_array = false;
    std::size_t index = 0;
    std::string token;
  };

  bool value() {
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().index;
    return true;
  }
  bool open(bool is_array) {
    levels_.push_back({is_array, 0, ""});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return value();
  }

  std::string_view text_;
  std::vector<Level> levels_;
};

/// Walks a text already known to be JSON of limited depth, noting where everything stands.
class PositionPass {
 public:
  PositionPass(std::string_view text, std::map<std::string, TextPosition>& values,
               std::map<std::string, TextPosition>& keys)
      : text_(text), values_(values), keys_(keys) {
    if (text_.starts_with("\xEF\xBB\xBF")) here_.byte = 3;
    value("");
  }

  std::vector<std::pair<std::string, TextPosition>> duplicates;

 private:
  void step() {
    if (text_[here_.byte] == '\n') {
      ++here_.line;
      here_.column = 1;
    } else if ((static_cast<unsigned char>(text_[here_.byte]) & 0xC0) != 0x80) {
      ++here_.column;
    }
    ++here_.byte;
  }
  void skip_space() {
    while (here_.byte < text_.size() &&
           std::string_view(" \t\r\n").find(text_[here_.byte]) != text_.npos) {
      step();
    }
  }
  std::string_view string_token() {
    const std::size_t begin = here_.byte;
    step();
    while (text_[here_.byte] != '"') {
      if (text_[here_.byte] == '\\') step();
      step();
    }
    step();
    return text_.substr(begin, here_.byte - begin);
  }

  void value(const std::string& pointer) {
    skip_space();
    values_[pointer] = here_;
    if (text_[here_.byte] == '{') {
      object(pointer);
    } else if (text_[here_.byte] == '[') {
      array(pointer);
    } else if (text_[here_.byte] == '"') {
      string_token();
    } else {
      while (here_.byte < text_.size() &&
             std::string_view(",]} \t\r\n").find(text_[here_.byte]) == text_.npos) {
        step();
      }
    }
    skip_space();
  }
  void object(const std::string& pointer) {
    std::set<std::string> seen;
    for (step(), skip_space(); text_[here_.byte] != '}'; skip_space()) {
      const TextPosition key_position = here_;
      const auto key = json::parse(string_token()).get<std::string>();
      const std::string child = pointer + '/' + pointer_token(key);
      if (!seen.insert(key).second) duplicates.emplace_back(child, key_position);
      keys_[child] = key_position;
      skip_space();
      step();  // The colon.
      value(child);
      if (text_[here_.byte] == ',') step();
    }
    step();
  }
  void array(const std::string& pointer) {
    std::size_t index = 0;
    for (step(), skip_space(); text_[here_.byte] != ']'; skip_space()) {
      value(pointer + '/' + std::to_string(index++));
      if (text_[here_.byte] == ',') step();
    }
    step();
  }

  std::string_view text_;
  std::map<std::string, TextPosition>& values_;
  std::map<std::string, TextPosition>& keys_;
  TextPosition here_;
};

TextPosition found_or_enclosing(const std::map<std::string, TextPosition>& positions,
                                std::string pointer) {
  while (true) {
    if (const auto found = positions.find(pointer); found != positions.end()) {
      return found->second;
    }
    if (pointer.empty()) return {};
    pointer.erase(pointer.rfind('/'));
  }
}

}  // namespace

LocatedJson::LocatedJson(std::string_view text, std::string file,
                         std::vector<StudyProblem>& problems)
    : file_(std::move(file)) {
  parse(text, problems);
}

void LocatedJson::parse(std::string_view text, std::vector<StudyProblem>& problems) {
  const auto refuse = [&](std::size_t byte, std::string pointer, std::string message) {
    const TextPosition position = position_of(text, byte);
    problems.push_back(
        {file_, position.line, position.column, std::move(pointer), std::move(message)});
  };
  // First of all: nothing below has to cope with more levels than this.
  if (const std::size_t byte = too_deep_at(text); byte != text.npos) {
    return refuse(byte, "",
                  "expected at most " + std::to_string(kMaxDepth) +
                      " levels of brackets and braces, found more");
  }
  ErrorListener listener(text);
  if (!json::sax_parse(text, &listener)) {
    return refuse(listener.error_byte, listener.pointer(), listener.message);
  }
  root_ = json::parse(text);
  const PositionPass pass(text, values_, keys_);
  for (const auto& [pointer, position] : pass.duplicates) {
    problems.push_back({file_, position.line, position.column, pointer,
                        "expected each key once, found this one a second time"});
  }
  usable_ = true;
}

TextPosition LocatedJson::value_position(const std::string& pointer) const {
  return found_or_enclosing(values_, pointer);
}

TextPosition LocatedJson::key_position(const std::string& pointer) const {
  const auto found = keys_.find(pointer);
  return found == keys_.end() ? value_position(pointer) : found->second;
}

std::string pointer_token(std::string_view key) {
  return replaced(replaced(std::string(key), "~", "~0"), "/", "~1");
}

}  // namespace jnd::experiments
