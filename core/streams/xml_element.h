#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jnd::core {

/// What streams say about themselves: elements that contain text and elements. Attributes,
/// comments and instructions are skipped.
struct XmlElement {
  std::string name, text;
  std::vector<XmlElement> children;

  /// Returns the first child with this name, or nullptr.
  [[nodiscard]] const XmlElement* child(std::string_view child_name) const noexcept;
  /// Returns the text of that child, or "" without one.
  [[nodiscard]] std::string child_text(std::string_view child_name) const;
  /// Adds a child and returns it.
  XmlElement& add(std::string child_name, std::string child_text = "");
};

/// Limits of foreign texts.
inline constexpr std::size_t kMostXmlBytes = std::size_t{1} << 20;
inline constexpr int kDeepestXml = 24;

/// Returns the root element. Throws `Error` naming `place` for a text that is not such XML,
/// that exceeds these limits, or that has a document type. Not real time.
[[nodiscard]] XmlElement parse_xml(std::string_view text, const std::string& place);

/// Returns the text with an XML declaration, one line for each element. Characters that XML
/// cannot hold are left out. Not real time.
[[nodiscard]] std::string xml_text(const XmlElement& root);

}  // namespace jnd::core
