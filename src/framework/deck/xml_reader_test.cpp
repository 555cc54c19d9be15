// The XML reader: places of tags, text rules, and what it refuses.
#include "framework/deck/xml_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sluice::xml_reader_test {
namespace {

using ::testing::HasSubstr;

XmlTree read(std::string_view xml) {
  ReadBudget budget;
  return read_xml_text(xml, "deck.ups", budget);
}

TEST(XmlReader, KnowsLineAndColumnOfEveryTag) {
  const XmlTree tree = read(
      "<?xml version='1.0'?>\n"
      "<root>\n"
      "  <first a='1'\n"
      "         b='2'>text</first> <second/>\n"
      "\n"
      "</root>\n");
  ASSERT_NE(tree.root, nullptr);
  EXPECT_EQ(to_string(tree.root->where), "deck.ups:2:1");
  EXPECT_EQ(to_string(tree.root->child("first")->where), "deck.ups:3:3");
  EXPECT_EQ(to_string(tree.root->child("second")->where), "deck.ups:4:29");
}

TEST(XmlReader, KnowsPlacesFarIntoALongFile) {
  std::string xml = "<root>\n";
  for (int i = 0; i < 20000; ++i) xml += "    <!-- filler --> <cell> 1 </cell>\n";
  xml += "\t<last\n attribute='" + std::string(3000, 'x') + "'\n/></root>";
  const XmlTree tree = read(xml);
  ASSERT_NE(tree.root, nullptr);
  EXPECT_EQ(to_string(tree.root->child("last")->where), "deck.ups:20002:2");
  int line = 1;
  for (const auto& child : tree.root->children) {
    if (child->name != "cell") continue;
    ASSERT_EQ(child->where.line, ++line);
    ASSERT_EQ(child->where.column, 21);
  }
}

TEST(XmlReader, LinesEndInAnyWay) {
  for (const std::string end : {"\n", "\r\n", "\r"})
    for (const std::string mark : {"", "\xef\xbb\xbf"}) {
      const XmlTree tree = read(mark + "<?xml version='1.0'?>" + end + "<root>" + end +
                                "  <next>1" + end + "</next> <last/></root>" + end);
      ASSERT_NE(tree.root, nullptr);
      EXPECT_EQ(to_string(tree.root->child("next")->where), "deck.ups:3:3");
      EXPECT_EQ(to_string(tree.root->child("last")->where), "deck.ups:4:9");
    }
}

TEST(XmlReader, CountsCharactersNotBytesInLatin1Decks) {
  const XmlTree tree = read(
      "<?xml version='1.0' encoding='iso-8859-1'?>\n"
      "<root><title>\xfc\xfc</title><next/></root>");
  ASSERT_NE(tree.root, nullptr);
  EXPECT_EQ(tree.root->child("title")->text, "\xc3\xbc\xc3\xbc");
  EXPECT_EQ(to_string(tree.root->child("next")->where), "deck.ups:2:24");
}

TEST(XmlReader, CollapsesBlanksAndKeepsPredefinedEntities) {
  const XmlTree tree = read("<root a='&lt;&amp;'>\n  one \t two\n &lt;&#65;&amp; </root>");
  ASSERT_NE(tree.root, nullptr);
  EXPECT_EQ(tree.root->text, "one two <A&");
  EXPECT_EQ(tree.root->attribute("a"), "<&");
}

TEST(XmlReader, AcceptsAForeignDoctypeWithoutReadingIt) {
  const XmlTree tree = read("<!DOCTYPE root SYSTEM \"http://nowhere.invalid/input.dtd\">\n<root/>");
  EXPECT_NE(tree.root, nullptr);
  EXPECT_TRUE(tree.faults.empty());
}

TEST(XmlReader, GivesThePlaceOfBrokenXml) {
  const XmlTree tree = read("<root>\n  <open>\n  </close>\n</root>");
  EXPECT_EQ(tree.root, nullptr);
  ASSERT_EQ(tree.faults.size(), 1u);
  EXPECT_EQ(tree.faults[0].where.line, 3);
  EXPECT_THAT(tree.faults[0].message, HasSubstr("tag mismatch"));
}

TEST(XmlReader, RefusesSplitText) {
  const XmlTree tree = read("<root><a>1 <!-- why --> 2</a></root>");
  ASSERT_EQ(tree.faults.size(), 1u);
  EXPECT_THAT(tree.faults[0].message, HasSubstr("2 pieces"));
}

TEST(XmlReader, RefusesEntities) {
  const std::string bomb =
      "<!DOCTYPE r [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">\n"
      "<!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;\">]>\n<r>&c;</r>";
  for (const std::string& xml :
       {bomb, std::string("<!DOCTYPE r [<!ENTITY x SYSTEM \"file:///etc/passwd\">]><r>&x;</r>"),
        std::string("<!DOCTYPE r [<!ENTITY % p SYSTEM \"file:///etc/passwd\">%p;]><r/>")}) {
    const XmlTree tree = read(xml);
    EXPECT_EQ(tree.root, nullptr);
    ASSERT_EQ(tree.faults.size(), 1u);
    EXPECT_THAT(tree.faults[0].message, HasSubstr("may not declare entities"));
  }
}

TEST(XmlReader, RefusesUnknownEntities) {
  for (const char* xml : {"<r>&nope;</r>", "<!DOCTYPE r SYSTEM \"x.dtd\"><r>&nope;</r>"}) {
    const XmlTree tree = read(xml);
    EXPECT_EQ(tree.root, nullptr);
    ASSERT_EQ(tree.faults.size(), 1u);
    EXPECT_THAT(tree.faults[0].message, HasSubstr("nope"));
  }
}

TEST(XmlReader, RefusesDeepAndHugeTrees) {
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<d>";
  EXPECT_THAT(read(deep).faults.at(0).message, HasSubstr("nested deeper"));
  std::string wide = "<r>";
  for (int i = 0; i < 600000; ++i) wide += "<d/>";
  EXPECT_THAT(read(wide + "</r>").faults.at(0).message, HasSubstr("too many elements"));
  EXPECT_THAT(read(std::string(largest_deck_file + 1, ' ')).faults.at(0).message,
              HasSubstr("more than the limit of"));
}

}  // namespace
}  // namespace sluice::xml_reader_test
