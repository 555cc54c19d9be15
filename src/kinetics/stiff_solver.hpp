// Stiff systems dy/dt = f(y) of few unknowns, by CVODE of SUNDIALS: backward differentiation of
// orders 1 to 5 with Newton's method and a dense direct solver.
//
// Reference: Hindmarsh et al., ACM Trans. Math. Softw. 31 (2005) 363.
#pragma once
#include <cstddef>
#include <memory>
#include <string>

namespace sluice::kinetics {

class StiffSystem {
 public:
  virtual ~StiffSystem() = default;
  // f(y); false: y is out of the domain, a shorter step is tried.
  virtual bool slopes(const double* y, double* f) = 0;
  // df_i/dy_j at columns[j][i]; it need not be exact.
  virtual void jacobian(const double* y, double** columns) = 0;
};

// Nothing is remembered between calls: the same start gives the same bits. One object per thread.
class StiffSolver {
 public:
  // Keeps a reference to the system. SystemError: no memory.
  StiffSolver(StiffSystem& system, std::size_t unknowns);
  ~StiffSolver();
  StiffSolver(const StiffSolver&) = delete;
  StiffSolver& operator=(const StiffSolver&) = delete;

  double* unknowns();             // y: the start, then the end
  double* absolute_tolerances();  // of y
  struct Outcome {
    bool good = false;
    double last_step = 0;  // s
    long steps = 0;
    std::string problem;  // where it is not good
  };
  // From y over dt > 0, s. Local errors are kept below relative |y| + absolute.
  Outcome advance(double dt, double relative);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sluice::kinetics
