// The ranks, serially here and once more on three ranks by ctest (see CMakeLists.txt).
#include "framework/base/communicator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "framework/base/close_ranks_test_support.hpp"
#include "framework/base/memory.hpp"
#include "framework/base/message_counts.hpp"
#include "framework/base/reduction.hpp"

namespace sluice::communicator_test {
namespace {

TEST(Communicator, knows_its_ranks) {
  EXPECT_EQ(world().size(), launched_processes());
  EXPECT_GE(world().rank(), 0);
  EXPECT_LT(world().rank(), world().size());
  EXPECT_EQ(world().uses_mpi(), launched_processes() > 1) << "a serial run must not start MPI";
  EXPECT_EQ(world().is_root(), world().rank() == 0);
  world().barrier();
}

TEST(Communicator, reduces_all_kinds_in_one_call) {
  Communicator& ranks = world();
  const int rank = ranks.rank();
  const int size = ranks.size();
  // A sum that floating point gets wrong in every order: 1e100 + 1 - 1e100 (+ 1 a further rank).
  ExactSum local;
  local.add(rank == 0 ? 1e100 : 1.0);
  if (rank == size - 1) local.add(-1e100);
  Reduction step;
  const auto dt = step.add_minimum(10.0 - rank, 100 + rank);
  const auto speed = step.add_maximum(3.0 * rank, 200 + rank);
  const auto mass = step.add_sum(local);
  const auto cells = step.add_count(1000 + rank);
  const auto reject = step.add_any(rank == size - 1);
  const auto nothing = step.add_any(false);
  ranks.reduce(step);
  EXPECT_EQ(step.minimum(dt), 10.0 - (size - 1));
  EXPECT_EQ(step.tag(dt), 100 + size - 1);
  EXPECT_EQ(step.maximum(speed), 3.0 * (size - 1));
  EXPECT_EQ(step.tag(speed), 200 + size - 1);
  EXPECT_EQ(step.sum(mass).value(), size - 1.0);
  EXPECT_EQ(step.count(cells), 1000 * size + size * (size - 1) / 2);
  EXPECT_TRUE(step.any(reject));
  EXPECT_FALSE(step.any(nothing));
}

TEST(Communicator, adds_up_the_peak_memory_of_all_ranks) {
  const auto sum_of_peaks = [] {  // by another way than a reduction
    double sum = 0;
    for (const std::string& own : world().gather_to_all(std::to_string(peak_resident_bytes())))
      sum += std::stod(own);
    return sum;
  };
  // The kernel counts pages in batches a core: a few may be missing.
  const double uncertain = world().size() * 1024.0 * 1024.0;
  const double before = sum_of_peaks();
  const auto told = static_cast<double>(peak_resident_bytes_of_all(world()));
  EXPECT_GE(told, before - uncertain);
  EXPECT_LE(told, sum_of_peaks() + uncertain);
}

TEST(Communicator, sums_are_the_same_bits_on_any_number_of_ranks) {
  std::vector<double> values(1001);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::sin(1.0 + static_cast<double>(i)) * std::ldexp(1.0, static_cast<int>(i % 90));
  }
  ExactSum whole;
  whole.add(values.data(), values.size());
  ExactSum mine;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (static_cast<int>(i) % world().size() == world().rank()) mine.add(values[i]);
  }
  Reduction reduction;
  const auto sum = reduction.add_sum(mine);
  world().reduce(reduction);
  EXPECT_EQ(reduction.sum(sum), whole);
}

TEST(Communicator, sums_whole_numbers_modulo_two_to_the_64) {
  const std::size_t count = (std::size_t{1} << 24) + 7;  // more than one message holds
  const auto rank = static_cast<std::uint64_t>(world().rank());
  const auto size = static_cast<std::uint64_t>(world().size());
  std::vector<std::uint64_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = (std::uint64_t{1} << 63) + i * (rank + 1);
  world().sum(numbers.data(), count);
  for (std::size_t i = 0; i < count; i += i < 10 ? 1 : 1048573) {
    // The high bits meet and vanish in pairs.
    ASSERT_EQ(numbers[i], (size << 63) + i * (size * (size + 1) / 2));
  }
  ASSERT_EQ(numbers.back(), (size << 63) + (count - 1) * (size * (size + 1) / 2));
  world().sum(nullptr, 0);
}

TEST(Communicator, refuses_different_reductions) {
  if (world().size() == 1) {
    Reduction reduction;
    reduction.add_count(1);
    EXPECT_NO_THROW(world().reduce(reduction));
    return;
  }
  Reduction reduction;
  if (world().is_root()) {
    reduction.add_count(1);
  } else {
    reduction.add_any(true);
  }
  EXPECT_THROW(world().reduce(reduction), SystemError);
}

TEST(Communicator, gathers_texts_in_rank_order) {
  Communicator& ranks = world();
  std::vector<std::string> expected;
  for (int i = 0; i < ranks.size(); ++i) {
    expected.push_back(std::string(i, 'x') + std::to_string(i));
  }
  const std::string mine = expected[ranks.rank()];
  EXPECT_EQ(ranks.gather_to_all(mine), expected);
  const std::vector<std::string> gathered = ranks.gather(mine);
  if (ranks.is_root()) {
    EXPECT_EQ(gathered, expected);
  } else {
    EXPECT_TRUE(gathered.empty());
  }
}

TEST(Communicator, broadcasts) {
  Communicator& ranks = world();
  const int last = ranks.size() - 1;
  const std::string text = "from rank " + std::to_string(ranks.rank());
  EXPECT_EQ(ranks.broadcast(text, last), "from rank " + std::to_string(last));
  double number = ranks.rank() == 0 ? 2.5 : 0.0;
  ranks.broadcast(&number, sizeof number);
  EXPECT_EQ(number, 2.5);
}

TEST(Communicator, sends_around_the_ring) {
  Communicator& ranks = world();
  Messages messages;
  if (!ranks.uses_mpi()) {
    double unused = 0.0;
    EXPECT_THROW(messages.post_send(&unused, 1, 0, 1), SystemError);
    return;
  }
  const int next = (ranks.rank() + 1) % ranks.size();
  const int previous = (ranks.rank() + ranks.size() - 1) % ranks.size();
  for (const std::size_t count : {1UL, 100UL, 200000UL}) {
    std::vector<double> sent(count);
    std::vector<double> received(count, -1.0);
    std::iota(sent.begin(), sent.end(), 1e6 * ranks.rank());
    messages.post_receive(received.data(), count, previous, 7);
    messages.post_send(sent.data(), count, next, 7);
    messages.wait_all();
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(received[i], 1e6 * previous + static_cast<double>(i));
    }
  }
  double sent = ranks.rank();
  double received = -1.0;
  messages.post_receive(&received, 1, previous, 8);
  messages.post_send(&sent, 1, next, 8);
  messages.wait_all();
  EXPECT_EQ(received, previous);
}

// One exchange of every kind; a serial run sends nothing.
TEST(Communicator, counts_calls_and_bytes_of_every_kind) {
  Communicator& ranks = world();
  const auto size = static_cast<std::int64_t>(ranks.size());
  const int next = (ranks.rank() + 1) % ranks.size();
  const int previous = (ranks.rank() + ranks.size() - 1) % ranks.size();
  reset_message_counts();
  Reduction reduction;
  reduction.add_count(1);
  const auto record = static_cast<std::int64_t>(8 * reduction.words().size());
  ranks.reduce(reduction);
  std::vector<std::uint64_t> numbers(10);
  ranks.sum(numbers.data(), numbers.size());
  ranks.gather("1234567");
  ranks.gather_to_all("12345");
  ranks.broadcast(numbers.data(), 24);
  ranks.broadcast("123", 0);
  ranks.barrier();
  if (ranks.uses_mpi()) {
    Messages messages;
    std::vector<double> sent(4), received(4);
    messages.post_receive(received.data(), 3, previous, 9);
    messages.post_receive(received.data() + 3, 1, previous, 10);
    messages.post_send(sent.data(), 3, next, 9);
    messages.post_send(sent.data() + 3, 1, next, 10);
    messages.wait_all();
  }
  const MessageCounts first = message_counts();
  if (ranks.size() == 1) {
    EXPECT_EQ(first, MessageCounts{});
    return;
  }
  EXPECT_EQ(first.reductions, (MessageCount{1, record}));
  EXPECT_EQ(first.sums, (MessageCount{1, 80}));
  EXPECT_EQ(first.gathers, (MessageCount{2, 4 + 7}));
  EXPECT_EQ(first.gathers_to_all, (MessageCount{2, 13 * size}));
  EXPECT_EQ(first.broadcasts, (MessageCount{3, 24 + 8 + 3}));
  EXPECT_EQ(first.barriers, (MessageCount{1, 0}));
  EXPECT_EQ(first.sends, (MessageCount{2, 32}));
  EXPECT_EQ(first.collectives(), (MessageCount{10, record + 80 + 11 + 13 * size + 35}));
  ranks.barrier();
  MessageCounts expected;
  expected.barriers = {1, 0};
  EXPECT_EQ(message_counts() - first, expected);
  expected += first;
  EXPECT_EQ(message_counts(), expected);
  reset_message_counts();
  EXPECT_EQ(message_counts(), MessageCounts{});
}

// The next two end the process. Serially they are run in a child; under the launcher ctest runs
// them by name, each alone (see communicator_end_test.sh).
TEST(CommunicatorEnd, one_rank_aborts) {
  const auto fail = [] { world().abort(ExitStatus::system, "the disk of rank 1 is full"); };
  if (world().size() == 1) {
    EXPECT_EXIT(fail(), testing::ExitedWithCode(3), "the disk of rank 1 is full");
    return;
  }
  if (world().rank() == 1) fail();
  world().barrier();
  FAIL() << "the barrier was passed although rank 1 never came";
}

TEST(CommunicatorEnd, all_ranks_exit_together) {
  if (world().size() == 1) {
    EXPECT_EXIT(world().exit_together(ExitStatus::bad_input), testing::ExitedWithCode(2), "");
    EXPECT_EXIT(world().exit_together(ExitStatus::good), testing::ExitedWithCode(0), "");
    return;
  }
  world().exit_together(ExitStatus::failed);
}

}  // namespace
}  // namespace sluice::communicator_test
