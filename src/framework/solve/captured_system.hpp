// A system of a run, kept: its matrix and all right-hand sides that were solved for with it; and
// what any solver does with it.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/solve/system_watch.hpp"

namespace sluice::solve {

// One set-up and a solve for each right-hand side.
struct SolverTrial {
  std::string failure;  // why a solve missed its goal, or was refused; empty: all met it
  int iterations = 0;   // of all solves
  double set_up_seconds = 0, solve_seconds = 0;  // of the processor
  double bytes = 0;                              // that solver and matrix hold in memory
  double residual = 0;  // the largest over its goal, recomputed here; at most 1 when all is well
  double seconds() const { return set_up_seconds + solve_seconds; }
};

class CapturedSystem {
 public:
  explicit CapturedSystem(int number) : number_(number) {}
  virtual ~CapturedSystem() = default;
  int number() const { return number_; }  // among the systems of the run, from 1
  virtual int levels() const = 0;
  virtual std::int64_t unknowns() const = 0;
  virtual std::size_t right_sides() const = 0;
  // The norm, in its unit, of each right-hand side that is not 0 (of a singular system: without its
  // mean).
  virtual std::vector<double> norms(Norm kind) const = 0;
  // `goal`: whose norm and tolerances the residuals must meet, whatever the solver measures itself.
  // `most`: right-hand sides, the first ones. Never throws for what a solver refuses: that is the
  // trial's failure.
  virtual SolverTrial attempt(const SolverSettings& solver, const SolverSettings& goal,
                              std::size_t most = SIZE_MAX) const = 0;

 private:
  int number_;
};

// Keeps systems of a run that are spread evenly over it, although nobody knows its length before:
// every one at first; when there are twice as many as wanted, every other one of those goes, and
// from then on every second system stays (then every fourth, and so on). The last always stays.
class SystemCapture final : public LinearSystemObserver {
 public:
  // `wanted`: how many systems, at least 1. `most_right_sides`: of one matrix, the first ones.
  SystemCapture(std::size_t wanted, std::size_t most_right_sides);
  ~SystemCapture() override;

  void matrix(const CellMatrix& matrix, const SolverSettings& settings) override;
  void matrix(std::span<const LevelCoefficients> levels, const SolverSettings& settings) override;
  void right_side(const ConstBoxViews& right_side, const ConstBoxViews& start) override;
  void right_side(const CompositeVector& right_side) override;

  int count() const { return count_; }  // of matrices so far
  // By which the run solved; after the first system.
  const SolverSettings& settings() const { return settings_; }
  // In the order of the run: of n systems in all, those next to n/wanted, 2n/wanted, ..., n.
  // Without systems that have no right-hand side but 0.
  std::vector<std::unique_ptr<CapturedSystem>> take();

 private:
  class OnOneLevel;
  class OnLevels;
  void next(const SolverSettings& settings);

  std::size_t wanted_;
  int stride_ = 1;  // numbers that are multiples of it stay
  std::size_t max_right_sides_;
  SolverSettings settings_;
  int count_ = 0;
  std::vector<std::unique_ptr<CapturedSystem>> kept_;
  OnOneLevel* one_ = nullptr;  // the last of kept_, by its kind
  OnLevels* several_ = nullptr;
};

}  // namespace sluice::solve
