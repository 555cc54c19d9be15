// The tags of linear solvers: described, and read into SolverSettings.
#include "framework/solve/solver_tags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/deck/faults.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::solve {
namespace {

// Decks write names in small letters, in capitals, or as their authors' papers do.
template <class Spec>
Spec with_spellings(Spec spec, const std::vector<std::pair<std::string, std::string>>& others) {
  for (const std::string& word : std::vector(spec.value.words)) {
    std::string capitals = word;
    for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (capitals != word) spec = spec.spelling(capitals, word);
  }
  for (const auto& [other, word] : others) spec = spec.spelling(other, word);
  return spec;
}

TagSpec solver_name() {
  return with_spellings(tag("solver", "method of hypre; amg: conjugate gradients with BoomerAMG")
                            .words(hypre_solvers())
                            .not_built({"fac", "FAC"})
                            .by_default("cg"),
                        {{"SparseMSG", "sparsemsg"},
                         {"conjugategradient", "cg"},
                         {"BiCGSTAB", "bicgstab"},
                         {"Hybrid", "hybrid"},
                         {"Jacobi", "jacobi"},
                         {"Diagonal", "diagonal"},
                         {"BoomerAMG", "amg"},
                         {"boomeramg", "amg"}});
}

TagSpec preconditioner_name() {
  std::vector<std::string> names = hypre_preconditioners();
  names.emplace_back("amg");
  return with_spellings(
      tag("preconditioner",
          "preconditioner of hypre's cg, gmres, bicgstab and hybrid; amg: only with cg")
          .words(names)
          .not_built({"fac", "FAC"})
          .by_default("pfmg"),
      {{"None", "none"},
       {"SparseMSG", "sparsemsg"},
       {"Jacobi", "jacobi"},
       {"Diagonal", "diagonal"},
       {"BoomerAMG", "amg"},
       {"boomeramg", "amg"}});
}

std::vector<TagSpec> goal_tags() {
  return {
      tag("tolerance", "tolerance for the norm of the residual, see criteria")
          .real()
          .at_least(0)
          .by_default("1e-10"),
      tag("maxiterations", "maximum number of iterations of a solve")
          .integer()
          .at_least(1)
          .by_default("75"),
      with_spellings(tag("norm", "norm of the residual; hypre supports only L2")
                         .words({"L2", "L1", "LInfinity"})
                         .spelling("l2", "L2")
                         .spelling("l1", "L1"),
                     {{"linfinity", "LInfinity"}, {"Linfinity", "LInfinity"}}),
      tag("criteria",
          "the tolerance is relative to the norm of the right-hand side (Relative), or the "
          "absolute norm of the residual (Absolute); hypre supports only Relative")
          .words({"Relative", "Absolute"})
          .spelling("relative", "Relative")
          .spelling("absolute", "Absolute"),
      tag("initial_tolerance",
          "accepted without effect: an initial guess within the tolerance is accepted")
          .real()
          .at_least(0),
  };
}

std::vector<TagSpec> hypre_tags() {
  return {
      solver_name(),
      preconditioner_name(),
      tag("precond_maxiters", "cycles of the preconditioner, each time")
          .integer()
          .at_least(1)
          .by_default("1"),
      tag("precond_tolerance", "at which the preconditioner ends; 0: after its cycles")
          .real()
          .at_least(0)
          .by_default("0"),
      tag("npre", "sweeps before a coarse correction")
          .integer()
          .at_least(0)
          .at_most(1000)
          .by_default("1"),
      tag("npost", "sweeps after it").integer().at_least(0).at_most(1000).by_default("1"),
      tag("skip", "1: PFMG skips smoothing on levels where it is not needed")
          .integer()
          .at_least(0)
          .at_most(1)
          .by_default("0"),
      tag("jump", "levels that SparseMSG omits").integer().at_least(0).at_most(30).by_default("0"),
      tag("relax_type",
          "smoother of PFMG and SparseMSG: 0 Jacobi, 1 weighted Jacobi, 2 red-black, "
          "3 red-black, not symmetric")
          .integer()
          .at_least(0)
          .at_most(3)
          .by_default("1"),
  };
}

std::vector<TagSpec> frequency_tags() {
  return {
      tag("setupFrequency",
          "maximum number of steps for which a set-up of a solver of hypre is used; absent: until "
          "convergence degrades or the coefficients change by a tenth")
          .integer()
          .at_least(1),
      tag("updateCoefFrequency", "steps for which the coefficients of the system are used")
          .integer()
          .at_least(1)
          .by_default("1"),
      tag("solveFrequency", "steps for which a solution is used")
          .integer()
          .at_least(1)
          .by_default("1"),
      tag("logging", "accepted without effect: residuals are always recorded")
          .integer()
          .at_least(0),
      tag("outputEquations", "write each system to files").words({"false"}).not_built({"true"}),
  };
}

Norm norm_of(const std::string& name) {
  return name == "L1" ? Norm::one : name == "LInfinity" ? Norm::largest : Norm::two;
}

void read_methods(const DeckNode& node, SolverSettings& s, std::vector<Fault>& faults) {
  s.solver = text_or(node, "solver", s.solver);
  s.preconditioner = text_or(node, "preconditioner", s.preconditioner);
  if (s.preconditioner == "amg") {
    if (s.solver != "cg" && s.solver != "pcg" && s.solver != "amg")
      add_error(faults, node.need("preconditioner").where,
                fmt::format("amg is not a preconditioner of {}", s.solver),
                "valid are cg, or " + join(hypre_preconditioners(), ", "));
    s.solver = "amg";
    s.preconditioner = "none";
  }
  if (s.type == "hypre" && (s.solver == "sparsemsg" || s.preconditioner == "sparsemsg"))
    add_warning(faults, node.where,
                "hypre does not free the memory of the set-ups of sparsemsg until the run ends",
                "pfmg is also faster");
}

void read_goal(const DeckNode& node, SolverSettings& s, std::vector<Fault>& faults) {
  s.tolerance = real_or(node, "tolerance", s.tolerance);
  s.max_iterations = integer_or(node, "maxiterations", s.max_iterations);
  const Norm norm = norm_of(text_or(node, "norm", "L2"));
  const bool absolute = text_or(node, "criteria", "Relative") == "Absolute";
  if (s.type == "CGSolver") {
    s.norm = norm;
    if (absolute) s.absolute_tolerance = std::exchange(s.tolerance, 0.0);
  } else if (norm != Norm::two || absolute) {
    add_warning(faults, node.child(norm != Norm::two ? "norm" : "criteria")->where,
                fmt::format("<norm> and <criteria> have no effect: {} measures the residual in L2, "
                            "relative to the right-hand side",
                            s.type),
                "they apply to CGSolver");
  }
}

void read_cycles(const DeckNode& node, SolverSettings& s) {
  s.preconditioner_iterations = integer_or(node, "precond_maxiters", s.preconditioner_iterations);
  s.preconditioner_tolerance = real_or(node, "precond_tolerance", s.preconditioner_tolerance);
  s.before = integer_or(node, "npre", s.before);
  s.after = integer_or(node, "npost", s.after);
  s.skip = integer_or(node, "skip", s.skip);
  s.jump = integer_or(node, "jump", s.jump);
  s.relax_type = integer_or(node, "relax_type", s.relax_type);
  s.set_up_every = integer_or(node, "setupFrequency", s.set_up_every);
  s.coefficients_every = integer_or(node, "updateCoefFrequency", s.coefficients_every);
  s.solve_every = integer_or(node, "solveFrequency", s.solve_every);
}

// Does the tag say something to the solver, or to the preconditioner that it takes.
bool is_heard(const std::string& tag, const SolverSettings& s) {
  if (s.type != "hypre") return s.type == "hypreamr" && tag.starts_with("precond_");
  constexpr const char* without_one[] = {"smg", "pfmg", "sparsemsg", "jacobi", "diagonal"};
  const bool takes_one =
      std::find(std::begin(without_one), std::end(without_one), s.solver) == std::end(without_one);
  const auto at_work = [&](const char* method) {
    return s.solver == method || (takes_one && s.preconditioner == method);
  };
  if (tag == "solver") return true;
  if (tag == "preconditioner") return takes_one;
  if (tag.starts_with("precond_"))
    return takes_one && (s.solver == "amg" || s.preconditioner != "none");
  if (tag == "jump") return at_work("sparsemsg");
  if (tag == "skip") return at_work("pfmg");
  if (tag == "relax_type") return at_work("pfmg") || at_work("sparsemsg");
  return at_work("smg") || at_work("pfmg") || at_work("sparsemsg");  // npre, npost
}

std::string name_of(const SolverSettings& s) {
  if (s.type != "hypre") return s.type;
  const bool alone = s.preconditioner == "none";
  return "hypre's " + s.solver + (alone ? "" : ", preconditioned by " + s.preconditioner);
}

// Tags of a solver that is not the one that runs.
void warn_of_unheard(const DeckNode& node, const SolverSettings& s, std::vector<Fault>& faults) {
  std::vector<std::string> unheard;
  const DeckNode* first = nullptr;
  for (const TagSpec& spec : hypre_tags()) {
    if (!node.has(spec.name) || is_heard(spec.name, s)) continue;
    // Blocks for hypre list all tags; those of methods that do not run stand there as they are.
    const std::string& text = node.child(spec.name)->text;
    if (s.type == "hypre" && text == spec.value.default_text) continue;
    unheard.push_back("<" + spec.name + ">");
    if (first == nullptr) first = node.child(spec.name);
  }
  if (unheard.empty()) return;
  add_warning(faults, first->where,
              fmt::format("{} {} no effect: the solver is {}", join(unheard, ", "),
                          unheard.size() == 1 ? "has" : "have", name_of(s)),
              s.type == "hypre" ? "remove the parameters of other solvers"
                                : "remove them, or write <Solver type=\"hypre\">");
}

// The block for a variable: of that name, or of none.
const DeckNode* parameters_for(const DeckNode* parent, const std::string& variable) {
  if (parent == nullptr) return nullptr;
  for (const DeckNode* block : parent->all("Parameters"))
    if (block->attribute("variable").value_or(variable) == variable) return block;
  return nullptr;
}

}  // namespace

TagSpec solver_parameters_tag() {
  return tag("Parameters", "parameters of the linear solver")
      .multiple()
      .attribute(attribute("variable", "what is solved for; absent: anything").text())
      .with_children(goal_tags())
      .with_children(hypre_tags())
      .with_children(frequency_tags());
}

void add_solver_tag(Schema& schema) {
  schema.add(tag("Solver", "which linear solver")
                 .attribute(attribute("type",
                                      "CGSolver: Sluice's own solver, the same bits on any boxes "
                                      "and ranks; hypre; hypreamr: BoomerAMG of hypre")
                                .once()
                                .words(solver_types()))
                 .child(solver_parameters_tag()));
}

std::string solver_type(const DeckNode& root) {
  const DeckNode* solver = root.child("Solver");
  return solver == nullptr ? SolverSettings{}.type
                           : solver->attribute("type").value_or(SolverSettings{}.type);
}

SolverSettings read_solver_parameters(const DeckNode* parameters, const std::string& type,
                                      std::vector<Fault>& faults) {
  SolverSettings settings;
  settings.type = type;
  if (parameters == nullptr) return settings;
  read_methods(*parameters, settings, faults);
  read_goal(*parameters, settings, faults);
  read_cycles(*parameters, settings);
  warn_of_unheard(*parameters, settings, faults);
  for (std::string& fault : faults_of(settings))
    add_error(faults, parameters->where, std::move(fault));
  return settings;
}

SolverSettings read_solver_settings(const DeckNode& root, const DeckNode& block,
                                    const std::string& variable, std::vector<Fault>& faults) {
  const DeckNode* parameters = parameters_for(&block, variable);
  for (const DeckNode* other : block.all("Parameters"))
    if (other != parameters)
      add_warning(faults, other->where,
                  fmt::format("<Parameters> have no effect: what is solved for is {}", variable),
                  "remove them");
  if (parameters == nullptr) parameters = parameters_for(root.child("Solver"), variable);
  return read_solver_parameters(parameters, solver_type(root), faults);
}

}  // namespace sluice::solve
