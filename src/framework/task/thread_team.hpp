// The threads that one rank works with: independent pieces of work, dealt out one by one.
//
// A team of one runs everything in order on the calling thread and costs nothing.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>

namespace sluice {

class ThreadTeam {
 public:
  explicit ThreadTeam(int threads = 1);
  ~ThreadTeam();

  int size() const { return size_; }
  // work(n, thread) for every n below `count`, each once, in any order; returns when all are done.
  // No two pieces at a time run with the same thread number, which is below size().
  void for_each(std::size_t count, const std::function<void(std::size_t, int)>& work) const;

 private:
  struct Arena;
  int size_;
  std::unique_ptr<Arena> arena_;  // none in a team of one
};

}  // namespace sluice
