// The surface of one material along which a rarefied gas slips (MultiVelocityExchange).
//
// Any material may stand for the solid: its surface is where its volume fraction V_s jumps, as
// where materials lie side by side (multi_velocity/motion.cpp): not up to a quarter of a cell,
// fully from three quarters on. What is torn apart smoothly has no surface; it exchanges with the
// deck's coefficients.
// The area of the surface that a face between two cells holds is the jump of V_s there, as in
// contacts.hpp. Cells that gas and solid share take the part s = 4 V_g V_s of it (of two that
// share, each in proportion), so that an interface counts once, wherever it lies; what is left
// is the face's. The area of a cell is the size of what its faces leave it along each axis, its
// normal the direction, out of the solid.
#pragma once
#include "ice/closure/surface_law.hpp"
#include "ice/mixture/tasks.hpp"

namespace sluice::ice::mixture {

// Components of Variables::surface.
struct SurfaceParts {
  static constexpr int share = 0;               // 0: no surface, 1: nothing but a surface
  static constexpr int momentum = 1, heat = 2;  // that pass, per volume: kg/(m^3 s), W/(m^3 K)
  static constexpr int momentum_per_area = 3, heat_per_area = 4;  // of the gas of the cell
  static constexpr int normal = 5;                                // by axis
  static constexpr int count(int axes) { return normal + axes; }
};

// The contact of gas and solid at a face between two cells.
struct FaceOfSurface {
  double gas[2], solid[2];  // shares of the cells
  double transfer[2];       // momentum_per_area, kg/(m^2 s)

  double contact() const;       // share of the face
  double left_to_face() const;  // share of that contact, by what the cells hold of the surface
  // Share of the friction without slip, with spacing dx (m) and viscosity mu (Pa s):
  // 1/(1 + mu/(h dx)).
  double passes(double dx, double mu) const {
    const double h = gas[0] > gas[1] ? transfer[0] : transfer[1];
    return h * dx / (h * dx + mu);
  }
};

struct SurfaceInput {
  MaterialStates state;
  VariableId pure;
  VariableId surface;  // written

  static SurfaceInput of(const Variables& v) { return {MaterialStates::of(v), v.pure, v.surface}; }
};
void add_surface(TaskList&, const SurfaceInput&, const SchemeOptions&, int effect);
// The stress along faces where gas touches the solid and all move with one velocity: friction and
// slip one after the other.
// `raw`: the stress without slip, by axis.
void add_slip_of_friction(TaskList&, const FrictionInput&, const SchemeOptions&,
                          const std::array<VariableId, 3>& raw, int effect);

}  // namespace sluice::ice::mixture
