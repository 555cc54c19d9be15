// The parts of an implicit step of a deck, for tests of what computes with them.
#pragma once
#include "mpm/implicit/particle_stresses.hpp"
#include "mpm/test_support/implicit_run.hpp"

namespace sluice::mpm {

// All that is known when the first step begins.
struct StartOfStep {
  NodesOfStep::Parts parts;
  NodesOfStep& nodes;
  const ThreadTeam& team;
};

// A component that shows the start of each step.
class ShownStart : public Mpm {
 public:
  using Look = std::function<void(const StartOfStep&)>;
  ShownStart(const Scene& scene, const MpmScene& solids, Look look)
      : Mpm(scene, solids), look_(std::move(look)) {}
  const MpmStep& step() const override { return own_; }

 private:
  struct Step final : MpmStep {
    explicit Step(const ShownStart& of) : MpmStep(of), shown(&of) {}
    void declare_stages(StepShape& stages) const override {
      stages.stage("look", [of = shown](const StageScope& s) { return of->show(s); });
      MpmStep::declare_stages(stages);
    }
    const ShownStart* shown;
  };
  Verdict show(const StageScope& s) const {
    AllParticles all;
    all.gather(*s.particles, particles()->kinds(), *s.ranks);
    const Level level = s.levels.front()->level();
    const NodeBoundary boundary(run_scene(), scene(), level);
    const ReachedNodes reached(scene(), level, boundary, carried(), all);
    const NodesOfStep::Parts parts{&run_scene(), &scene(), &level,  &boundary,
                                   &carried(),   &all,     &reached};
    const NodesOfStep::Vectors none(all.count());
    NodesOfStep nodes(parts, none, none, s.step.dt, true);
    look_({parts, nodes, *s.levels.front()->team()});
    return Verdict::good;
  }
  Look look_;
  Step own_{*this};
};

// Runs one step of a deck and shows its start.
inline void look_at_start(const SolidDeck& deck, const std::string& name,
                          const ShownStart::Look& look) {
  bool looked = false;
  const TextRun run(deck, implicit_steps(1e-3, 1e-3, saves({"p.stress"})), name, 1,
                    [&](const Scene& scene, const MpmScene& solids) {
                      return std::make_unique<ShownStart>(scene, solids,
                                                          [&](const StartOfStep& start) {
                                                            if (!looked) look(start);
                                                            looked = true;
                                                          });
                    });
}

// A block of one material between mirrors and free sides, in one, two or three directions.
inline SolidDeck block_of(int dimensions, const std::string& flags, const char* res = "[2,2,2]") {
  SolidDeck deck;
  deck.flags = "<time_integrator>implicit</time_integrator>" + flags;
  deck.upper = fmt::format("[0.6,{},{}]", dimensions > 1 ? 0.5 : 0.1, dimensions > 2 ? 0.5 : 0.1);
  deck.cells = fmt::format("[6,{},{}]", dimensions > 1 ? 5 : 1, dimensions > 2 ? 5 : 1);
  deck.objects = fmt::format(
      "<geom_object><box><min>[0,0,0]</min><max>[0.3,{0},{1}]</max></box><res>{2}</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>",
      dimensions > 1 ? 0.3 : 0.1, dimensions > 2 ? 0.2 : 0.1, res);
  deck.faces = held("x-") + free_face("x+") + held("y-") +
               (dimensions > 1 ? free_face("y+") : held("y+")) + held("z-") +
               (dimensions > 2 ? free_face("z+") : held("z+"));
  return deck;
}

}  // namespace sluice::mpm
