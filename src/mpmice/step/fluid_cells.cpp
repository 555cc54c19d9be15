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
