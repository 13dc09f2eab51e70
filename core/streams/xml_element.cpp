#include "core/streams/xml_element.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>

#include "core/error.h"

namespace jnd::core {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";

void append_utf8(std::string& text, std::uint32_t point) {
  const auto put = [&text](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (point < 0x80) {
    put(point);
  } else if (point < 0x800) {
    put(0xC0 | point >> 6);
    put(0x80 | (point & 0x3F));
  } else if (point < 0x10000) {
    put(0xE0 | point >> 12);
    put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
  } else {
    put(0xF0 | point >> 18);
    put(0x80 | (point >> 12 & 0x3F));
    put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
  }
}

class XmlReader {
 public:
  XmlReader(std::string_view text, const std::string& place) : text_(text), place_(place) {}

  XmlElement read() {
    skip_between();
    if (!starts("<")) refuse("an element");
    XmlElement root = element(0);
    skip_between();
    if (at_ != text_.size()) refuse("nothing behind the root element");
    return root;
  }

 private:
  [[noreturn]] void refuse(const std::string& expected) const {
    throw Error(place_ + ": expected XML with " + expected + " at byte " + std::to_string(at_) +
                ", found another text");
  }

  [[nodiscard]] bool starts(std::string_view with) const {
    return text_.substr(at_).starts_with(with);
  }

  /// Moves behind the next occurrence of the mark.
  std::string_view until(std::string_view mark) {
    const std::size_t end = text_.find(mark, at_);
    if (end == std::string_view::npos) refuse("`" + std::string(mark) + "`");
    const std::string_view passed = text_.substr(at_, end - at_);
    at_ = end + mark.size();
    return passed;
  }

  void skip_spaces() { at_ = std::min(text_.find_first_not_of(kSpaces, at_), text_.size()); }

  void skip_between() {
    while (true) {
      skip_spaces();
      if (starts("<!--")) {
        until("-->");
      } else if (starts("<?")) {
        until("?>");
      } else {
        return;
      }
    }
  }

  std::string word() {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n/><=&\"'", at_), text_.size());
    if (end == at_) refuse("a name");
    std::string name(text_.substr(at_, end - at_));
    at_ = end;
    return name;
  }

  void skip_attribute() {
    word();
    skip_spaces();
    if (!starts("=")) refuse("`=`");
    ++at_;
    skip_spaces();
    if (!starts("\"") && !starts("'")) refuse("a value in quotes");
    const std::string quote(1, text_[at_++]);
    until(quote);
  }

  XmlElement element(int depth) {
    if (depth > kDeepestXml) refuse("no more than " + std::to_string(kDeepestXml) + " levels");
    ++at_;  // Skips the <.
    XmlElement read{.name = word()};
    for (skip_spaces(); !starts(">") && !starts("/>"); skip_spaces()) skip_attribute();
    if (starts("/>")) {
      at_ += 2;
      return read;
    }
    ++at_;
    content(read, depth);
    if (word() != read.name) refuse("the end of the element that is open");
    skip_spaces();
    if (!starts(">")) refuse("`>`");
    ++at_;
    trim(read.text);
    return read;
  }

  /// Moves behind the end tag.
  void content(XmlElement& read, int depth) {
    while (true) {
      const std::size_t next = text_.find('<', at_);
      if (next == std::string_view::npos) refuse("an end of every element");
      append_text(read.text, text_.substr(at_, next - at_));
      at_ = next;
      if (starts("</")) {
        at_ += 2;
        return;
      }
      if (starts("<!--")) {
        until("-->");
      } else if (starts("<![CDATA[")) {
        at_ += 9;
        read.text += until("]]>");
      } else if (starts("<?")) {
        until("?>");
      } else if (starts("<!")) {
        refuse("no document type");
      } else {
        read.children.push_back(element(depth + 1));
      }
    }
  }

  void append_text(std::string& to, std::string_view raw) const {
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i] != '&') {
        to += raw[i];
        continue;
      }
      const std::size_t end = raw.find(';', i);
      if (end == std::string_view::npos || end - i > 10) refuse("an end of what `&` begins");
      append_entity(to, raw.substr(i + 1, end - i - 1));
      i = end;
    }
  }

  void append_entity(std::string& to, std::string_view entity) const {
    constexpr std::pair<std::string_view, char> kNamed[] = {
        {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
    for (const auto& [named, letter] : kNamed) {
      if (entity == named) {
        to += letter;
        return;
      }
    }
    if (!entity.starts_with('#')) refuse("one of the five named characters");
    entity.remove_prefix(1);
    const bool is_hex = entity.starts_with('x');
    if (is_hex) entity.remove_prefix(1);
    std::uint32_t point = 0;
    const auto [end, error] =
        std::from_chars(entity.data(), entity.data() + entity.size(), point, is_hex ? 16 : 10);
    const bool is_surrogate = point >= 0xD800 && point <= 0xDFFF;
    if (error != std::errc() || end != entity.data() + entity.size() || point == 0 ||
        point > 0x10FFFF || is_surrogate) {
      refuse("the number of a character");
    }
    append_utf8(to, point);
  }

  static void trim(std::string& text) {
    const std::size_t last = text.find_last_not_of(kSpaces);
    text.erase(last == std::string::npos ? 0 : last + 1);
    text.erase(0, std::min(text.find_first_not_of(kSpaces), text.size()));
  }

  std::string_view text_;
  const std::string& place_;
  std::size_t at_ = 0;
};

void append_escaped(std::string& to, std::string_view text) {
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    switch (letter) {
      case '&':
        to += "&amp;";
        break;
      case '<':
        to += "&lt;";
        break;
      case '>':
        to += "&gt;";
        break;
      default:
        if (byte >= 0x20 || letter == '\n' || letter == '\t') to += letter;
    }
  }
}

void append_element(std::string& to, const XmlElement& element, int depth) {
  to.append(static_cast<std::size_t>(depth), '\t');
  if (element.children.empty() && element.text.empty()) {
    to += "<" + element.name + " />\n";
    return;
  }
  to += "<" + element.name + ">";
  append_escaped(to, element.text);
  if (!element.children.empty()) {
    to += "\n";
    for (const XmlElement& child : element.children) append_element(to, child, depth + 1);
    to.append(static_cast<std::size_t>(depth), '\t');
  }
  to += "</" + element.name + ">\n";
}

}  // namespace

const XmlElement* XmlElement::child(std::string_view child_name) const noexcept {
  const auto found = std::ranges::find(children, child_name, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

std::string XmlElement::child_text(std::string_view child_name) const {
  const XmlElement* found = child(child_name);
  return found == nullptr ? "" : found->text;
}

XmlElement& XmlElement::add(std::string child_name, std::string child_text) {
  children.push_back(
      {.name = std::move(child_name), .text = std::move(child_text), .children = {}});
  return children.back();
}

XmlElement parse_xml(std::string_view text, const std::string& place) {
  if (text.size() > kMostXmlBytes) {
    throw Error(place + ": expected at most " + std::to_string(kMostXmlBytes) +
                " bytes of XML, found " + std::to_string(text.size()));
  }
  return XmlReader(text, place).read();
}

std::string xml_text(const XmlElement& root) {
  std::string text = "<?xml version=\"1.0\"?>\n";
  append_element(text, root, 0);
  return text;
}

}  // namespace jnd::core
