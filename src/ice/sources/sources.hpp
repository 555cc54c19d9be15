// What models and ADD_HEAT add to cells in a step, after the remap and before one pressure is
// found.
//
// Each source acts on the state that the step has come to, one after the other as the deck names
// them, first exchanges, then burning, heat then fixed values: an operator of its own (splitting
// of first order in time; what it does to a cell at rest is exact). Mass, momentum and total energy
// change by what is told as `change`, to round-off:
//   exchange   the share s of the mass of `from` passes with its volume, momentum and energy; all
//              of it where less than 1e-16 of the cell would stay, nothing where the receiver is
//              absent and would get less than that: supports stay compact
//   burning    likewise, by the pressure sum V_m p_m of the cell (models/burn/jwlpp.hpp) or the
//              place (models/burn/light_time.hpp); the heat of the reaction goes to the product
//   heat       E_m += q M_m
//   fixed      M_m = V_m rho, E_m = V_m (rho e)(rho, T), momentum M_m u; what mixing with the other
//              materials of the cell takes from the kinetic energy becomes their heat, by mass
// Where each material has a velocity of its own, u_m = u + S_m/M_m is that of the momentum above:
// what passes in an exchange mixes with the receiver, whose heat the loss of kinetic energy
// becomes; the material of `fixed` mixes with none.
#pragma once
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "framework/task/task.hpp"
#include "ice/fluid/fluid.hpp"
#include "ice/step/cell_runs.hpp"
#include "ice/step/source_change.hpp"
#include "models/models.hpp"
#include "models/sources/added_heat.hpp"

namespace sluice::ice {

// Rows of a new state that sources change.
struct SourceRows {
  static constexpr std::size_t most = 32;

  const Row* row = nullptr;
  Out change;
  SourceChange layout;
  int first_material = 0;  // of those in the graph
  // By material of the graph, per volume of the cell: kg/m^3, fraction, J/m^3; volume null: it
  // fills the cell.
  std::array<double*, most> mass{}, volume{}, energy{};
  double* momentum[3] = {nullptr, nullptr, nullptr};  // by component, kg/(m^2 s)
  // Momentum of each material relative to the mixture, by component; null: one velocity.
  std::array<std::array<double*, 3>, most> slip{};
  bool multi_velocity() const { return slip[0][0] != nullptr; }
};

class Sources {
 public:
  // `direction`: level directions of the components of momentum.
  Sources(const models::ModelList& models, const std::vector<models::AddedHeat>& heat,
          const std::vector<Fluid>& fluids, const Level& level,
          const std::array<int, 3>& direction);

  // Nothing in the deck can ever act.
  bool none() const { return exchanges_.empty() && heat_.empty() && fixed_.empty(); }
  // Can a cell of this material alone come to hold others.
  bool takes_from(int material) const;
  bool takes_from(int material, const StepConstants& step) const;

  // Explosive and products of a prescribed front.
  std::optional<std::pair<int, int>> front() const;

  // Writes all components of the change.
  void apply(const SourceRows& rows) const;

 private:
  struct Fixed {
    int material = 0;
    double density = 0, energy = 0;    // per volume of the material
    std::array<double, 3> velocity{};  // by component
    models::TimeWindow when;
    CellRuns region;
  };
  struct Passed {
    double mass = 0, energy = 0;
  };
  Passed pass(const SourceRows& rows, int from, int to, int i, double share) const;
  void exchange(const SourceRows& rows, const models::MassExchange& model, double share) const;
  // burned(i): mass per volume of the cell that burns; 0 where none does.
  template <class Burned>
  void burn(const SourceRows& rows, const models::MassExchange& model, double heat,
            Burned&& burned) const;
  void burn_by_pressure(const SourceRows& rows, const models::MassExchange& model) const;
  void burn_by_front(const SourceRows& rows, const models::MassExchange& model) const;
  double pressure(const SourceRows& rows, int i) const;
  void tell_shares(const SourceRows& rows, const models::MassExchange& model) const;
  void heat(const SourceRows& rows, int material, double energy) const;
  void fix(const SourceRows& rows, const Fixed& fixed, int first, int end) const;

  // Of cells: where cell 0 begins, lengths, direction of a row, mean edge in the active directions.
  Vec3 anchor_, spacing_;
  int along_ = 0;
  double edge_ = 0;
  std::vector<models::MassExchange> exchanges_;
  std::vector<Fluid> fluids_;  // where something burns
  std::vector<models::AddedHeat> heat_;
  std::vector<Fixed> fixed_;
};

}  // namespace sluice::ice
