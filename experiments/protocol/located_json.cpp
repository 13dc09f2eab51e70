#include "experiments/protocol/located_json.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <utility>

#include "experiments/study/shown_text.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Returns line and column of a byte of `text`. Bytes that continue a UTF-8 character do not
/// count as columns.
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

/// Returns what a person would call the word around a byte: `NaN`, `'none'`, `//`.
std::string_view word_at(std::string_view text, std::size_t& byte) {
  constexpr std::string_view kEnds = " \t\r\n,:[]{}\"";
  byte = std::min(byte, text.size());
  while (byte > 0 && kEnds.find(text[byte - 1]) == std::string_view::npos) --byte;
  return text.substr(byte, std::min(text.find_first_of(kEnds, byte), text.size()) - byte);
}

/// Translates the library's name of a token into ours.
std::string token_words(const std::string& token) {
  static const std::map<std::string, std::string> kWords = {
      {"'[', '{', or a literal", "a value"},
      {"string literal", "a text in quotes"},
      {"number literal", "a number"},
      {"true literal", "`true`"},
      {"false literal", "`false`"},
      {"null literal", "`null`"},
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

/// Whether a message of the library is about a key. Its pointer is then that of the object.
bool wants_key(std::string_view what) { return what.ends_with("; expected string literal"); }

/// Returns a hint to an author who wrote this word, which is no JSON.
std::string hint_for(std::string_view word, char before) {
  for (const char* mark : {"//", "/*", "#"}) {
    if (word.starts_with(mark)) return " (notes go into a key `comment`)";
  }
  for (const char* quote : {"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E", "\xC2\xAB"}) {
    if (word.starts_with(quote)) return " (write the straight quotes of the keyboard)";
  }
  if (before == '"') return " (does the text before it lack a quote?)";
  return did_you_mean(word, {"true", "false", "null"});
}

/// Returns the message about a word that is no JSON, based on the library's name of what
/// belongs there.
std::string not_a_token(std::string_view what, const std::string& word, std::string hint) {
  const std::string found = ", found `" + word + '`' + std::move(hint);
  if (wants_key(what)) return "expected a key in double quotes" + found;
  if (what.ends_with("; expected ':'")) return "expected `:`" + found;
  if (what.ends_with("; expected '}'")) return "expected `,` or `}`" + found;
  if (what.ends_with("; expected ']'")) return "expected `,` or `]`" + found;
  if (what.ends_with("; expected end of input")) return "expected the end of the file" + found;
  return "expected a value or a text in double quotes" + found;
}

/// Whether it is like "060" or "-07", which is one number to an author and several to JSON.
bool has_leading_zero(std::string_view word) {
  if (word.starts_with('-')) word.remove_prefix(1);
  return word.size() > 1 && word[0] == '0' && word[1] >= '0' && word[1] <= '9';
}

/// Returns the message about a token of JSON in the place of another one. Both come in the
/// library's words.
std::string wrong_token(const std::string& found, const std::string& expected,
                        std::string_view word) {
  std::string wanted = token_words(expected);
  // A text is expected alone only where a key belongs.
  if (wanted == "a text in quotes") wanted = "a key in quotes";
  const bool is_close = found == "'}'" || found == "']'";
  const bool is_number = found == "number literal";
  std::string hint;
  if (is_close && (wanted == "a value" || wanted == "a key in quotes")) {
    hint = " (is there a comma too many?)";
  } else if (is_number && wanted == "a key in quotes") {
    hint = " (decimals have a point, not a comma)";
  } else if (is_number && has_leading_zero(word)) {
    hint = " (a number begins with 0 only before a point)";
  }
  if (wanted == "`}`" || wanted == "`]`") wanted = "`,` or " + wanted;
  return "expected " + wanted + ", found " + token_words(found) + hint;
}

/// Returns the place just after the value before the token that ends at `byte`, where a comma
/// is missing.
std::size_t behind_value_before(std::string_view text, std::size_t byte) {
  if (text[byte] == '"') {
    do {
      byte = text.rfind('"', byte - 1);
    } while (byte != std::string_view::npos && byte > 0 && text[byte - 1] == '\\');
  } else if (text[byte] != '{' && text[byte] != '[') {
    (void)word_at(text, byte);
  }
  const std::size_t last = byte == std::string_view::npos || byte == 0
                               ? std::string_view::npos
                               : text.find_last_not_of(" \t\r\n", byte - 1);
  return last == std::string_view::npos ? byte : last + 1;
}

/// Returns words for the key whose closing quote is at `byte`: "the key `languages` in line 4".
/// The line is left out if it is that of `from`. Returns "" if no colon follows, because then
/// it is no key.
std::string key_words(std::string_view text, std::size_t byte, std::size_t from) {
  const std::size_t next = text.find_first_not_of(" \t\r\n", byte + 1);
  std::size_t open = byte;
  do {
    open = open == 0 ? std::string_view::npos : text.rfind('"', open - 1);
  } while (open != std::string_view::npos && open > 0 && text[open - 1] == '\\');
  if (next == std::string_view::npos || text[next] != ':' || open == std::string_view::npos) {
    return "";
  }
  const json key = json::parse(text.substr(open, byte + 1 - open), nullptr, false);
  if (!key.is_string()) return "";
  const int line = position_of(text, open).line;
  return "the key `" + shown_text(key.get<std::string>(), 30) + '`' +
         (line == position_of(text, from).line ? "" : " in line " + std::to_string(line));
}

/// Returns where the innermost brace or bracket opens that nothing closes before this byte: ";
/// the `{` in line 3, column 5 is not closed". Returns "" if all are closed. It also returns ""
/// for the outermost one before the end of the text, because then something is closed too
/// often.
std::string open_words(std::string_view text, std::size_t byte, bool at_end) {
  std::vector<std::size_t> open;
  bool in_string = false;
  for (std::size_t i = 0; i < std::min(byte, text.size()); ++i) {
    if (in_string && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      in_string = !in_string;
    } else if (!in_string && (text[i] == '[' || text[i] == '{')) {
      open.push_back(i);
    } else if (!in_string && (text[i] == ']' || text[i] == '}') && !open.empty()) {
      open.pop_back();
    }
  }
  if (open.empty() || (open.size() == 1 && !at_end)) return "";
  const TextPosition at = position_of(text, open.back());
  return std::string("; the `") + text[open.back()] + "` in line " + std::to_string(at.line) +
         ", column " + std::to_string(at.column) + " is not closed";
}

/// Turns the library's message into one of this program. `byte` is moved to where the author
/// has to look.
std::string worded(const std::string& what, std::string_view text, std::size_t& byte) {
  std::string not_utf8 = "expected UTF-8, found a byte that is not; save the file as UTF-8";
  // The rest of the message quotes the author's own words.
  const std::string said = what.substr(0, what.find("; last read: '"));
  if (said.find("ill-formed UTF-8") != std::string::npos) return not_utf8;
  std::size_t word_begin = byte;
  const std::string_view word = word_at(text, word_begin);
  const std::size_t unexpected = said.find("unexpected ");
  const std::size_t expected = said.find("; expected ");
  if (unexpected != std::string::npos && expected != std::string::npos) {
    const std::string found = said.substr(unexpected + 11, expected - unexpected - 11);
    const std::string wanted = said.substr(expected + 11);
    // Texts and numbers have this ending, too.
    const bool is_literal = found.ends_with(" literal");
    const bool is_value = is_literal || found == "'{'" || found == "'['";
    // To their author, "060" and "1true" are one word and not two values without a comma.
    const bool is_one_word =
        found == "number literal"
            ? has_leading_zero(word)
            : is_literal && found != "string literal" && !found.starts_with(word);
    if (is_value && !is_one_word && (wanted == "'}'" || wanted == "']'")) {
      const std::size_t end_of_token = byte;
      byte = behind_value_before(text, byte);
      const std::string key = wanted == "'}'" && found == "string literal"
                                  ? key_words(text, end_of_token, byte)
                                  : "";
      if (!key.empty()) {
        return "expected `,` behind this value, before " + key + ", found none; write it here";
      }
      return "expected `,` or " + token_words(wanted) + " behind this value, found " +
             token_words(found);
    }
    const bool wants_end = wanted == "'}'" || wanted == "']'";
    const bool is_end = found == "'}'" || found == "']'" || found == "end of input";
    return wrong_token(found, wanted, word) +
           (wants_end && is_end ? open_words(text, byte, found == "end of input") : "");
  }
  if (const std::size_t at = said.find("invalid string: "); at != std::string::npos) {
    return "expected a text in quotes that is whole, found an error in it: " +
           said.substr(at + 16);
  }
  byte = word_begin;
  const std::string shown = shown_text(word, 30);
  if (said.find(".406]") != std::string::npos) {
    return "expected a number that fits a double, found " + shown;
  }
  if (shown.starts_with("\\x")) return not_utf8;
  return not_a_token(what, shown,
                     hint_for(word, word_begin == 0 ? '\0' : text[word_begin - 1]));
}

/// Returns the byte of the first bracket or brace that exceeds the depth limit, or npos.
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

/// Listens to the parser only to learn where in the document it stopped, and why.
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
    if (wants_key(error.what()) && !levels_.empty()) levels_.back().token.clear();
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

}  // namespace

/// Walks through a text that is known to be JSON of limited depth, and notes where everything
/// stands.
class PositionPass {
 public:
  PositionPass(std::string_view text, LocatedJson::Place& root) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) here_.byte = 3;
    skip_space();
    root.key = here_;
    value(root);
  }

  /// Pointers of keys that occur a second time, at most as many as are reported.
  std::vector<std::pair<std::string, TextPosition>> duplicates;

 private:
  using Place = LocatedJson::Place;

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
           std::string_view(" \t\r\n").find(text_[here_.byte]) != std::string_view::npos) {
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

  void value(Place& place) {
    place.value = here_;
    if (text_[here_.byte] == '{') {
      object(place);
    } else if (text_[here_.byte] == '[') {
      list(place);
    } else if (text_[here_.byte] == '"') {
      string_token();
    } else {
      while (here_.byte < text_.size() &&
             std::string_view(",]} \t\r\n").find(text_[here_.byte]) == std::string_view::npos) {
        step();
      }
    }
    skip_space();
  }
  void object(Place& place) {
    open_.push_back(&place);
    std::set<std::string> seen;
    for (step(), skip_space(); text_[here_.byte] != '}'; skip_space()) {
      Place& child = place.inner.emplace_back();
      child.key = here_;
      child.token = pointer_token(json::parse(string_token()).get<std::string>());
      if (!seen.insert(child.token).second && duplicates.size() <= kMostProblems) {
        duplicates.emplace_back(pointer(), child.key);
      }
      skip_space();
      step();  // Skips the colon.
      skip_space();
      value(child);
      if (text_[here_.byte] == ',') step();
    }
    step();
    open_.pop_back();
  }
  void list(Place& place) {
    open_.push_back(&place);
    place.is_list = true;
    for (step(), skip_space(); text_[here_.byte] != ']'; skip_space()) {
      Place& child = place.inner.emplace_back();
      child.key = here_;
      value(child);
      if (text_[here_.byte] == ',') step();
    }
    step();
    open_.pop_back();
  }
  /// Returns the pointer of the last value in the innermost object or list. It is made only if
  /// needed, because a pointer for every value would take memory in proportion to the square of
  /// the text.
  [[nodiscard]] std::string pointer() const {
    std::string pointer;
    for (const Place* place : open_) {
      pointer += '/' + (place->is_list ? std::to_string(place->inner.size() - 1)
                                       : place->inner.back().token);
    }
    return pointer;
  }

  std::string_view text_;
  TextPosition here_;
  std::vector<const Place*> open_;  ///< From the root to the innermost object or list.
};

LocatedJson::LocatedJson(std::string_view text, std::string file,
                         std::vector<StudyProblem>& problems)
    : file_(std::move(file)) {
  parse(text, problems);
}

void LocatedJson::parse(std::string_view text, std::vector<StudyProblem>& problems) {
  const auto refuse = [&](std::size_t byte, std::string pointer, std::string message) {
    const TextPosition position = position_of(text, byte);
    add_problem(problems, {file_, position.line, position.column, std::move(pointer),
                           std::move(message)});
  };
  // The parser takes a zero byte for the end of the text and ignores what follows.
  if (const std::size_t byte = text.find('\0'); byte != std::string_view::npos) {
    return refuse(byte, "", "expected text, found a zero byte; save the file as UTF-8");
  }
  // This check comes next, so that nothing below has to cope with more levels.
  if (const std::size_t byte = too_deep_at(text); byte != std::string_view::npos) {
    return refuse(byte, "",
                  "expected at most " + std::to_string(kMaxDepth) +
                      " levels of brackets and braces, found more");
  }
  ErrorListener listener(text);
  if (!json::sax_parse(text, &listener)) {
    return refuse(listener.error_byte, listener.pointer(), listener.message);
  }
  root_ = json::parse(text);
  const PositionPass pass(text, places_);
  for (const auto& [pointer, position] : pass.duplicates) {
    add_problem(problems, {file_, position.line, position.column, pointer,
                           "expected each key once, found this one a second time"});
  }
  usable_ = true;
}

const LocatedJson::Place* LocatedJson::find(std::string_view pointer, bool exact) const {
  const Place* place = &places_;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    const std::string_view token = pointer.substr(0, pointer.find('/'));
    pointer.remove_prefix(token.size());
    const Place* child = nullptr;
    if (place->is_list) {
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(token.begin(), token.end(), index);
      if (error == std::errc() && end == token.end() && index < place->inner.size()) {
        child = &place->inner[index];
      }
    } else {
      // If a key occurs twice, the last one counts.
      const auto found = std::find_if(place->inner.rbegin(), place->inner.rend(),
                                      [&](const Place& one) { return one.token == token; });
      if (found != place->inner.rend()) child = &*found;
    }
    if (child == nullptr) return exact ? nullptr : place;
    place = child;
  }
  return place;
}

TextPosition LocatedJson::value_position(const std::string& pointer) const {
  return find(pointer, false)->value;
}

TextPosition LocatedJson::key_position(const std::string& pointer) const {
  const Place* place = find(pointer, true);
  return place == nullptr ? value_position(pointer) : place->key;
}

std::string pointer_token(std::string_view key) {
  return replaced(replaced(std::string(key), "~", "~0"), "/", "~1");
}

}  // namespace jnd::experiments
