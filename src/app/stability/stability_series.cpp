#include "app/stability/stability_series.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

namespace sluice {
namespace {

struct Job {
  std::size_t hard = 0, result = 0;
  StabilityPoint point;
};

// Hands jobs to threads, in order, until one of them fails.
class JobQueue {
 public:
  JobQueue(const std::vector<Job>& jobs, std::vector<CaseMap>& maps, const StabilityRunner& runner,
           RunJournal& journal, const TellRun& tell)
      : jobs_(jobs), maps_(maps), runner_(runner), journal_(journal), tell_(tell) {}

  void work() {
    while (const Job* job = next()) {
      try {
        StabilityResult result =
            runner_.run(maps_[job->hard].hard, job->point, static_cast<int>(job - jobs_.data()));
        const std::scoped_lock lock(mutex_);
        CaseMap& map = maps_[job->hard];
        map.results[job->result] = std::move(result);
        tell_(++done_, jobs_.size(), map, map.results[job->result]);
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (!fault_) fault_ = std::current_exception();
      }
    }
  }
  void rethrow() const {
    if (fault_) std::rethrow_exception(fault_);
  }

 private:
  StabilityResult result_of(const Job& job) {
    const StabilityCase& hard = maps_[job.hard].hard;
    const int number = static_cast<int>(&job - jobs_.data());
    const std::string key = runner_.key_of(hard, job.point);
    if (const auto found = journal_.find(key)) return result_from_json(*found, job.point);
    StabilityResult result = runner_.run(hard, job.point, number);
    journal_.add(key, to_json(result));
    return result;
  }
  const Job* next() {
    const std::scoped_lock lock(mutex_);
    return fault_ || next_ == jobs_.size() ? nullptr : &jobs_[next_++];
  }

  const std::vector<Job>& jobs_;
  std::vector<CaseMap>& maps_;
  const StabilityRunner& runner_;
  RunJournal& journal_;
  const TellRun& tell_;
  std::mutex mutex_;
  std::size_t next_ = 0, done_ = 0;
  std::exception_ptr fault_;
};

}  // namespace

std::vector<CaseMap> run_cases(const std::vector<StabilityCase>& cases,
                               const StabilityRunner& runner, int jobs, RunJournal& journal,
                               const TellRun& tell) {
  std::vector<CaseMap> maps;
  std::vector<Job> all;
  for (const StabilityCase& hard : cases) {
    const auto points = points_of(hard);
    for (std::size_t p = 0; p < points.size(); ++p) all.push_back({maps.size(), p, points[p]});
    maps.push_back({hard, std::vector<StabilityResult>(points.size())});
  }
  JobQueue queue(all, maps, runner, journal, tell);
  {
    std::vector<std::jthread> threads;
    for (int n = 1; n < jobs; ++n) threads.emplace_back([&queue] { queue.work(); });
    queue.work();
  }
  queue.rethrow();
  return maps;
}

}  // namespace sluice
