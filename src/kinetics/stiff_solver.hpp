// Systems dy/dt = f(y) of few unknowns that may be stiff, by SUNDIALS.
//
// First ARKODE takes the whole time in one explicit step, by the pair of orders 5 and 4 of Dormand
// and Prince: where y hardly changes within the time, as in a flow whose sound is faster than its
// chemistry, that is all. Where its estimate of the error is beyond the tolerances, CVODE begins
// anew: backward differentiation of orders 1 to 5, Newton's method, a dense direct solver. An
// explicit step that is unstable enlarges what its two orders differ by, and is refused.
//
// References: Hindmarsh et al., ACM Trans. Math. Softw. 31 (2005) 363; Dormand and Prince, J.
// Comput. Appl. Math. 6 (1980) 19; Reynolds et al., ACM Trans. Math. Softw. 49 (2023) 19.
// Each unknown y has a unit of its own, f that of y per s.
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
  bool one_explicit_step(double dt, double relative);

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sluice::kinetics
