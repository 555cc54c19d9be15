// Copies of systems, and trials of solvers on them.
#include "framework/solve/captured_system.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cmath>

#include "framework/base/communicator.hpp"
#include "framework/base/error.hpp"
#include "framework/solve/composite_solver.hpp"
#include "framework/solve/linear_solver.hpp"

namespace sluice::solve {
namespace {

void copy(const ConstBoxViews& from, const BoxViews& to) {
  for (std::size_t b = 0; b < to.size(); ++b)
    for_each_cell(to[b].box, [&](IntVec3 c) { to[b](c) = from[b](c); });
}

void copy(const BoxViews& from, const BoxViews& to) {
  copy(ConstBoxViews(from.begin(), from.end()), to);
}

// What malloc has handed out.
double allocated_bytes() {
  const struct mallinfo2 now = mallinfo2();
  return static_cast<double>(now.uordblks) + static_cast<double>(now.hblkhd);
}

double goal_of(const SolverSettings& s, double right_side) {
  return std::max(s.tolerance * right_side, s.absolute_tolerance);
}

// A residual at its goal: solvers stop at the recomputed one, which sums in another order.
constexpr double rounding = 1e-6;

void judge(SolverTrial& trial, double left, double goal, const SolveReport& report) {
  const double share = goal > 0 ? left / goal : left > 0 ? HUGE_VAL : 0.0;
  if (!(share <= trial.residual)) trial.residual = share;  // NaN too
  if (share <= 1.0 + rounding || !trial.failure.empty()) return;
  trial.failure = report.reason.empty() ? fmt::format("residual {:.3g}, {:.3g} wanted", left, goal)
                                        : report.reason;
}

// Of this thread: what else runs on the machine is no part of a solver's time.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// What `work()` takes is added to `seconds`.
template <class Work>
auto timed(double& seconds, Work&& work) {
  const double begin = processor_seconds();
  if constexpr (std::is_void_v<decltype(work())>) {
    work();
    seconds += processor_seconds() - begin;
  } else {
    auto result = work();
    seconds += processor_seconds() - begin;
    return result;
  }
}

// Runs `body(trial)`; what it throws is the trial's failure.
template <class Body>
SolverTrial guarded(const SolverSettings& solver, Body&& body) {
  SolverTrial trial;
  try {
    start_library(solver);  // its start is no part of a set-up
    body(trial);
  } catch (const Error& refused) {
    trial.failure = refused.what();
    trial.residual = HUGE_VAL;
  }
  return trial;
}

}  // namespace

class SystemCapture::OnOneLevel final : public CapturedSystem {
 public:
  OnOneLevel(int number, const CellMatrix& matrix)
      : CapturedSystem(number), level_(std::make_unique<Level>(matrix.level())), matrix_(*level_) {
    copy(matrix.diagonal(), matrix_.diagonal());
    for (int d = 0; d < 3; ++d) copy(matrix.low(d), matrix_.low(d));
  }
  void add(const ConstBoxViews& right_side, const ConstBoxViews& start) {
    const std::vector<IndexBox> boxes = boxes_of(*level_, world().rank());
    copy(right_side, right_sides_.emplace_back(boxes).views());
    copy(start, starts_.emplace_back(boxes).views());
  }

  int levels() const override { return 1; }
  std::int64_t unknowns() const override { return DenseSystem(matrix_).unknowns(); }
  std::size_t right_sides() const override { return right_sides_.size(); }
  std::vector<double> norms(Norm kind) const override {
    const DenseSystem system(matrix_);
    std::vector<double> found;
    for (const BoxArrays& b : right_sides_)
      if (const double n = system.norm(loaded(system, b), kind); n > 0) found.push_back(n);
    return found;
  }
  SolverTrial attempt(const SolverSettings& solver, const SolverSettings& goal,
                      std::size_t most) const override {
    const DenseSystem system(matrix_);
    BoxArrays x(boxes_of(*level_, world().rank()));
    return guarded(solver, [&](SolverTrial& trial) {
      const double before = allocated_bytes();
      const auto linear = make_linear_solver(solver);
      timed(trial.set_up_seconds, [&] { linear->set_up(matrix_); });
      for (std::size_t n = 0; n < std::min(most, right_sides_.size()); ++n) {
        copy(starts_[n].views(), x.views());
        const SolveReport report = timed(trial.solve_seconds, [&] {
          return linear->solve(right_sides_[n].values(), x.views());
        });
        trial.iterations += report.iterations;
        if (n == 0) trial.bytes = std::max(0.0, allocated_bytes() - before);
        const DenseVector b = loaded(system, right_sides_[n]);
        DenseVector found = system.vector(), left = system.vector();
        system.load(x.values(), found);
        system.residual(b, found, left);
        judge(trial, system.norm(left, goal.norm), goal_of(goal, system.norm(b, goal.norm)),
              report);
      }
    });
  }

 private:
  static DenseVector loaded(const DenseSystem& system, const BoxArrays& numbers) {
    DenseVector v = system.vector();
    system.load(numbers.values(), v);
    if (system.singular()) system.remove_mean(v);
    return v;
  }

  std::unique_ptr<Level> level_;
  CellMatrix matrix_;
  std::vector<BoxArrays> right_sides_, starts_;
};

class SystemCapture::OnLevels final : public CapturedSystem {
 public:
  OnLevels(int number, std::span<const LevelCoefficients> levels) : CapturedSystem(number) {
    for (const LevelCoefficients& from : levels) {
      levels_.push_back(std::make_unique<Level>(*from.level));
      LevelCoefficients& to = coefficients_.emplace_back(*levels_.back(), world().rank());
      copy(from.own.views(), to.own.views());
      for (std::size_t d = 0; d < 3; ++d) {
        copy(from.low[d].views(), to.low[d].views());
        copy(from.high[d].views(), to.high[d].views());
      }
    }
  }
  void add(const CompositeVector& right_side) { right_sides_.push_back(right_side); }

  int levels() const override { return static_cast<int>(levels_.size()); }
  std::int64_t unknowns() const override { return CompositeSystem(coefficients_).unknowns(); }
  std::size_t right_sides() const override { return right_sides_.size(); }
  std::vector<double> norms(Norm kind) const override {
    const CompositeSystem system(coefficients_);
    std::vector<double> found;
    for (const CompositeVector& b : right_sides_)
      if (const double n = system.norm(b, kind); n > 0) found.push_back(n);
    return found;
  }
  SolverTrial attempt(const SolverSettings& solver, const SolverSettings& goal,
                      std::size_t most) const override {
    const CompositeSystem system(coefficients_);
    CompositeVector x = system.vector(), left = x;
    return guarded(solver, [&](SolverTrial& trial) {
      const double before = allocated_bytes();
      CompositeSolver linear(solver);
      timed(trial.set_up_seconds, [&] { linear.set_up(coefficients_); });
      for (std::size_t n = 0; n < std::min(most, right_sides_.size()); ++n) {
        const CompositeVector& b = right_sides_[n];
        const SolveReport report = timed(trial.solve_seconds, [&] { return linear.solve(b, x); });
        trial.iterations += report.iterations;
        if (n == 0) trial.bytes = std::max(0.0, allocated_bytes() - before);
        system.apply(x, left);
        for (std::size_t l = 0; l < left.size(); ++l)
          for (std::size_t c = 0; c < left[l].size(); ++c) left[l][c] = b[l][c] - left[l][c];
        system.clear_covered(left);
        // The solver's own recurrence may drift from this by a factor of 2 (composite_solver).
        const double goal_here = goal_of(goal, system.norm(b, goal.norm));
        judge(trial, system.norm(left, goal.norm), report.converged ? 2.0 * goal_here : goal_here,
              report);
      }
    });
  }

 private:
  std::vector<std::unique_ptr<Level>> levels_;
  std::vector<LevelCoefficients> coefficients_;
  std::vector<CompositeVector> right_sides_;
};

SystemCapture::SystemCapture(std::size_t wanted, std::size_t most_right_sides)
    : wanted_(wanted), max_right_sides_(most_right_sides) {}

SystemCapture::~SystemCapture() = default;

// The last system stays only if its number does.
void SystemCapture::next(const SolverSettings& settings) {
  settings_ = settings;
  if (!kept_.empty() && kept_.back()->number() % stride_ != 0) kept_.pop_back();
  if (kept_.size() >= 2 * wanted_) {
    stride_ *= 2;
    std::erase_if(kept_, [&](const auto& system) { return system->number() % stride_ != 0; });
  }
  ++count_;
  one_ = nullptr;
  several_ = nullptr;
}

void SystemCapture::matrix(const CellMatrix& matrix, const SolverSettings& settings) {
  next(settings);
  auto made = std::make_unique<OnOneLevel>(count_, matrix);
  one_ = made.get();
  kept_.push_back(std::move(made));
}

void SystemCapture::matrix(std::span<const LevelCoefficients> levels,
                           const SolverSettings& settings) {
  next(settings);
  auto made = std::make_unique<OnLevels>(count_, levels);
  several_ = made.get();
  kept_.push_back(std::move(made));
}

void SystemCapture::right_side(const ConstBoxViews& right_side, const ConstBoxViews& start) {
  if (one_ != nullptr && one_->right_sides() < max_right_sides_) one_->add(right_side, start);
}

void SystemCapture::right_side(const CompositeVector& right_side) {
  if (several_ != nullptr && several_->right_sides() < max_right_sides_) several_->add(right_side);
}

std::vector<std::unique_ptr<CapturedSystem>> SystemCapture::take() {
  one_ = nullptr;
  several_ = nullptr;
  std::vector<std::unique_ptr<CapturedSystem>> taken;
  std::erase_if(kept_, [](const auto& system) { return system->norms(Norm::largest).empty(); });
  for (std::size_t n = 1; n <= wanted_ && !kept_.empty(); ++n) {
    const double place =
        static_cast<double>(count_) * static_cast<double>(n) / static_cast<double>(wanted_);
    const auto nearest =
        std::min_element(kept_.begin(), kept_.end(), [&](const auto& a, const auto& b) {
          return std::fabs(a->number() - place) < std::fabs(b->number() - place);
        });
    // Those before it are nearer to no later place.
    taken.push_back(std::move(*nearest));
    kept_.erase(kept_.begin(), nearest + 1);
  }
  kept_.clear();
  return taken;
}

}  // namespace sluice::solve
