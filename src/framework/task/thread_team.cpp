// Dealing out pieces of work by oneTBB.
#include "framework/task/thread_team.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace sluice {

struct ThreadTeam::Arena {
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

ThreadTeam::ThreadTeam(int threads) : size_(threads) {
  if (threads > 1) arena_ = std::make_unique<Arena>(threads);
}

ThreadTeam::~ThreadTeam() = default;

void ThreadTeam::for_each(std::size_t count,
                          const std::function<void(std::size_t, int)>& work) const {
  if (arena_ == nullptr || count < 2) {
    for (std::size_t n = 0; n < count; ++n) work(n, 0);
    return;
  }
  arena_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          const int thread = tbb::this_task_arena::current_thread_index();
          for (std::size_t n = range.begin(); n < range.end(); ++n) work(n, thread);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace sluice
