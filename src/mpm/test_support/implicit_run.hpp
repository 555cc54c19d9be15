// Decks of implicit steps that run in this process.
#pragma once
#include <cmath>

#include "mpm/implicit/implicit_step.hpp"
#include "mpm/mpm.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm {

inline std::unique_ptr<Mpm> implicit_solids(const Scene& scene, const MpmScene& solids) {
  return std::make_unique<Mpm>(scene, solids);
}

// In place of the length of a run in SolidDeck: steps of dt until the end.
inline TextRun::Rewrites implicit_steps(double dt, double end, const std::string& output = {}) {
  return {{"type='mpm'", "type='impm'"},
          {"<maxTime>1</maxTime><delt_min>0</delt_min><delt_max>1</delt_max>",
           fmt::format("<maxTime>{}</maxTime><delt_min>0</delt_min><delt_max>{}</delt_max>"
                       "<delt_init>{}</delt_init>",
                       end * (1 - 1e-9), dt, dt)},
          {"<timestep_multiplier>0.4", "<timestep_multiplier>1"},
          {"<outputInterval>0</outputInterval>", output}};
}

// A face with one condition, in the words of decks.
inline std::string held(const char* side) {
  return fmt::format("<Face side='{}'><BCType id='all' label='Symmetric' var='symmetry'/></Face>\n",
                     side);
}
inline std::string free_face(const char* side) {
  return fmt::format(
      "<Face side='{}'><BCType id='all' label='Velocity' var='Neumann'><value>[0,0,0]</value>"
      "</BCType></Face>\n",
      side);
}

// A bar along x: cells of 0.1 m, two particles a cell, from x = 0 on, held there.
inline SolidDeck bar(int cells, const std::string& flags) {
  SolidDeck deck;
  deck.upper = fmt::format("[{},0.1,0.1]", 0.1 * (cells + 3));
  deck.cells = fmt::format("[{},1,1]", cells + 3);
  deck.flags = flags;
  deck.objects = fmt::format(
      "<geom_object><box><min>[0,0,0]</min><max>[{},0.1,0.1]</max></box><res>[2,1,1]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>",
      0.1 * cells);
  deck.faces = held("x-") + free_face("x+") + held("y-") + held("y+") + held("z-") + held("z+");
  return deck;
}

}  // namespace sluice::mpm
