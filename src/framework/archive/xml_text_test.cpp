// The archive's XML: numbers to the last bit, seals, and what is not ours refused.
#include "framework/archive/xml_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

#include "framework/archive/archive_test_support.hpp"

namespace sluice::xml_text_test {
namespace {

using ::testing::HasSubstr;

TEST(XmlText, RealsSurviveToTheLastBit) {
  std::mt19937_64 random(7);
  for (int n = 0; n < 10000; ++n) {
    const auto value = std::bit_cast<double>(random());
    if (std::isnan(value)) continue;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parse_real(real_text(value), "test")),
              std::bit_cast<std::uint64_t>(value));
  }
  EXPECT_EQ(parse_real(real_text(-std::numeric_limits<double>::infinity()), "test"),
            -std::numeric_limits<double>::infinity());
  const Vec3 v{0.1, -1e-300, 1.0 / 3};
  EXPECT_EQ(parse_real_triple(triple_text(v), "test"), v);
  EXPECT_EQ(parse_int_triple("[-1, 2,3]", "test"), (IntVec3{-1, 2, 3}));
}

TEST(XmlText, WhatIsNoNumberIsRefusedByName) {
  for (const char* bad : {"", "1.0x", "1,2", "--1", "0x10"})
    EXPECT_THROW(parse_real(bad, "test"), DamageError) << bad;
  for (const char* bad : {"", "1.5", "99999999999", "x"})
    EXPECT_THROW(parse_int(bad, "test"), DamageError) << bad;
  for (const char* bad : {"", "[]", "[1,2]", "1,2,3", "[1,2,3", "[1,2,3,4]", "[a,b,c]"})
    EXPECT_THROW(parse_int_triple(bad, "test"), DamageError) << bad;
  try {
    parse_real("abc", "index.xml");
  } catch (const DamageError& e) {
    EXPECT_STREQ(e.what(), "index.xml: 'abc' is not a number");
  }
}

TEST(XmlText, TreesRoundTripWithAnyCharacters) {
  XmlElement root("root");
  root.add("a", "x < y & \"z\" > 'w'").set("k", "line\nend\ttab <&>\"");
  root.add("b").add("c", "\xc3\xbc");
  const XmlElement back = parse_xml(to_text(root), "test");
  EXPECT_EQ(back.need("a", "").text, "x < y & \"z\" > 'w'");
  EXPECT_EQ(back.need("a", "").need_attribute("k", ""), "line\nend\ttab <&>\"");
  EXPECT_EQ(back.need("b", "").need("c", "").text, "\xc3\xbc");
  EXPECT_THROW(back.need("d", "test"), DamageError);
  EXPECT_THROW(back.need_attribute("k", "test"), DamageError);
}

TEST(XmlText, DocumentTypesAndDeepNestsAreRefused) {
  const char* bomb =
      "<!DOCTYPE r [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>"
      "<!ENTITY c '&b;&b;&b;&b;&b;&b;&b;&b;'>]><r k='&c;'>&c;</r>";
  EXPECT_THROW(parse_xml(bomb, "test"), DamageError);
  const char* outside = "<!DOCTYPE r SYSTEM 'file:///etc/passwd'><r/>";
  EXPECT_THROW(parse_xml(outside, "test"), DamageError);
  std::string deep, end;
  for (int n = 0; n < 100; ++n) {
    deep += "<a>";
    end += "</a>";
  }
  EXPECT_THROW(parse_xml(deep + end, "test"), DamageError);
  for (const char* bad : {"", "<a>", "text", "<a/><b/>", "\x01"})
    EXPECT_THROW(parse_xml(bad, "test"), DamageError) << bad;
}

TEST(XmlText, ASealIsNeededAndMustFit) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.xml";
  write_sealed(path, XmlElement("root", "text"));
  EXPECT_EQ(read_sealed(path).text, "text");
  std::string text = seal("<root/>\n");
  EXPECT_THAT(text, HasSubstr("<!-- crc32c "));
  for (const std::string& wrong :
       {std::string("<root/>\n"), std::string("<rood/>\n") + text.substr(8), text + " "}) {
    std::ofstream(path) << wrong;
    EXPECT_THROW(read_sealed(path), DamageError) << wrong;
  }
}

}  // namespace
}  // namespace sluice::xml_text_test
