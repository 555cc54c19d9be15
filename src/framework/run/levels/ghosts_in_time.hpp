// Ghost cells of levels within a coarse step: those at the interface with a coarser level are
// interpolated between its two states, to where the finer one stands between them.
#pragma once
#include <vector>

#include "framework/run/levels/levels.hpp"

namespace sluice {

class GhostsInTime {
 public:
  GhostsInTime(const Scene& scene, const Component& component, Levels& levels);

  // A coarse step begins: all levels stand at its start.
  void begin();
  // Is a coarse step being taken. Outside of one all levels stand at its end.
  void set_advancing(bool advancing) { advancing_ = advancing; }
  // A level has taken a step or substep that ended then.
  void note_advance(int l, double end);
  double end(int l) const { return ends_[l]; }

  void fill(int l, double time);
  void fill_all(double time);

 private:
  double share_of(int l) const;

  const Scene* scene_;
  const Component* component_;
  Levels* levels_;
  std::vector<int> done_;     // substeps, in the present step of the next coarser level
  std::vector<double> ends_;  // of the last sweep over a level: its time
  bool advancing_ = false;
};

}  // namespace sluice
