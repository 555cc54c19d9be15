// Effects: the phenomena a scene may call for, each on or off for a stated reason.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

struct Effect {
  std::string name;  // "viscous stress"
  bool on = false;
  std::string reason;  // why it is on, or why it is off
  Location line;       // the deck line that decides; file empty when no line does
};

// The effects of a run in the order in which their tasks are declared.
class EffectList {
 public:
  int add(Effect effect) {
    effects_.push_back(std::move(effect));
    return static_cast<int>(effects_.size()) - 1;
  }
  const Effect& operator[](int id) const { return effects_[id]; }
  int size() const { return static_cast<int>(effects_.size()); }
  bool on(int id) const { return (*this)[id].on; }

 private:
  std::vector<Effect> effects_;
};

}  // namespace sluice
