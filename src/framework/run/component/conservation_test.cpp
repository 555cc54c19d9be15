// The books of conserved totals: exact sums, honest scales, restarts.
#include "framework/run/component/conservation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/json.hpp"

namespace sluice::conservation_test {
namespace {

ConservedTotal total_of(std::initializer_list<double> cells) {
  ConservedTotal total;
  for (const double q : cells) total.add(q);
  return total;
}

TEST(Conservation, nothing_gained_nothing_lost) {
  Conservation books({"mass of gas", "momentum x"});
  books.set_start(0, total_of({1.0, 2.0, 3.0}));
  books.set_start(1, total_of({-1.0, 1.0}));
  EXPECT_EQ(books.drift(0), 0.0);
  books.set_now(0, total_of({3.0, 2.0, 1.0}));
  books.set_now(1, total_of({-2.0, 2.0}));
  EXPECT_EQ(books.drift(0), 0.0);
  EXPECT_EQ(books.drift(1), 0.0);
  EXPECT_EQ(books.scale(1), 4.0) << "a vanishing momentum is measured by the sum of |q|";
  EXPECT_EQ(books.worst_drift(), 0.0);
}

TEST(Conservation, rows_and_single_cells_add_the_same) {
  std::vector<double> row(1000);
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = std::sin(static_cast<double>(i)) * 1e3;
  ConservedTotal at_once, one_by_one;
  at_once.add(row.data(), row.size());
  for (const double q : row) one_by_one.add(q);
  EXPECT_EQ(at_once.sum, one_by_one.sum);
  EXPECT_EQ(at_once.magnitude, one_by_one.magnitude);
}

TEST(Conservation, what_passes_the_boundary_and_sources_is_booked) {
  Conservation books({"total energy"});
  books.set_start(0, total_of({10.0}));
  for (int step = 0; step < 1000; ++step) {
    books.add_boundary(0, total_of({0.1, -0.3}));  // floating point would gather round-off
    books.add_sources(0, total_of({0.25}));
  }
  // Exactly: 10 + 1000 (0.1 - 0.3 + 0.25) with the doubles nearest to these.
  ExactSum expected;
  expected.add(10.0);
  for (int step = 0; step < 1000; ++step) {
    for (const double q : {0.1, -0.3, 0.25}) expected.add(q);
  }
  books.set_now(0, total_of({expected.value()}));
  EXPECT_LE(std::fabs(books.defect(0)), std::ldexp(1.0, -48)) << "half an ulp of 60 at most";
  EXPECT_EQ(books.start(0), 10.0);
  EXPECT_NEAR(books.boundary(0), -200.0, 1e-10);
  EXPECT_EQ(books.sources(0), 250.0);
  EXPECT_NEAR(books.scale(0), 650.0, 1e-9) << "0.1 + 0.3 + 0.25 a step passed";
}

TEST(Conservation, a_lost_unit_is_seen) {
  Conservation books({"mass of gas"});
  books.set_start(0, total_of({1e16, 1.0, -1e16}));
  books.set_now(0, total_of({1e16, -1e16}));
  EXPECT_EQ(books.defect(0), -1.0);
  EXPECT_EQ(books.drift(0), -1.0 / 2e16);
}

// What moves along x loses round-off of it along y.
TEST(Conservation, components_of_a_vector_have_one_scale) {
  Conservation books({"mass", "momentum x", "momentum y"});
  books.set_start(1, total_of({4.0}));
  books.set_now(1, total_of({4.0}));
  books.set_start(2, total_of({}));
  books.set_now(2, total_of({1e-16}));
  EXPECT_EQ(books.drift(2), 1.0) << "of its own";
  books.set_vector(1, 2, 100.0);
  EXPECT_EQ(books.scale(1), 4.0);
  EXPECT_EQ(books.scale(2), 4.0);
  EXPECT_EQ(books.drift(2), 1e-16 / 4.0);
  EXPECT_EQ(books.worst_drift(), 1e-16 / 4.0);
}

TEST(Conservation, a_vector_that_is_round_off_has_the_scale_of_all_energy) {
  Conservation books({"momentum x", "momentum y"});
  for (int d = 0; d < 2; ++d) {
    books.set_start(d, total_of({}));
    books.set_now(d, total_of({1e-14, -2e-14}));
  }
  books.set_vector(0, 2, 100.0);
  EXPECT_EQ(books.scale(0), 100.0);
  EXPECT_EQ(books.drift(1), -1e-14 / 100.0);
}

TEST(Conservation, empty_is_zero_and_nan_is_the_worst) {
  Conservation books({"a", "b"});
  EXPECT_EQ(books.drift(0), 0.0) << "nothing at all has no drift";
  books.set_start(0, total_of({1.0}));
  books.set_now(0, total_of({std::numeric_limits<double>::quiet_NaN()}));
  books.set_start(1, total_of({1.0}));
  books.set_now(1, total_of({2.0}));
  EXPECT_TRUE(std::isnan(books.worst_drift()));
  EXPECT_EQ(books.to_json().at("a").at("now"), "nan");
  EXPECT_EQ(Conservation().worst_drift(), 0.0);
}

TEST(Conservation, json_and_table_tell_all) {
  Conservation books({"mass of gas"});
  books.set_start(0, total_of({2.0}));
  books.add_boundary(0, total_of({0.5}));
  books.set_now(0, total_of({2.5}));
  const Json entry = books.to_json().at("mass of gas");
  EXPECT_EQ(entry.at("start"), 2.0);
  EXPECT_EQ(entry.at("now"), 2.5);
  EXPECT_EQ(entry.at("boundary"), 0.5);
  EXPECT_EQ(entry.at("sources"), 0.0);
  EXPECT_EQ(entry.at("defect"), 0.0);
  EXPECT_EQ(entry.at("scale"), 2.5);
  EXPECT_EQ(entry.at("drift"), 0.0);
  EXPECT_THAT(books.table(), testing::HasSubstr("mass of gas"));
}

TEST(Conservation, a_restart_keeps_the_books) {
  Conservation books({"mass of gas", "momentum x"});
  books.set_start(0, total_of({0.1, 0.2, -1e-30}));
  books.set_start(1, total_of({-3.0}));
  books.add_boundary(0, total_of({1e-20, 1.0 / 3.0}));
  books.add_sources(1, total_of({0.7}));
  books.set_now(0, total_of({0.9}));
  books.set_now(1, total_of({-2.0}));
  const std::string text = books.checkpoint().dump();
  Conservation again({"mass of gas", "momentum x"});
  again.restore(Json::parse(text));
  again.set_now(0, total_of({0.9}));
  again.set_now(1, total_of({-2.0}));
  EXPECT_EQ(again.to_json(), books.to_json());
  EXPECT_EQ(again.checkpoint().dump(), text);
  Conservation other({"mass of gas", "momentum y"});
  EXPECT_THROW(other.restore(Json::parse(text)), InputError);
  EXPECT_THROW(Conservation({"mass of gas"}).restore(Json::parse(text)), InputError);
  EXPECT_THROW(again.restore(Json::parse("[{\"name\": 3}, 4]")), InputError);
  EXPECT_EQ(again.checkpoint().dump(), text) << "a refused restart changes nothing";
}

}  // namespace
}  // namespace sluice::conservation_test
