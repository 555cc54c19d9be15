// Tags of implicit steps: how Newton's method ends, how it sets the length of
// steps, heat.
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/implicit.hpp"

namespace sluice::mpm {
namespace {

// Defaults are told here and not written into decks, as explicit steps read none of these tags.
std::string with_default(const std::string& doc, const std::string& standard) {
  return "implicit steps: " + doc + "; " + standard + " by default";
}

TagSpec implicit_flag(const std::string& name, const std::string& doc,
                      const std::string& standard) {
  return tag(name, with_default(doc, standard)).boolean();
}

TagSpec implicit_count(const std::string& name, const std::string& doc,
                       const std::string& standard) {
  return tag(name, with_default(doc, standard)).integer().at_least(1);
}

TagSpec implicit_criterion(const std::string& name, const std::string& doc,
                           const std::string& standard) {
  return tag(name, with_default(doc, standard)).real().above(0);
}

}  // namespace

std::vector<TagSpec> implicit_tags() {
  return {
      implicit_flag("dynamic", "nodes have inertia; false: every step ends in equilibrium", "true"),
      tag("solver",
          "implicit steps: how linear systems are solved; petsc, hypre and no tag: small ones "
          "directly, large ones by conjugate gradients with multigrid on the grid; simple: all "
          "directly")
          .words({"petsc", "simple", "hypre"}),
      implicit_criterion("convergence_criteria_disp",
                         "Newton's method ends when |du|^2 is less than this part of "
                         "its largest, and the "
                         "criterion of energy holds",
                         "1e-10"),
      implicit_criterion("convergence_criteria_energy",
                         "the same for |du . residual|, relative to its first value", "4e-10"),
      implicit_count("num_iters_to_decrease_delT",
                     "after this number of iterations or more the next step is "
                     "delT_decrease_factor times as long",
                     "12"),
      implicit_count(
          "num_iters_to_increase_delT",
          "after at most this number of iterations it is delT_increase_factor times as long", "4"),
      implicit_count("iters_before_timestep_restart",
                     "a step that has not converged after this number of iterations is repeated "
                     "with half its length, without inertia first with increments of the loads",
                     "25"),
      implicit_criterion("delT_decrease_factor", "see num_iters_to_decrease_delT", "0.6")
          .at_most(0.95),
      tag("delT_increase_factor", with_default("see num_iters_to_increase_delT", "2"))
          .real()
          .at_least(1),
      implicit_flag("DoMechanics", "bodies move and deform; false: only heat conduction", "true"),
      implicit_flag("DoImplicitHeatConduction",
                    "heat is conducted, with one linear system per step", "false"),
      implicit_flag("DoTransientImplicitHeatConduction",
                    "heat is stored; false: temperatures are those of a steady state", "true"),
      tag("temperature_solve", "accepted without effect: determined by DoImplicitHeatConduction")
          .boolean(),
      tag("interpolateParticleTempToGridEveryStep",
          "accepted without effect: particles get the change of the nodes' temperatures, which "
          "smooths nothing")
          .boolean(),
      tag("extra_solver_flushes", "accepted without effect: the solver needs none").integer(),
  };
}

bool runs_implicit(const DeckNode& root) {
  if (!runs_mpm(root)) return false;
  const DeckNode* component = root.child("SimulationComponent");
  const std::string type = component->attribute("type").value_or("");
  if (type == "impm" || type == "IMPM") return true;
  const DeckNode* flags = root.child("MPM");
  const DeckNode* integrator = flags == nullptr ? nullptr : flags->child("time_integrator");
  return integrator != nullptr && integrator->text == "implicit" &&
         (type == "mpm" || type == "MPM");
}

ImplicitSettings read_implicit(const DeckNode& flags) {
  ImplicitSettings s;
  s.dynamic = boolean_or(flags, "dynamic", s.dynamic);
  s.mechanics = boolean_or(flags, "DoMechanics", s.mechanics);
  s.displacement_criterion = real_or(flags, "convergence_criteria_disp", s.displacement_criterion);
  s.energy_criterion = real_or(flags, "convergence_criteria_energy", s.energy_criterion);
  s.iterations_to_shrink = integer_or(flags, "num_iters_to_decrease_delT", s.iterations_to_shrink);
  s.iterations_to_grow = integer_or(flags, "num_iters_to_increase_delT", s.iterations_to_grow);
  s.max_iterations = integer_or(flags, "iters_before_timestep_restart", s.max_iterations);
  s.shrink = real_or(flags, "delT_decrease_factor", s.shrink);
  s.grow = real_or(flags, "delT_increase_factor", s.grow);
  s.conducts = boolean_or(flags, "DoImplicitHeatConduction", s.conducts);
  s.direct = text_or(flags, "solver", "") == "simple";
  s.heat_is_stored = boolean_or(flags, "DoTransientImplicitHeatConduction", s.heat_is_stored);
  return s;
}

}  // namespace sluice::mpm
