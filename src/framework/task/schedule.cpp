// Checking, running and describing schedules.
#include "framework/task/schedule.hpp"

#include <stdexcept>

#include "framework/base/reduction.hpp"

namespace sluice {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

[[noreturn]] void refuse(const std::string& kind, const std::string& name, const std::string& why) {
  throw std::logic_error(kind + " '" + name + "' " + why);
}

void require_level(const std::string& kind, const std::string& name, int level, int here) {
  if (level != here)
    refuse(kind, name,
           "of level " + std::to_string(level) + " is used in a step of level " +
               std::to_string(here));
}

void check(const Schedule& schedule, int level, bool outermost) {
  for (const Node& node : schedule)
    std::visit(Overloaded{[&](const Sweep& s) {
                            require_level("sweep", s.name, s.level, level);
                            if (!s.run) refuse("sweep", s.name, "has no action");
                          },
                          [&](const GhostExchange& h) {
                            require_level("ghost exchange", h.name, h.level, level);
                            if (!h.exchange) refuse("ghost exchange", h.name, "has no action");
                            if (h.width < 1) refuse("ghost exchange", h.name, "has no width");
                          },
                          [&](const Stage& s) {
                            if (!s.run) refuse("stage", s.name, "has no action");
                          },
                          [&](const Loop& l) {
                            if (!l.converged || l.most < 1)
                              refuse("loop", l.name, "would never end");
                            check(l.body, level, false);
                          },
                          [&](const LevelCycle& c) {
                            if (c.level != level + 1)
                              refuse("level cycle", c.name,
                                     "must go from level " + std::to_string(level) + " to " +
                                         std::to_string(level + 1));
                            if (c.substeps < 1) refuse("level cycle", c.name, "has no substeps");
                            check(c.body, c.level, false);
                          },
                          [&](const Retry& r) {
                            if (!outermost)
                              refuse("retry", r.name,
                                     "is not outermost: the unit of acceptance is the coarse step");
                            if (!(r.factor > 0 && r.factor < 1))
                              refuse("retry", r.name, "must make steps smaller");
                            check(r.body, level, false);
                          }},
               node.what);
}

Verdict run_loop(const Loop& loop, const StepScope& scope, StepJournal& journal) {
  for (int pass = 1; pass <= loop.most; ++pass) {
    if (run(loop.body, scope, journal) == Verdict::reject) return Verdict::reject;
    if (loop.converged(scope, pass)) return Verdict::good;
  }
  return Verdict::reject;
}

Verdict run_cycle(const LevelCycle& cycle, const StepScope& scope, StepJournal& journal) {
  for (int n = 0; n < cycle.substeps; ++n) {
    StepScope fine{cycle.level, scope.time, scope.dt / cycle.substeps, n, cycle.substeps, &scope};
    fine.time += scope.dt * fine.start_share();
    if (run(cycle.body, fine, journal) == Verdict::reject) return Verdict::reject;
  }
  return Verdict::good;
}

Verdict run_retry(const Retry& retry, const StepScope& scope, StepJournal& journal) {
  StepScope smaller = scope;
  for (int attempt = 1; attempt <= retry.most + 1; ++attempt) {
    if (run(retry.body, smaller, journal) == Verdict::good) {
      if (retry.accepted) retry.accepted(smaller, attempt);
      journal.accept();
      return Verdict::good;
    }
    journal.reject();
    smaller.dt *= retry.factor;
  }
  return Verdict::reject;
}

void describe(const Schedule& schedule, const std::string& indent, std::string& text) {
  const std::string inner = indent + "  ";
  for (const Node& node : schedule)
    std::visit(Overloaded{[&](const Sweep& s) { text += indent + "sweep " + s.name + "\n"; },
                          [&](const GhostExchange& h) {
                            text += indent + "ghost exchange " + h.name + ", width " +
                                    std::to_string(h.width) + "\n";
                          },
                          [&](const Stage& s) { text += indent + "all levels: " + s.name + "\n"; },
                          [&](const Loop& l) {
                            text += indent + "loop " + l.name + ", at most " +
                                    std::to_string(l.most) + " passes\n";
                            describe(l.body, inner, text);
                          },
                          [&](const LevelCycle& c) {
                            text += indent + "level " + std::to_string(c.level) + " " + c.name +
                                    ", " + std::to_string(c.substeps) + " substeps\n";
                            describe(c.body, inner, text);
                          },
                          [&](const Retry& r) {
                            text += indent + "step " + r.name + ", redone when rejected\n";
                            describe(r.body, inner, text);
                          }},
               node.what);
}

}  // namespace

Verdict agree(Verdict mine, Communicator& ranks) {
  if (ranks.size() == 1) return mine;
  Reduction all;
  const auto rejected = all.add_any(mine == Verdict::reject);
  ranks.reduce(all);
  return all.any(rejected) ? Verdict::reject : Verdict::good;
}

void StepJournal::accept() {
  const std::vector<std::function<void()>> acts = std::move(acts_);
  acts_.clear();
  for (const auto& act : acts) act();
}

void check(const Schedule& schedule) {
  check(schedule, 0, true);
}

Verdict run(const Schedule& schedule, const StepScope& scope, StepJournal& journal) {
  for (const Node& node : schedule) {
    const Verdict verdict =
        std::visit(Overloaded{[&](const Sweep& s) { return s.run(scope, journal); },
                              [&](const GhostExchange& h) { return h.exchange(scope, journal); },
                              [&](const Stage& s) { return s.run(scope, journal); },
                              [&](const Loop& l) { return run_loop(l, scope, journal); },
                              [&](const LevelCycle& c) { return run_cycle(c, scope, journal); },
                              [&](const Retry& r) { return run_retry(r, scope, journal); }},
                   node.what);
    if (verdict == Verdict::reject) return Verdict::reject;
  }
  return Verdict::good;
}

std::string describe(const Schedule& schedule) {
  std::string text;
  describe(schedule, "", text);
  return text;
}

}  // namespace sluice
