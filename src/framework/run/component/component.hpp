// What a physics component offers to the run loop.
//
// The run loop owns grids, warehouses, graphs, time and archives. It asks a component in six
// facets: the state that it keeps and the step that it takes must be there, the others have
// defaults. A component of several parts returns a part's facet as it is where nothing is to be
// added.
#pragma once
#include <string>

#include "framework/run/component/block_facet.hpp"
#include "framework/run/component/budget_facet.hpp"
#include "framework/run/component/level_facet.hpp"
#include "framework/run/component/output_facet.hpp"
#include "framework/run/component/state_facet.hpp"
#include "framework/run/component/step_facet.hpp"
#include "framework/task/effect.hpp"

namespace sluice {

class ParticleMethod;

class Component {
 public:
  virtual ~Component() = default;

  virtual std::string name() const = 0;
  virtual const EffectList& effects() const = 0;
  virtual int material_count() const { return 1; }

  virtual const StateFacet& state() const = 0;  // variables, their start, their boundary
  virtual const StepFacet& step() const = 0;    // tasks, stages, reductions, length
  virtual const BlockFacet& blocks() const;     // kinds of blocks, which of them sleep
  virtual const LevelFacet& levels() const;     // where levels meet, where finer ones are wanted
  virtual const BudgetFacet& budgets() const;   // what is conserved and counted
  virtual const OutputFacet& outputs() const;   // what can be saved
  // The particles that the scene has; null: none, and nothing of them is made.
  virtual const ParticleMethod* particles() const { return nullptr; }
};

}  // namespace sluice
