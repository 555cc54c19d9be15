// The methods of hypre's Struct interface by name, and their parameters.
#include <interpreter.h>

#include <algorithm>
#include <array>

#include "framework/base/error.hpp"
#include "framework/solve/hypre_struct.hpp"

namespace sluice::solve {
namespace {

// In GMRES, how many directions are kept; in the hybrid solver, how much a step of the diagonally
// scaled iterations must gain, and how many they are at most.
constexpr int kept_directions = 20;
constexpr double hybrid_gain = 0.9;
constexpr int hybrid_plain_iterations = 100;
// Without this weight SparseMSG diverges.
constexpr double sparse_weight = 2.0 / 3.0;

// The diagonally scaled iterations and those that follow them count alike.
HYPRE_Int set_hybrid_iterations(HYPRE_StructSolver solver, HYPRE_Int most) {
  const HYPRE_Int plain = std::min(hybrid_plain_iterations, most / 2);
  HYPRE_StructHybridSetDSCGMaxIter(solver, plain);
  return HYPRE_StructHybridSetPCGMaxIter(solver, most - plain);
}

HYPRE_Int set_up_within(HYPRE_StructSolver self, HYPRE_StructMatrix matrix, HYPRE_StructVector b,
                        HYPRE_StructVector x) {
  const auto& of = *reinterpret_cast<const MeanFree*>(self);
  return of.set_up(of.solver, matrix, b, x);
}

HYPRE_Int solve_without_mean(HYPRE_StructSolver self, HYPRE_StructMatrix matrix,
                             HYPRE_StructVector b, HYPRE_StructVector x) {
  static const mv_InterfaceInterpreter of_vectors = [] {
    mv_InterfaceInterpreter functions{};
    HYPRE_StructSetupInterpreter(&functions);
    return functions;
  }();
  const auto& of = *reinterpret_cast<const MeanFree*>(self);
  const HYPRE_Int code = of.solve(of.solver, matrix, b, x);
  return code | of_vectors.Axpy(-of_vectors.InnerProd(x, of.ones) / of.unknowns, of.ones, x);
}

#define SLUICE_STRUCT(NAME)                                                           \
  HYPRE_Struct##NAME##Create, HYPRE_Struct##NAME##Destroy, HYPRE_Struct##NAME##Setup, \
      HYPRE_Struct##NAME##Solve, HYPRE_Struct##NAME##SetTol
#define SLUICE_CYCLE(NAME)                                                                   \
  SLUICE_STRUCT(NAME), HYPRE_Struct##NAME##SetMaxIter, HYPRE_Struct##NAME##GetNumIterations, \
      HYPRE_Struct##NAME##SetZeroGuess, nullptr
#define SLUICE_KRYLOV(NAME)                                                                  \
  SLUICE_STRUCT(NAME), HYPRE_Struct##NAME##SetMaxIter, HYPRE_Struct##NAME##GetNumIterations, \
      nullptr, HYPRE_Struct##NAME##SetPrecond

const std::array<StructMethod, 8> methods{{
    {"smg", SLUICE_CYCLE(SMG)},
    {"pfmg", SLUICE_CYCLE(PFMG)},
    {"sparsemsg", SLUICE_CYCLE(SparseMSG)},
    {"jacobi", SLUICE_CYCLE(Jacobi)},
    {"cg", SLUICE_KRYLOV(PCG)},
    {"gmres", SLUICE_KRYLOV(GMRES)},
    {"bicgstab", SLUICE_KRYLOV(BiCGSTAB)},
    {"hybrid", SLUICE_STRUCT(Hybrid), set_hybrid_iterations, HYPRE_StructHybridGetNumIterations,
     nullptr, HYPRE_StructHybridSetPrecond},
}};

#undef SLUICE_KRYLOV
#undef SLUICE_CYCLE
#undef SLUICE_STRUCT

}  // namespace

const StructMethod& struct_method(const std::string& name) {
  const std::string of_hypre = name == "pcg" || name == "diagonal" ? "cg" : name;
  const auto found = std::find_if(methods.begin(), methods.end(),
                                  [&](const StructMethod& m) { return m.name == of_hypre; });
  if (found == methods.end()) throw InputError("hypre's Struct solvers have no '" + name + "'");
  return *found;
}

StructWorker::StructWorker(const StructMethod& method, const SolverSettings& settings,
                           bool preconditions, const MeanFree& mean_free)
    : method_(method), mean_free_(mean_free) {
  check_hypre(method.create(MPI_COMM_WORLD, &solver_), method.name);
  set_parameters(settings);
  if (preconditions) {
    method.set_tolerance(solver_, settings.preconditioner_tolerance);
    method.set_iterations(solver_, settings.preconditioner_iterations);
    method.start_from_zero(solver_);
  } else if (method.precondition != nullptr) {
    add_preconditioner(settings);
  }
}

StructWorker::~StructWorker() {
  method_.destroy(solver_);
}

void StructWorker::set_parameters(const SolverSettings& s) {
  const std::string name = method_.name;
  if (name == "smg") {
    HYPRE_StructSMGSetNumPreRelax(solver_, s.before);
    HYPRE_StructSMGSetNumPostRelax(solver_, s.after);
  } else if (name == "pfmg") {
    HYPRE_StructPFMGSetNumPreRelax(solver_, s.before);
    HYPRE_StructPFMGSetNumPostRelax(solver_, s.after);
    HYPRE_StructPFMGSetRelaxType(solver_, s.relax_type);
    HYPRE_StructPFMGSetSkipRelax(solver_, s.skip);
  } else if (name == "sparsemsg") {
    HYPRE_StructSparseMSGSetNumPreRelax(solver_, s.before);
    HYPRE_StructSparseMSGSetNumPostRelax(solver_, s.after);
    HYPRE_StructSparseMSGSetRelaxType(solver_, s.relax_type);
    HYPRE_StructSparseMSGSetJacobiWeight(solver_, sparse_weight);
    HYPRE_StructSparseMSGSetJump(solver_, s.jump);
  } else if (name == "cg") {
    HYPRE_StructPCGSetTwoNorm(solver_, 1);
  } else if (name == "gmres") {
    HYPRE_StructGMRESSetKDim(solver_, kept_directions);
  } else if (name == "hybrid") {
    HYPRE_StructHybridSetTwoNorm(solver_, 1);
    HYPRE_StructHybridSetConvergenceTol(solver_, hybrid_gain);
  }
}

void StructWorker::add_preconditioner(const SolverSettings& s) {
  const std::string name = s.solver == "diagonal" ? "diagonal" : s.preconditioner;
  if (name == "none") return;
  if (name == "diagonal") {
    precondition_by(HYPRE_StructDiagScaleSetup, HYPRE_StructDiagScale, nullptr);
    return;
  }
  preconditioner_ = std::make_unique<StructWorker>(struct_method(name), s, true);
  const StructMethod& method = preconditioner_->method();
  precondition_by(method.set_up, method.solve, preconditioner_->get());
}

void StructWorker::precondition_by(StructMethod::Work set_up, StructMethod::Work solve,
                                   HYPRE_StructSolver solver) {
  if (mean_free_.ones == nullptr) {
    method_.precondition(solver_, solve, set_up, solver);
    return;
  }
  mean_free_.set_up = set_up;
  mean_free_.solve = solve;
  mean_free_.solver = solver;
  method_.precondition(solver_, solve_without_mean, set_up_within,
                       reinterpret_cast<HYPRE_StructSolver>(&mean_free_));
}

}  // namespace sluice::solve
