// JSON as a plain value: what is printed reads back, and faults are told.
#include "framework/base/json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sluice::json_test {
namespace {

using testing::HasSubstr;

TEST(Json, lists_of_named_values_are_objects) {
  const Json j = {{"name", "gas"},
                  {"on", true},
                  {"n", 3},
                  {"x", 0.5},
                  {"none", nullptr},
                  {"list", {1, 2}},
                  {"inner", {{"a", std::vector<int>{7}}}}};
  EXPECT_EQ(j.dump(), R"({"name":"gas","on":true,"n":3,"x":0.5,"none":null,"list":[1,2],)"
                      R"("inner":{"a":[7]}})");
  EXPECT_EQ(Json::array().dump(), "[]");
  EXPECT_EQ(Json::object().dump(2), "{}");
  EXPECT_EQ(Json(std::array<double, 2>{1.0, 1e-5}).dump(), "[1.0,1e-05]");
}

TEST(Json, what_it_prints_reads_back) {
  const double numbers[] = {0.1, -0.0, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 123456789012.0};
  for (const double x : numbers) {
    const auto back = Json::parse(Json(x).dump()).get<double>();
    EXPECT_EQ(back, x);
    EXPECT_EQ(std::signbit(back), std::signbit(x));
  }
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(Json::parse(Json(most).dump()).get<std::int64_t>(), most);
  EXPECT_EQ(Json::parse(Json(-most).dump()).get<std::int64_t>(), -most);
  EXPECT_EQ(Json(std::nan("")).dump(), "null");
  EXPECT_EQ(Json("\xff\"").dump(), "\"\xef\xbf\xbd\\\"\"");
}

TEST(Json, values_are_read_as_what_they_are) {
  const Json j = Json::parse(R"({"t": [[1, 2.5], []], "s": ["a", "b"], "n": 4, "x": 4.0})");
  EXPECT_EQ(j.at("t").get<std::vector<std::vector<double>>>(),
            (std::vector<std::vector<double>>{{1, 2.5}, {}}));
  EXPECT_EQ(j.at("s").get<std::vector<std::string>>(), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(j.at("n").is_whole());
  EXPECT_FALSE(j.at("x").is_whole());
  EXPECT_EQ(j.at("n"), j.at("x"));
  EXPECT_EQ(j.value("n", 0), 4);
  EXPECT_EQ(j.value("m", 7), 7);
  EXPECT_EQ(j.at("s").at(1).get<std::string>(), "b");
  EXPECT_EQ((Json{{"a", 1}, {"b", 2}}), (Json{{"b", 2}, {"a", 1}}));
  EXPECT_FALSE((Json{{"a", 1}}) == (Json{{"a", 2}}));
}

TEST(Json, null_grows_into_lists_and_objects) {
  Json j;
  j["kinds"].push_back({{"made", 2}});
  j["time"] = 0.5;
  j["cell"] = {1, 2, 3};
  EXPECT_EQ(j.dump(), R"({"kinds":[{"made":2}],"time":0.5,"cell":[1,2,3]})");
}

std::string problem_of(const std::string& text) {
  try {
    const Json j = Json::parse(text);
    return j.at("a").get<std::vector<int>>().empty() ? "none" : "some";
  } catch (const JsonError& problem) {
    return problem.what();
  }
}

TEST(Json, faults_are_told) {
  EXPECT_EQ(problem_of("{\"a\": []}"), "none");
  EXPECT_THAT(problem_of("{\"a\": "), HasSubstr("line 1, column"));
  EXPECT_EQ(problem_of("{}"), "the entry \"a\" is missing");
  EXPECT_EQ(problem_of("[1]"), "found a list where an object is expected");
  EXPECT_EQ(problem_of("{\"a\": {}}"), "found an object where a list is expected");
  EXPECT_EQ(problem_of("{\"a\": [\"x\"]}"), "found a text where a number is expected");
  EXPECT_THROW(Json::parse("[1] // one"), JsonError);
  EXPECT_EQ(Json::parse("[1] // one", Json::Comments::skipped).size(), 1U);
  EXPECT_TRUE(Json::parse_or_null("[1").is_null());
  EXPECT_THROW(Json::parse("[1]").at(1), JsonError);
}

}  // namespace
}  // namespace sluice::json_test
