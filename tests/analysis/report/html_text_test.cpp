#include "analysis/report/html_text.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace html_text_test {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(HtmlText, WhatParticipantsWroteIsTextAndNeverMarkup) {
  HtmlText html;
  html.paragraph("<script>alert('x')</script> & \"so\"");
  EXPECT_EQ(html.text(),
            "<p>&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &amp; &quot;so&quot;</p>\n");
  HtmlText table;
  table.table({.caption = "<b>", .columns = {{"<i>"}}, .rows = {{"<u>"}}, .notes = {"<s>"}});
  for (const char* markup : {"<b></", "<i>", "<u>", "<s>"}) {
    EXPECT_FALSE(has(table.text(), markup)) << markup;
  }
}

TEST(HtmlText, SectionsTablesAndFiguresAreCounted) {
  HtmlText html;
  html.heading(2, "One");
  html.heading(3, "Part");
  html.heading(2, "Two");
  html.heading(3, "Part");
  html.table({.caption = "c", .columns = {{"a"}}, .rows = {{"1"}}});
  html.table({.caption = "none", .columns = {{"a"}}});
  html.table({.caption = "d", .columns = {{"a"}}, .rows = {{"1"}}});
  html.figure("f", "", "Title", "Caption.");
  EXPECT_TRUE(has(html.text(), "2.1 Part"));
  EXPECT_TRUE(has(html.text(), "Table 2.</b> d"));
  EXPECT_FALSE(has(html.text(), "none"));
  EXPECT_TRUE(has(html.text(), "Figure 1. Title.</b> Caption."));
  ASSERT_EQ(html.sections().size(), 2U);
  EXPECT_EQ(html.sections()[1].second, "2 Two");
}

TEST(HtmlText, ANameMayGoOnInTheNextLineAfterItsParts) {
  HtmlText html;
  html.table({.caption = "c", .columns = {{"n", false, true}}, .rows = {{"group_d.w"}}});
  EXPECT_TRUE(has(html.text(), "<code>group_<wbr>d.<wbr>w</code>"));
}

TEST(HtmlText, TwoFiguresOfOneDocumentShareNoIdentifier) {
  const std::string svg =
      "<?xml version=\"1.0\"?>\n<svg viewBox=\"0 0 1 1\"><title>Gnuplot</title>"
      "<desc>Produced by GNUPLOT 5.4 </desc><path id='gpPt0' stroke='#0072B2'/>"
      "<use xlink:href='#gpPt0'/><g id=\"gnuplot_plot_1\" filter=\"url(#textbox)\"/></svg>";
  HtmlText html;
  html.figure("a", svg, "First <one>", "");
  html.figure("b", svg, "Second", "");
  EXPECT_TRUE(has(html.text(), "id='a-gpPt0' stroke='#0072B2'"));
  EXPECT_TRUE(has(html.text(), "xlink:href='#b-gpPt0'"));
  EXPECT_TRUE(has(html.text(), "id=\"a-gnuplot_plot_1\" filter=\"url(#a-textbox)\""));
  EXPECT_TRUE(has(html.text(), "<title>First &lt;one&gt;</title>"));
  EXPECT_FALSE(has(html.text(), "<?xml"));
  EXPECT_FALSE(has(html.text(), "GNUPLOT"));
}

TEST(HtmlText, ADocumentNeedsNothingFromElsewhereAndMarksEveryPage) {
  const std::string document = html_document("A \"title\"", "SIMULATED data", "<p>x</p>\n");
  EXPECT_TRUE(has(document, "<title>A &quot;title&quot;</title>"));
  EXPECT_TRUE(has(document, "@top-right { content: \"SIMULATED data\""));
  EXPECT_TRUE(has(document, "content: \"A \\\"title\\\"\""));
  EXPECT_TRUE(has(document, "@page"));
  for (const char* outside : {"http:", "https:", "<script", "<link", "@import", "url("}) {
    EXPECT_FALSE(has(document, outside)) << outside;
  }
  EXPECT_FALSE(has(html_document("t", "", ""), "@top-right"));
}

}  // namespace html_text_test
}  // namespace jnd::analysis
