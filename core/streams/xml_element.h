#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jnd::core {

/// What streams say of themselves: elements with text in them. Attributes, comments and
/// instructions are skipped.
struct XmlElement {
  std::string name, text;
  std::vector<XmlElement> children;

  /// The first child of this name; nullptr without one.
  [[nodiscard]] const XmlElement* child(std::string_view child_name) const noexcept;
  /// Of that child; "" without one.
  [[nodiscard]] std::string child_text(std::string_view child_name) const;
  /// Adds one and returns it.
  XmlElement& add(std::string child_name, std::string child_text = "");
};

/// What came from elsewhere is no larger and no deeper.
inline constexpr std::size_t kMostXmlBytes = std::size_t{1} << 20;
inline constexpr int kDeepestXml = 24;

/// The root element. Throws `Error` naming `place` for what is no such text, for what is larger
/// or deeper than that, and for one with a document type, which nobody needs. Not real time.
[[nodiscard]] XmlElement parse_xml(std::string_view text, const std::string& place);

/// With the line that says what it is, and a line for each element. Characters that XML cannot
/// hold are left out. Not real time.
[[nodiscard]] std::string xml_text(const XmlElement& root);

}  // namespace jnd::core
