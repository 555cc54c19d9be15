// Values as decks write them: what is read, what is refused.
#include "framework/deck/value_text.hpp"

#include <gtest/gtest.h>

namespace sluice::value_text_test {
namespace {

TEST(ValueText, ReadsRealNumbers) {
  EXPECT_EQ(parse_real(" 1.5 ").value, 1.5);
  EXPECT_EQ(parse_real("5").value, 5.0);
  EXPECT_EQ(parse_real(".5").value, 0.5);
  EXPECT_EQ(parse_real("-2.").value, -2.0);
  EXPECT_EQ(parse_real("+1e-3").value, 1e-3);
  EXPECT_EQ(parse_real("1.1792946927374306000e+00").value, 1.1792946927374306);
  EXPECT_EQ(parse_real("1.1768292682926831000").value, 1.1768292682926831);
}

TEST(ValueText, RefusesWhatIsNoRealNumber) {
  for (const char* text : {"", " ", "abc", "1.d0", "inf", "nan", "0x10", "1,5", "1.2.3", "1 2",
                           "e5", "+-1", "1e", "1e999", "--1", "1e+", "."}) {
    EXPECT_FALSE(parse_real(text)) << text;
    EXPECT_FALSE(parse_real(text).problem.empty()) << text;
  }
}

TEST(ValueText, ReadsIntegersStrictly) {
  EXPECT_EQ(parse_integer(" -12 ").value, -12);
  EXPECT_EQ(parse_integer("2147483647").value, 2147483647);
  for (const char* text : {"+1", "1.0", "1e3", "2147483648", "", "1 2", "0x1", "-"}) {
    EXPECT_FALSE(parse_integer(text)) << text;
  }
}

TEST(ValueText, ReadsBooleansStrictly) {
  EXPECT_EQ(parse_boolean("true").value, true);
  EXPECT_EQ(parse_boolean(" false ").value, false);
  for (const char* text : {"True", "1", "yes", "", "true false"}) {
    EXPECT_FALSE(parse_boolean(text)) << text;
  }
}

TEST(ValueText, ReadsVectors) {
  EXPECT_EQ(parse_vector(" [ 1.0 ,-2 , 3e0 ] ").value, (Vec3{1, -2, 3}));
  EXPECT_EQ(parse_int_vector("[1,-2,3]").value, (IntVec3{1, -2, 3}));
  for (const char* text : {"[1 2 3]", "1,2,3", "[1,2]", "[1,2,3,4]", "[1,2,x]", "[]", "[1,,3]", "[",
                           "]", "[1,2,3", "[1,2,3]x"}) {
    EXPECT_FALSE(parse_vector(text)) << text;
  }
  EXPECT_FALSE(parse_int_vector("[1,2.0,3]"));
}

TEST(ValueText, ReadsLists) {
  EXPECT_EQ(parse_reals("[1, 2.5 3]").value, (std::vector<double>{1, 2.5, 3}));
  EXPECT_EQ(parse_reals("0.0 0.1825 0.0").value, (std::vector<double>{0, 0.1825, 0}));
  EXPECT_EQ(parse_integers("[0,2]").value, (std::vector<int>{0, 2}));
  EXPECT_EQ(parse_words("[a, b c]").value, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(parse_reals("[]").value->empty());
  EXPECT_FALSE(parse_reals("[1, x]"));
  EXPECT_EQ(parse_int_vectors("[[2,2,1], [4,4,1]]").value,
            (std::vector<IntVec3>{{2, 2, 1}, {4, 4, 1}}));
  for (const char* text : {"[2,2,1]", "[[2,2,1]", "[[2,2]]", "2,2,1", "[[a,b,c]]", "[[1,2,3]x]"}) {
    EXPECT_FALSE(parse_int_vectors(text)) << text;
  }
}

TEST(ValueText, ReadsIndexSets) {
  const auto set = parse_index_set("0, 2-4, -1, -3--2");
  ASSERT_TRUE(set);
  ASSERT_EQ(set.value->size(), 4u);
  EXPECT_EQ((*set.value)[1].low, 2);
  EXPECT_EQ((*set.value)[1].high, 4);
  EXPECT_EQ((*set.value)[2].low, -1);
  EXPECT_EQ((*set.value)[3].low, -3);
  EXPECT_EQ((*set.value)[3].high, -2);
  EXPECT_TRUE(parse_index_set("").value->empty());
  for (const char* text : {"4-2", "a", "1-", "1--", "-"}) EXPECT_FALSE(parse_index_set(text));
}

TEST(ValueText, CollapsesBlanks) {
  EXPECT_EQ(collapse_blanks("  a \n\t b  "), "a b");
  EXPECT_EQ(collapse_blanks(" \n "), "");
}

TEST(ValueText, QuotesKeepMessagesShortAndPrintable) {
  EXPECT_EQ(in_quotes("a\x01z"), "'a z'");
  EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 70u);
  const std::string umlauts = in_quotes(std::string(59, 'x') + "\xc3\xbc\xc3\xbc");
  EXPECT_EQ(umlauts, "'" + std::string(59, 'x') + "...'");
}

}  // namespace
}  // namespace sluice::value_text_test
