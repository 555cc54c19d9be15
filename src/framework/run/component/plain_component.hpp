// A component as small as can be: fields without material, nothing conserved, one level.
//
// It answers every question of the run loop that a field equation has nothing to say to, so that an
// example consists of what it computes. What is left to say is marked below: the state, its start,
// its boundary, a step, and how long that may be.
//
// Limits: no totals are kept, so the report of a run knows of no conservation; no cell is
// inadmissible, so a step is never redone; nothing sleeps.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"
#include "framework/run/component/component.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

class PlainComponent : public Component,
                       public StateFacet,
                       public StepFacet,
                       public LevelFacet,
                       public OutputFacet {
 public:
  // To be said by every example:
  //   slots, initialise, fill_boundary (StateFacet), declare, limit (StepFacet)
  std::string name() const override { return name_; }
  const EffectList& effects() const override { return effects_; }
  const StateFacet& state() const override { return *this; }
  const StepFacet& step() const override { return *this; }
  const LevelFacet& levels() const override { return *this; }
  const OutputFacet& outputs() const override { return *this; }
  const ReductionLayout& reductions() const override { return reductions_; }

  // All slots can be saved: copies of the state.
  void declare_diagnostics(TaskList& list, int level) const override;

 protected:
  // `equation`: what the one effect of the component is called in plans and reports.
  PlainComponent(const Scene& scene, std::string name, std::string equation);
  const Scene& scene() const { return scene_; }
  const Level& level(int index) const { return scene_.grid.levels[index]; }
  // What kernels reduce, registered when the component is made: row.reductions() counts from the
  // first one registered.
  SumGroup add_sums(int count) { return reductions_.add_sums(count); }
  MaximumGroup add_maxima(int count) { return reductions_.add_maxima(count); }
  static constexpr int equation = 0, saved = 1;  // effects

 private:
  const Scene& scene_;
  std::string name_;
  EffectList effects_;
  ReductionLayout reductions_;
};

// The block of a component in its deck; null with a fault where the deck lacks it.
const DeckNode* need_block(const Deck& deck, const Scene& scene, const char* name,
                           std::vector<Fault>& faults);
// A fault for a deck with several levels.
void need_one_level(const Scene& scene, std::vector<Fault>& faults);

// One value, in the unit of its label, everywhere in slot 0.
void fill_state(Warehouse& state, double value);

// The part of a row that lies in a box: cells number begin to end of the row. `along` is the level
// direction of the row.
struct RowPart {
  int begin = 0, end = 0;
};
RowPart part_in(const Row& row, const IndexBox& box, int along);

}  // namespace sluice
