// Rows of the window for BoomerAMG, and its solves.
#include "framework/solve/hypre_amg.hpp"

#include <fmt/format.h>
#include <interpreter.h>

#include <limits>
#include <numeric>

#include "framework/base/error.hpp"

namespace sluice::solve {
namespace {

// hypre's own sums of vectors over all ranks.
const mv_InterfaceInterpreter& vector_functions() {
  static const mv_InterfaceInterpreter functions = [] {
    mv_InterfaceInterpreter f{};
    HYPRE_ParCSRSetupInterpreter(&f);
    return f;
  }();
  return functions;
}

// HMIS, extended interpolation of at most four cells, l1-Gauss-Seidel.
constexpr int hmis = 10, extended = 6, max_terms = 4, l1_gauss_seidel = 8;

}  // namespace

HYPRE_ParCSRMatrix parcsr_matrix(HYPRE_IJMatrix from) {
  void* object = nullptr;
  check_hypre(HYPRE_IJMatrixGetObject(from, &object), "IJMatrixGetObject");
  return static_cast<HYPRE_ParCSRMatrix>(object);
}

HYPRE_ParVector par_vector(HYPRE_IJVector from) {
  void* object = nullptr;
  check_hypre(HYPRE_IJVectorGetObject(from, &object), "IJVectorGetObject");
  return static_cast<HYPRE_ParVector>(object);
}

void choose_amg_methods(HYPRE_Solver amg) {
  HYPRE_BoomerAMGSetCoarsenType(amg, hmis);
  HYPRE_BoomerAMGSetInterpType(amg, extended);
  HYPRE_BoomerAMGSetPMaxElmts(amg, max_terms);
  HYPRE_BoomerAMGSetRelaxType(amg, l1_gauss_seidel);
  HYPRE_BoomerAMGSetAggNumLevels(amg, 1);
}

void HypreAmgSolver::prepare(const DenseSystem& system) {
  if (system.shape().cells() > std::numeric_limits<HYPRE_Int>::max() / 8) {
    throw InputError(fmt::format("hypre's amg numbers at most {} cells, the window has {}",
                                 std::numeric_limits<HYPRE_Int>::max() / 8,
                                 system.shape().cells()));
  }
  start_hypre();
  slab_ = slab_of(system);
  const auto first = static_cast<HYPRE_BigInt>(slab_.first_row());
  numbers_.assign(slab_.cells(), 0.0);
  rows_.resize(slab_.cells());
  std::iota(rows_.begin(), rows_.end(), first);
  make_matrix();
  fill_matrix(system);
  make_vector(b_, system.vector());
  make_vector(x_, system.vector());
  make_vector(ones_, system.ones());
  singular_ = system.singular();
  unknowns_ = static_cast<double>(system.unknowns());
  make_solvers();
}

void HypreAmgSolver::make_vector(HypreObject<HYPRE_IJVector, HYPRE_IJVectorDestroy>& vector,
                                 const DenseVector& v) {
  const auto first = static_cast<HYPRE_BigInt>(slab_.first_row());
  const auto last = first + static_cast<HYPRE_BigInt>(slab_.cells()) - 1;
  vector = {};
  check_hypre(HYPRE_IJVectorCreate(MPI_COMM_WORLD, first, last, vector.out()), "IJVectorCreate");
  check_hypre(HYPRE_IJVectorSetObjectType(vector.get(), HYPRE_PARCSR), "IJVectorSetObjectType");
  put(vector.get(), v);
}

// A cycle; of a singular system without the mean, which else grows until it hides the residual.
HYPRE_Int HypreAmgSolver::precondition(HYPRE_Solver self, HYPRE_ParCSRMatrix matrix,
                                       HYPRE_ParVector b, HYPRE_ParVector x) {
  auto& solver = *reinterpret_cast<HypreAmgSolver*>(self);
  const HYPRE_Int code = HYPRE_BoomerAMGSolve(solver.cycle_.get(), matrix, b, x);
  if (!solver.singular_) return code;
  HYPRE_ParVector ones = par_vector(solver.ones_.get());
  const mv_InterfaceInterpreter& of_vectors = vector_functions();
  const double mean = of_vectors.InnerProd(x, ones) / solver.unknowns_;
  return code | of_vectors.Axpy(-mean, ones, x);
}

// The rows stay one object: the Krylov method and the finest level of the cycle see the new ones.
void HypreAmgSolver::renew(const DenseSystem& system) {
  check_hypre(HYPRE_IJMatrixSetConstantValues(matrix_.get(), 0.0), "IJMatrixSetConstantValues");
  fill_matrix(system);
}

void HypreAmgSolver::make_matrix() {
  const auto first = static_cast<HYPRE_BigInt>(slab_.first_row());
  const auto last = first + static_cast<HYPRE_BigInt>(slab_.cells()) - 1;
  matrix_ = {};
  check_hypre(HYPRE_IJMatrixCreate(MPI_COMM_WORLD, first, last, first, last, matrix_.out()),
              "IJMatrixCreate");
  check_hypre(HYPRE_IJMatrixSetObjectType(matrix_.get(), HYPRE_PARCSR), "IJMatrixSetObjectType");
  const std::vector<HYPRE_Int> sizes(slab_.cells(), 7);
  check_hypre(HYPRE_IJMatrixSetRowSizes(matrix_.get(), sizes.data()), "IJMatrixSetRowSizes");
}

void HypreAmgSolver::fill_matrix(const DenseSystem& system) {
  check_hypre(HYPRE_IJMatrixInitialize(matrix_.get()), "IJMatrixInitialize");
  const DenseShape& shape = system.shape();
  const auto number = [&](std::array<int, 3> cell) {
    for (std::size_t d = 0; d < 3; ++d) cell[d] = (cell[d] + shape.count[d]) % shape.count[d];
    return static_cast<HYPRE_BigInt>(
        cell[0] + shape.count[0] * (cell[1] + static_cast<std::int64_t>(shape.count[1]) * cell[2]));
  };
  const std::array<int, 3> from = slab_.lower(), to = slab_.upper();
  for (int k = from[2]; k <= to[2]; ++k)
    for (int j = from[1]; j <= to[1]; ++j)
      for (int i = from[0]; i <= to[0]; ++i) {
        const std::size_t c = shape.at(i, j, k);
        const HYPRE_BigInt row = number({i, j, k});
        std::array<HYPRE_BigInt, 7> columns{row};
        std::array<double, 7> values{system.diagonal()[c]};
        HYPRE_Int n = 1;
        for (int d = 0; d < slab_.dimensions(); ++d) {
          for (const int side : {0, 1}) {
            const std::size_t at = c + side * shape.stride(d);
            if (system.low(d)[at] == 0) continue;
            std::array<int, 3> other{i, j, k};
            other[d] += side == 0 ? -1 : 1;
            columns[n] = number(other);
            values[n++] = system.low(d)[at];
          }
        }
        check_hypre(
            HYPRE_IJMatrixAddToValues(matrix_.get(), 1, &n, &row, columns.data(), values.data()),
            "IJMatrixAddToValues");
      }
  check_hypre(HYPRE_IJMatrixAssemble(matrix_.get()), "IJMatrixAssemble");
}

void HypreAmgSolver::make_solvers() {
  gradients_ = {};
  cycle_ = {};
  check_hypre(HYPRE_BoomerAMGCreate(cycle_.out()), "BoomerAMGCreate");
  HYPRE_BoomerAMGSetTol(cycle_.get(), settings().preconditioner_tolerance);
  HYPRE_BoomerAMGSetMaxIter(cycle_.get(), settings().preconditioner_iterations);
  choose_amg_methods(cycle_.get());
  check_hypre(HYPRE_ParCSRPCGCreate(MPI_COMM_WORLD, gradients_.out()), "ParCSRPCGCreate");
  HYPRE_PCGSetTwoNorm(gradients_.get(), 1);
  HYPRE_PCGSetMaxIter(gradients_.get(), settings().max_iterations);
  const auto set_up = [](HYPRE_Solver self, HYPRE_ParCSRMatrix matrix, HYPRE_ParVector b,
                         HYPRE_ParVector x) {
    return HYPRE_BoomerAMGSetup(reinterpret_cast<HypreAmgSolver*>(self)->cycle_.get(), matrix, b,
                                x);
  };
  HYPRE_ParCSRPCGSetPrecond(gradients_.get(), precondition, set_up,
                            reinterpret_cast<HYPRE_Solver>(this));
  HYPRE_ParCSRPCGSetup(gradients_.get(), parcsr_matrix(matrix_.get()), par_vector(b_.get()),
                       par_vector(x_.get()));
  if (const std::string failure = take_hypre_failure(); !failure.empty())
    throw PhysicsError("hypre: set-up of amg failed: " + failure);
}

void HypreAmgSolver::put(HYPRE_IJVector to, const DenseVector& v) {
  double* next = numbers_.data();
  slab_.for_cells([&](std::ptrdiff_t c) { *next++ = v[c]; });
  check_hypre(HYPRE_IJVectorInitialize(to), "IJVectorInitialize");
  check_hypre(HYPRE_IJVectorSetValues(to, static_cast<HYPRE_Int>(rows_.size()), rows_.data(),
                                      numbers_.data()),
              "IJVectorSetValues");
  check_hypre(HYPRE_IJVectorAssemble(to), "IJVectorAssemble");
}

LinearSolver::Attempt HypreAmgSolver::attempt(const DenseSystem& system, const DenseVector& b,
                                              DenseVector& x, const Goal& goal) {
  start_hypre();
  put(b_.get(), b);
  put(x_.get(), x);
  HYPRE_PCGSetTol(gradients_.get(), goal.residual / system.norm(b, Norm::two));
  HYPRE_PCGSetMaxIter(gradients_.get(), goal.max_iterations);
  HYPRE_ParCSRPCGSolve(gradients_.get(), parcsr_matrix(matrix_.get()), par_vector(b_.get()),
                       par_vector(x_.get()));
  Attempt result;
  result.failure = take_hypre_failure();
  HYPRE_PCGGetNumIterations(gradients_.get(), &result.iterations);
  HYPRE_ClearAllErrors();
  if (result.failure.empty() && result.iterations >= goal.max_iterations)
    result.failure = "the maximum of iterations";
  check_hypre(HYPRE_IJVectorGetValues(x_.get(), static_cast<HYPRE_Int>(rows_.size()), rows_.data(),
                                      numbers_.data()),
              "IJVectorGetValues");
  take_solution(system, slab_, numbers_, x);
  return result;
}

}  // namespace sluice::solve
