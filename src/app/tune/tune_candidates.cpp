#include "app/tune/tune_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/solve/composite_solver.hpp"

namespace sluice {
namespace {

using solve::Norm;
using solve::SolverSettings;

struct Method {
  const char *solver, *preconditioner;
  int relax_type = 2, skip = 1, sweeps = 1;
};

// As measured on pressures with and without jumps of density (docs/tuning.md): multigrid with
// red-black points under conjugate gradients leads, sweeps of planes (smg) win where cells are
// stretched and densities jump, plain preconditioners on small systems that are nearly diagonal.
constexpr Method methods[] = {
    {"cg", "pfmg", 2, 1},
    {"cg", "pfmg", 2, 0},
    {"cg", "pfmg", 1, 1},
    {"cg", "pfmg", 1, 0},
    {"cg", "smg"},
    {"cg", "diagonal"},
    {"cg", "jacobi"},
    {"bicgstab", "pfmg", 2, 1},
    {"pfmg", "none", 2, 1},
    {"smg", "none"},
    {"cg", "pfmg", 2, 1, 2},
    {"hybrid", "pfmg", 2, 1},
    {"gmres", "pfmg", 2, 1},
    {"pfmg", "none", 3, 1},
    {"pfmg", "none", 1, 1},
    {"bicgstab", "pfmg", 3},
    {"gmres", "smg"},
    {"bicgstab", "smg"},
    {"hybrid", "diagonal"},
    {"cg", "none"},
    {"cg", "smg", 2, 1, 2},
    {"cg", "pfmg", 1, 1, 2},
    {"bicgstab", "diagonal"},
    {"jacobi", "none"},
};

bool takes_preconditioner(const SolverSettings& s) {
  for (const char* name : {"cg", "pcg", "gmres", "bicgstab", "hybrid"})
    if (s.solver == name) return true;
  return false;
}

// What the method does not ask for stays as the deck has it.
SolverSettings hypre_settings(const SolverSettings& deck, const Method& method, double tolerance) {
  SolverSettings s = deck;
  s.type = "hypre";
  s.solver = method.solver;
  s.preconditioner = method.preconditioner;
  s.tolerance = tolerance;
  s.absolute_tolerance = 0;
  s.norm = Norm::two;
  s.preconditioner_iterations = 1;
  s.preconditioner_tolerance = 0;
  if (works_with(s, "pfmg") || works_with(s, "smg")) s.before = s.after = method.sweeps;
  if (works_with(s, "pfmg")) {
    s.relax_type = method.relax_type;
    s.skip = method.skip;
  }
  return s;
}

bool is_relative(const SolverSettings& s) {
  return s.norm == Norm::two && s.absolute_tolerance == 0;
}

}  // namespace

bool works_with(const SolverSettings& s, const std::string& method) {
  return s.type == "hypre" &&
         (s.solver == method || (takes_preconditioner(s) && s.preconditioner == method));
}

std::string short_name(const SolverSettings& s) {
  if (s.type == "CGSolver") return "CGSolver";
  if (s.type == "hypreamr" || s.solver == "amg") return "hypreamr";
  std::string name = "hypre " + s.solver;
  if (s.preconditioner != "none" && takes_preconditioner(s)) name += "+" + s.preconditioner;
  if (works_with(s, "pfmg")) name += fmt::format(", relax {}, skip {}", s.relax_type, s.skip);
  if ((works_with(s, "pfmg") || works_with(s, "smg")) && (s.before != 1 || s.after != 1))
    name += fmt::format(", sweeps {}+{}", s.before, s.after);
  return name;
}

double relative_tolerance(const SolverSettings& deck, const CapturedSystems& systems) {
  if (is_relative(deck)) return deck.tolerance;
  double least = 0.1;
  for (const auto& system : systems) {
    const std::vector<double> of_deck = system->norms(deck.norm), two = system->norms(Norm::two);
    // |r|_inf <= |r|_2, and |r|_1 <= sqrt(n) |r|_2.
    const double grows =
        deck.norm == Norm::one ? std::sqrt(static_cast<double>(system->unknowns())) : 1.0;
    for (std::size_t n = 0; n < two.size(); ++n)
      least = std::min(
          least, std::max(deck.tolerance * of_deck[n], deck.absolute_tolerance) / (grows * two[n]));
  }
  if (!(least > 0)) return 0;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  return std::stod(fmt::format("{:.0e}", std::max(1.0, std::floor(least / decade)) * decade));
}

std::vector<SolverSettings> solver_candidates(const SolverSettings& deck,
                                              const CapturedSystems& systems) {
  const double tolerance = relative_tolerance(deck, systems);
  std::vector<SolverSettings> list{deck};
  const auto add = [&](const SolverSettings& s) {
    const std::string name = short_name(s);
    for (const SolverSettings& known : list)
      if (short_name(known) == name) return;
    list.push_back(s);
  };
  SolverSettings amg =
      hypre_settings(deck, {deck.solver.c_str(), deck.preconditioner.c_str()}, tolerance);
  amg.type = "hypreamr";
  SolverSettings own = deck;
  own.type = "CGSolver";
  if (systems.front()->levels() > 1) {
    add(solve::takes_amg_on_levels(deck) ? own : amg);
    return list;
  }
  add(own);
  for (const Method& m : methods) {
    if (std::string(m.solver) == "pfmg" && m.relax_type == 2) add(amg);  // before the doubtful ones
    add(hypre_settings(deck, m, tolerance));
  }
  return list;
}

}  // namespace sluice
