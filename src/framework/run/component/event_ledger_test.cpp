// The ledger counts what belongs to accepted steps, the same in any order of arrival.
#include "framework/run/component/event_ledger.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/base/json.hpp"

namespace sluice::event_ledger_test {
namespace {

using testing::HasSubstr;

EventPlace at(int step, IntVec3 cell, double value = 0) {
  EventPlace place;
  place.step = step;
  place.cell = cell;
  place.value = value;
  place.task = "advect";
  return place;
}

TEST(EventLedger, a_smooth_run_reads_zero) {
  EventLedger ledger;
  for (int step = 0; step < 3; ++step) ledger.accept_step();
  EXPECT_TRUE(ledger.empty());
  EXPECT_EQ(ledger.total(), 0);
  EXPECT_EQ(ledger.to_json(), Json::object());
  EXPECT_THAT(ledger.table(), HasSubstr("no events"));
}

TEST(EventLedger, counts_what_is_accepted_and_forgets_what_is_rejected) {
  EventLedger ledger;
  ledger.record("first-order face", at(1, {1, 2, 3}), 5);
  EXPECT_TRUE(ledger.empty()) << "nothing counts before the step is accepted";
  ledger.keep("step rejected", at(1, {1, 2, 3}, -0.5));
  ledger.reject_step();
  EXPECT_EQ(ledger.total(), 1);
  ledger.record("first-order face", at(1, {4, 5, 6}), 2);
  ledger.accept_step();
  EXPECT_EQ(ledger.records().at("first-order face").count, 2);
  EXPECT_EQ(ledger.records().at("first-order face").first.cell, (IntVec3{4, 5, 6}));
  EXPECT_EQ(ledger.records().at("step rejected").count, 1);
  EXPECT_EQ(ledger.total(), 3);
  ledger.accept_step();
  EXPECT_EQ(ledger.total(), 3) << "nothing is counted twice";
}

TEST(EventLedger, first_and_last_do_not_depend_on_arrival) {
  std::vector<EventPlace> places;
  for (int step = 1; step <= 3; ++step) {
    for (int cell = 0; cell < 20; ++cell) {
      places.push_back(at(step, {cell * 7 % 20, cell % 3, cell % 5}, 1.0 / cell));
    }
  }
  places.push_back(at(1, {0, 0, -9}, std::numeric_limits<double>::quiet_NaN()));
  std::mt19937 random(3);
  std::string expected;
  for (int trial = 0; trial < 10; ++trial) {
    std::shuffle(places.begin(), places.end(), random);
    EventLedger ledger;
    for (const EventPlace& place : places) ledger.record("x", place);
    ledger.accept_step();
    if (trial == 0) expected = ledger.to_json().dump();
    EXPECT_EQ(ledger.to_json().dump(), expected);
    EXPECT_EQ(ledger.records().at("x").first.cell, (IntVec3{0, 0, -9}));
    EXPECT_EQ(ledger.records().at("x").last.step, 3);
    EXPECT_EQ(ledger.records().at("x").count, 61);
  }
}

TEST(EventLedger, many_threads_may_record_at_once) {
  EventLedger ledger;
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&ledger, thread] {
      for (int i = 0; i < 500; ++i) ledger.record("x", at(1, {i, thread, 0}));
    });
  }
  for (std::thread& thread : threads) thread.join();
  ledger.accept_step();
  EXPECT_EQ(ledger.records().at("x").count, 2000);
  EXPECT_EQ(ledger.records().at("x").first.cell, (IntVec3{0, 0, 0}));
  EXPECT_EQ(ledger.records().at("x").last.cell, (IntVec3{499, 3, 0}));
}

TEST(EventLedger, json_reads_back) {
  EventLedger ledger;
  ledger.record("not finite", at(7, {1, -2, 3}, std::numeric_limits<double>::quiet_NaN()), 3);
  ledger.record("not finite", at(8, {1, -2, 3}, -std::numeric_limits<double>::infinity()));
  EventPlace whole;
  whole.step = 9;
  whole.material = 1;
  whole.value = 0.1;
  ledger.keep("solver fallback", whole);
  ledger.accept_step();
  const std::string text = ledger.to_json().dump();
  const EventLedger again = EventLedger::from_json(Json::parse(text));
  EXPECT_EQ(again.to_json().dump(), text);
  EXPECT_TRUE(std::isnan(again.records().at("not finite").first.value));
  EXPECT_FALSE(again.records().at("solver fallback").first.cell.has_value());
  EXPECT_THAT(text, HasSubstr("\"count\":4"));
}

TEST(EventLedger, table_names_cell_task_step_and_value) {
  EventLedger ledger;
  ledger.record("density not positive", at(12, {3, 4, 5}, -0.25));
  ledger.accept_step();
  const std::string table = ledger.table();
  EXPECT_THAT(table, HasSubstr("density not positive"));
  EXPECT_THAT(table, HasSubstr("step 12, advect, cell [3, 4, 5] of level 0, value -0.25"));
}

// Runs serially here and on three ranks by ctest.
TEST(EventLedger, ranks_are_merged) {
  Communicator& ranks = world();
  EventLedger ledger;
  ledger.record("local", at(1, {10 - ranks.rank(), 0, 0}), 2);
  ledger.keep("common", at(1, {0, 0, 0}));
  ledger.accept_step();
  const EventLedger merged = ledger.merge_ranks(ranks);
  if (ranks.is_root()) {
    EXPECT_EQ(merged.records().at("local").count, 2 * ranks.size());
    EXPECT_EQ(merged.records().at("local").first.cell, (IntVec3{11 - ranks.size(), 0, 0}));
    EXPECT_EQ(merged.records().at("common").count, 1);
  } else {
    EXPECT_TRUE(merged.empty());
  }
}

}  // namespace
}  // namespace sluice::event_ledger_test
