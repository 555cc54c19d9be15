// A component as small as can be: fields without material, nothing conserved, one level.
//
// It answers every question of the run loop that a field equation has nothing to say to, so that an
// example consists of what it computes. What is left to say is marked below: the state, its start,
// its boundary, a step, and how long that may be.
//
// Limits: no totals are kept, so the report of a run knows of no conservation; no cell is
// inadmissible, so a step is never redone; nothing sleeps.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"
#include "framework/run/component/component.hpp"
#include "framework/run/component/no_transfer.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

class PlainComponent : public Component {
 public:
  // To be said by every example:
  //   state_slots, initialise, fill_boundary, declare_step, step_limit
  std::string name() const override { return name_; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return 1; }  // fields belong to "material" 0

  // Checkpoints keep each slot under its own label.
  std::vector<std::vector<Label>> checkpoint_labels() const override;
  // All slots can be saved: copies of the state.
  void declare_diagnostics(TaskList& list, int level) const override;

  const TransferOperators& transfer() const override { return no_transfer_; }
  Label refine_flag() const override;
  Label mask_label() const override;
  int reduction_maxima() const override { return 0; }
  int reduction_sums() const override { return 0; }
  bool skipping_allowed() const override { return false; }
  double courant_number() const override { return 1; }
  void measure_rates(const Warehouse& /*state*/, Reductions& /*rates*/) const override {}
  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;
  std::string describe_fault(int kind) const override;

 protected:
  // `equation`: what the one effect of the component is called in plans and reports.
  PlainComponent(const Scene& scene, std::string name, std::string equation);
  const Scene& scene() const { return scene_; }
  const Level& level(int index) const { return scene_.grid.levels[index]; }
  static constexpr int equation = 0, saved = 1;  // effects

 private:
  const Scene& scene_;
  std::string name_;
  EffectList effects_;
  NoTransfer no_transfer_;
};

// The block of a component in its deck; null with a fault where the deck lacks it.
const DeckNode* need_block(const Deck& deck, const Scene& scene, const char* name,
                           std::vector<Fault>& faults);
// A fault for a deck with several levels.
void need_one_level(const Scene& scene, std::vector<Fault>& faults);

// One value everywhere in slot 0.
void fill_state(Warehouse& state, double value);

// The part of a row that lies in a box: cells number begin to end of the row. `along` is the level
// direction of the row.
struct RowPart {
  int begin = 0, end = 0;
};
RowPart part_in(const Row& row, const IndexBox& box, int along);

}  // namespace sluice
