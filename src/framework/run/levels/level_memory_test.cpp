// Fields of materials that are nowhere take no memory: nothing writes their pages.
#include <gtest/gtest.h>

#ifndef __SANITIZE_ADDRESS__
#include <sys/mman.h>
#include <unistd.h>

#include <csignal>

#include "framework/run/test_support/kinds_run.hpp"

namespace sluice::level_memory_test {
namespace {

using namespace kinds_test;

// A page that nobody writes takes no memory; how a system counts those that were read is its own
// affair. So the pages are locked against writing, and opened one by one to who writes all the
// same.
class WrittenPages {
 public:
  WrittenPages() {
    struct sigaction action {};
    action.sa_sigaction = open_page;
    action.sa_flags = SA_SIGINFO;
    ::sigaction(SIGSEGV, &action, &former_);
    first_ = nullptr;
    end_ = nullptr;
    written_ = 0;
  }
  ~WrittenPages() {
    ::mprotect(first_, end_ - first_, PROT_READ | PROT_WRITE);
    ::sigaction(SIGSEGV, &former_, nullptr);
  }
  WrittenPages(const WrittenPages&) = delete;
  WrittenPages& operator=(const WrittenPages&) = delete;

  // Whole pages of a field with its ghosts.
  void watch(const RealView& field) {
    const auto begin = reinterpret_cast<std::uintptr_t>(field.data);
    const std::uintptr_t end = begin + sizeof(double) * field.box.volume();
    first_ = reinterpret_cast<char*>((begin + page - 1) / page * page);
    end_ = reinterpret_cast<char*>(end / page * page);
    ASSERT_LT(first_, end_);
    ASSERT_EQ(::mprotect(first_, end_ - first_, PROT_READ), 0);
  }
  int count() const { return written_; }

 private:
  static constexpr std::uintptr_t page = 65536;  // a multiple of any system's
  static void open_page(int, siginfo_t* fault, void*) {
    char* address = static_cast<char*>(fault->si_addr);
    if (address < first_ || address >= end_) ::_exit(139);  // a true fault
    written_ = written_ + 1;
    ::mprotect(first_ + (address - first_) / page * page, page, PROT_READ | PROT_WRITE);
  }
  static inline char *first_ = nullptr, *end_ = nullptr;
  static inline volatile int written_ = 0;
  struct sigaction former_ {};
};

TEST(Kinds, FieldsOfAbsentMaterialsAreNotWritten) {
  const IntVec3 cells{512, 528, 1};
  for (const int slot : {0, 2, 3})  // mass of the first; mass and share of the second
    for (const bool now : {true, false}) {
      SCOPED_TRACE(testing::Message() << "slot " << slot << (now ? ", new" : ", old"));
      KindsRun run(cells, {}, {1, 1, 1}, [](int m, IntVec3) { return m == 0 ? 1.0 : 0.0; });
      WrittenPages written;
      written.watch((now ? run.solver.state() : run.solver.states().previous()).view(slot, 0, 0));
      run.mock.state().initialise(run.solver.state());
      for (int n = 0; n < 3; ++n) run.step(0.5);
      EXPECT_EQ(written.count() > 0, slot == 0);
      EXPECT_GE(run.solver.memory_bytes(), 12u * 8u * 516u * 532u);  // six numbers, old and new
    }
}

}  // namespace
}  // namespace sluice::level_memory_test
#endif
