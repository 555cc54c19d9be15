#include "mpmice/step/fluid_cells.hpp"

#include "ice/fluid/labels.hpp"
#include "ice/fluid/law_row.hpp"

namespace sluice::mpmice {

FluidCells::FluidCells(const ice::FluidPart& of, const Warehouse& in) : part(&of), state(&in) {
  const ice::SchemeOptions& o = of.options();
  const ice::Labels& l = ice::labels();
  mass = in.find(l.mass, o.place(0));
  momentum = in.find(l.momentum, o.place(0));
  energy = in.find(l.energy, o.place(0));
  direction = o.direction;
  components = o.components;
}

WorkPressure::WorkPressure(const ice::FluidPart& part, const Warehouse& state, bool solved)
    : state_(&state) {
  const ice::SchemeOptions& o = part.options();
  if (!o.implicit) return;
  offset_ = state.find(ice::labels().pressure_offset, o.place(0));
  if (solved) increment_ = state.find(ice::labels().pressure_increment, o.place(0));
}

WorkPressure::Box WorkPressure::box(int b) const {
  Box box;
  if (offset_ >= 0) box.offset_ = state_->view(offset_, 0, b);
  if (increment_ >= 0) box.increment_ = state_->view(increment_, 0, b);
  return box;
}

FluidBox FluidCells::box(int b) const {
  return {*this, b};
}

FluidBox::FluidBox(const FluidCells& cells, int b)
    : cells_(&cells),
      mass_(cells.state->view(cells.mass, 0, b)),
      energy_(cells.state->view(cells.energy, 0, b)) {
  for (int c = 0; c < cells.components; ++c)
    momentum_[static_cast<std::size_t>(c)] = cells.state->view(cells.momentum, c, b);
}

FluidState FluidBox::at(IntVec3 cell) const {
  FluidState s;
  s.rho = mass_(cell);
  const double E = energy_(cell);
  double inverse = 0;
  const ice::LawRow law(cells_->part->options().fluids.front());
  law.primitives(1, &s.rho, &E, &inverse, &s.pressure, &s.sound);
  for (int c = 0; c < cells_->components; ++c)
    s.velocity[cells_->direction[static_cast<std::size_t>(c)]] =
        momentum_[static_cast<std::size_t>(c)](cell) * inverse;
  return s;
}

}  // namespace sluice::mpmice
