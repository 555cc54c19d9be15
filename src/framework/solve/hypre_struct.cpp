// Systems and vectors of hypre's Struct interface, and its solves.
#include "framework/solve/hypre_struct.hpp"

#include <fmt/format.h>

#include <bit>

#include "framework/base/communicator.hpp"
#include "framework/base/error.hpp"

namespace sluice::solve {
namespace {

// Is a method of hypre at work, alone or as preconditioner.
bool uses(const SolverSettings& s, const std::string& name) {
  const bool takes_one = s.solver != "diagonal" && struct_method(s.solver).precondition != nullptr;
  return s.solver == name || (takes_one && s.preconditioner == name);
}

// SparseMSG dies of a segmentation fault on several ranks.
void need_one_rank_for_sparsemsg(const SolverSettings& s) {
  if (world().size() == 1 || !uses(s, "sparsemsg")) return;
  throw InputError("hypre's sparsemsg runs on one rank only; try pfmg");
}

// SMG fails on other periods: codes, NaN, or no convergence.
void need_period_of_smg(const SolverSettings& s, const DenseShape& shape) {
  for (std::size_t d = 0; d < 3 && uses(s, "smg"); ++d) {
    const auto n = static_cast<unsigned>(shape.count[d]);
    if (!shape.periodic[d] || std::has_single_bit(n)) continue;
    throw InputError(fmt::format(
        "hypre's smg needs a power of 2 of cells in periodic directions, one has {}; try pfmg or "
        "the solver type CGSolver",
        n));
  }
}

}  // namespace

HypreStructSolver::HypreStructSolver(const SolverSettings& settings)
    : LinearSolver(settings), method_(struct_method(settings.solver)) {
  need_one_rank_for_sparsemsg(settings);
}

void HypreStructSolver::prepare(const DenseSystem& system) {
  need_period_of_smg(settings(), system.shape());
  start_hypre();
  worker_.reset();
  slab_ = slab_of(system);
  const int dimensions = slab_.dimensions();
  grid_ = {};
  check_hypre(HYPRE_StructGridCreate(MPI_COMM_WORLD, dimensions, grid_.out()), "StructGridCreate");
  std::array<int, 3> lower = slab_.lower(), upper = slab_.upper(), period{};
  if (!slab_.empty())
    check_hypre(HYPRE_StructGridSetExtents(grid_.get(), lower.data(), upper.data()),
                "StructGridSetExtents");
  for (std::size_t d = 0; d < 3; ++d)
    if (system.shape().periodic[d]) period[d] = system.shape().count[d];
  check_hypre(HYPRE_StructGridSetPeriodic(grid_.get(), period.data()), "StructGridSetPeriodic");
  check_hypre(HYPRE_StructGridAssemble(grid_.get()), "StructGridAssemble");
  stencil_ = {};
  check_hypre(HYPRE_StructStencilCreate(dimensions, dimensions + 1, stencil_.out()),
              "StructStencilCreate");
  for (int entry = 0; entry <= dimensions; ++entry) {
    std::array<int, 3> offset{};
    if (entry > 0) offset[entry - 1] = -1;
    check_hypre(HYPRE_StructStencilSetElement(stencil_.get(), entry, offset.data()),
                "StructStencilSetElement");
  }
  make_matrix();
  fill_matrix(system);
  for (auto* vector : {&b_, &x_, &ones_}) {
    *vector = {};
    check_hypre(HYPRE_StructVectorCreate(MPI_COMM_WORLD, grid_.get(), vector->out()),
                "StructVectorCreate");
    check_hypre(HYPRE_StructVectorInitialize(vector->get()), "StructVectorInitialize");
    put(vector->get(), vector == &ones_ ? system.ones() : system.vector());
  }
  mean_free_ = {};
  if (system.singular()) {
    mean_free_.ones = ones_.get();
    mean_free_.unknowns = static_cast<double>(system.unknowns());
  }
  make_worker();
}

bool HypreStructSolver::can_renew() const {
  return !uses(settings(), "smg");
}

// The workers refer to the matrix: Krylov methods and the finest level of cycles see it as it is.
void HypreStructSolver::renew(const DenseSystem& system) {
  fill_matrix(system);
}

// Anew whenever it is to be set up: to set an object up twice leaks its grids.
void HypreStructSolver::make_worker() {
  worker_ = std::make_unique<StructWorker>(method_, settings(), false, mean_free_);
  method_.set_iterations(worker_->get(), settings().max_iterations);
  method_.set_up(worker_->get(), matrix_.get(), b_.get(), x_.get());
  if (const std::string failure = take_hypre_failure(); !failure.empty())
    throw PhysicsError(fmt::format("hypre: set-up of {} failed: {}", settings().solver, failure));
}

void HypreStructSolver::make_matrix() {
  matrix_ = {};
  check_hypre(HYPRE_StructMatrixCreate(MPI_COMM_WORLD, grid_.get(), stencil_.get(), matrix_.out()),
              "StructMatrixCreate");
  check_hypre(HYPRE_StructMatrixSetSymmetric(matrix_.get(), 1), "StructMatrixSetSymmetric");
  check_hypre(HYPRE_StructMatrixInitialize(matrix_.get()), "StructMatrixInitialize");
  numbers_.resize(slab_.cells());
}

void HypreStructSolver::fill_matrix(const DenseSystem& system) {
  std::array<int, 3> lower = slab_.lower(), upper = slab_.upper();
  for (int entry = 0; entry <= slab_.dimensions() && !slab_.empty(); ++entry) {
    const DenseVector& from = entry == 0 ? system.diagonal() : system.low(entry - 1);
    double* next = numbers_.data();
    slab_.for_cells([&](std::ptrdiff_t c) { *next++ = from[c]; });
    check_hypre(HYPRE_StructMatrixSetBoxValues(matrix_.get(), lower.data(), upper.data(), 1, &entry,
                                               numbers_.data()),
                "StructMatrixSetBoxValues");
  }
  check_hypre(HYPRE_StructMatrixAssemble(matrix_.get()), "StructMatrixAssemble");
}

void HypreStructSolver::put(HYPRE_StructVector to, const DenseVector& v) {
  double* next = numbers_.data();
  slab_.for_cells([&](std::ptrdiff_t c) { *next++ = v[c]; });
  std::array<int, 3> lower = slab_.lower(), upper = slab_.upper();
  if (!slab_.empty())
    check_hypre(HYPRE_StructVectorSetBoxValues(to, lower.data(), upper.data(), numbers_.data()),
                "StructVectorSetBoxValues");
  check_hypre(HYPRE_StructVectorAssemble(to), "StructVectorAssemble");
}

LinearSolver::Attempt HypreStructSolver::attempt(const DenseSystem& system, const DenseVector& b,
                                                 DenseVector& x, const Goal& goal) {
  start_hypre();
  if (method_.solve == HYPRE_StructHybridSolve) make_worker();  // a second solve leaks
  put(b_.get(), b);
  put(x_.get(), x);
  method_.set_tolerance(worker_->get(), goal.residual / system.norm(b, Norm::two));
  method_.set_iterations(worker_->get(), goal.max_iterations);
  method_.solve(worker_->get(), matrix_.get(), b_.get(), x_.get());
  Attempt result;
  result.failure = take_hypre_failure();
  HYPRE_Int iterations = 0;
  method_.iterations(worker_->get(), &iterations);
  HYPRE_ClearAllErrors();
  result.iterations = iterations;
  if (result.failure.empty() && iterations >= goal.max_iterations)
    result.failure = "the maximum of iterations";
  std::array<int, 3> lower = slab_.lower(), upper = slab_.upper();
  if (!slab_.empty())
    check_hypre(
        HYPRE_StructVectorGetBoxValues(x_.get(), lower.data(), upper.data(), numbers_.data()),
        "StructVectorGetBoxValues");
  take_solution(system, slab_, numbers_, x);
  return result;
}

}  // namespace sluice::solve
