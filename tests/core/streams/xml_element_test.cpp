#include "core/streams/xml_element.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace jnd::core {
namespace xml_element_test {

TEST(XmlElement, IsReadBackAsItWasWritten) {
  XmlElement root{.name = "info"};
  root.add("name", "a < b & \"c\" > d");
  root.add("empty");
  root.add("desc").add("channels").add("channel").add("label", "µ");
  const XmlElement read = parse_xml(xml_text(root), "test");
  EXPECT_EQ(read.child_text("name"), "a < b & \"c\" > d");
  EXPECT_EQ(read.child_text("empty"), "");
  ASSERT_NE(read.child("desc"), nullptr);
  EXPECT_EQ(read.child("desc")->child("channels")->child("channel")->child_text("label"), "µ");
  EXPECT_EQ(read.child("nothing"), nullptr);
}

TEST(XmlElement, UnderstandsWhatOthersWrite) {
  const XmlElement read = parse_xml(
      "<?xml version=\"1.0\" encoding='UTF-8'?>\r\n<!-- of an amplifier -->"
      "<info kind=\"a>b\"><name>E&#69;&#x47;</name><empty/><raw><![CDATA[<&>]]></raw>"
      "<!-- no more --></info>\n",
      "test");
  EXPECT_EQ(read.name, "info");
  EXPECT_EQ(read.child_text("name"), "EEG");
  EXPECT_EQ(read.child_text("raw"), "<&>");
  ASSERT_EQ(read.children.size(), 3U);
}

TEST(XmlElement, WhatIsNoneIsRefusedWithASentence) {
  const std::string deep = [] {
    std::string text;
    for (int i = 0; i < 100; ++i) text += "<a>";
    return text;
  }();
  for (const std::string& text :
       {std::string(""), std::string("text"), std::string("<a>"), std::string("<a></b>"),
        std::string("<a b></a>"), std::string("<a>&nothing;</a>"),
        std::string("<a>&#xD800;</a>"),
        std::string("<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>"), std::string("<a/><b/>"),
        std::string("<a><!DOCTYPE b></a>"), deep, std::string(kMostXmlBytes + 1, ' ')}) {
    EXPECT_THROW((void)parse_xml(text, "test"), Error) << text.substr(0, 60);
  }
}

}  // namespace xml_element_test
}  // namespace jnd::core
