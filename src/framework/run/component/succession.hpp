// One component after another in a run: what passes from each to the next.
//
// A successor goes on from the state of its predecessor as it would from a checkpoint. What both
// carry of particles passes on; what the successor alone carries is as at a start, where that is
// zero; a successor that needs more cannot follow.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "framework/run/component/particle_method.hpp"

namespace sluice {

class Component;
struct Scene;

struct Successor {
  int after = 0;  // takes over when so many steps of the run are done
  const Scene* scene = nullptr;
  const Component* component = nullptr;
};

// Of the particles of one kind: labels.
struct PassedOn {
  std::string kind;
  std::vector<std::string> carried;   // both have it
  std::vector<std::string> at_start;  // zero, as at a start
  std::vector<std::string> lacking;   // the successor needs it, the predecessor has it not
  std::vector<std::string> dropped;   // the successor has no use for it
};

// By kind; why the one cannot follow the other with particles at all; empty: it can.
std::string succession_obstacle(const ParticleMethod& from, const ParticleMethod& to);
std::vector<PassedOn> passed_on(const ParticleMethod& from, const ParticleMethod& to);

// Columns of ParticleSet that both kinds have: of the one, of the other.
std::vector<std::pair<std::size_t, std::size_t>> common_columns(const ParticleKind& from,
                                                                const ParticleKind& to);

}  // namespace sluice
