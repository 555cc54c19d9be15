#include "mpmice/fields/fluid_cells.hpp"

#include <cmath>

#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

FluidCells::FluidCells(const ice::FluidPart& of, const Warehouse& in)
    : part(&of), state(&in), laws(of.options().materials.fluids) {
  const ice::SchemeOptions& o = of.options();
  const ice::Labels& l = ice::labels();
  for (int m = 0; m < of.material_count(); ++m) {
    mass.push_back(in.find(l.mass, o.place(m)));
    energy.push_back(in.find(l.energy, o.place(m)));
    if (of.material_count() > 1) volume.push_back(in.find(l.volume, o.place(m)));
    if (o.materials.multi_velocity) slip.push_back(in.find(l.slip, o.place(m)));
  }
  for (const models::TransportedScalar& s : o.materials.scalars) {
    scalar.push_back(in.find(s.state(), o.place(s.material)));
    carrier.push_back(static_cast<std::size_t>(s.material));
  }
  momentum = in.find(l.momentum, o.place(0));
  fraction = in.find(l.solid_fraction, o.place(0));
  direction = o.grid.direction;
  components = o.grid.components;
}

WorkPressure::WorkPressure(const ice::FluidPart& part, const Warehouse& state, bool solved)
    : state_(&state) {
  const ice::SchemeOptions& o = part.options();
  if (!o.scheme.implicit) return;
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
    : cells_(&cells), fraction_(cells.state->view(cells.fraction, 0, b)) {
  for (const int slot : cells.mass) mass_.push_back(cells.state->view(slot, 0, b));
  for (const int slot : cells.energy) energy_.push_back(cells.state->view(slot, 0, b));
  for (const int slot : cells.volume) volume_.push_back(cells.state->view(slot, 0, b));
  for (const int slot : cells.scalar) scalar_.push_back(cells.state->view(slot, 0, b));
  for (int c = 0; c < cells.components; ++c)
    momentum_[static_cast<std::size_t>(c)] = cells.state->view(cells.momentum, c, b);
  for (const int slot : cells.slip) {
    auto& of_material = slip_.emplace_back();
    for (int c = 0; c < cells.components; ++c)
      of_material[static_cast<std::size_t>(c)] = cells.state->view(slot, c, b);
  }
}

double FluidBox::energy_of_slip(IntVec3 cell) const {
  double sum = 0;
  for (std::size_t m = 0; m < slip_.size(); ++m) {
    const double M = mass_[m](cell);
    double squares[3] = {0, 0, 0};
    for (int c = 0; c < cells_->components; ++c) {
      const double S = slip_[m][static_cast<std::size_t>(c)](cell);
      squares[c] = S * S;
    }
    if (M > 0) sum += 0.5 / M * ((squares[0] + squares[1]) + squares[2]);
  }
  return sum;
}

void FluidBox::bind(IntVec3 cell) const {
  for (const auto& of_material : slip_)
    for (int c = 0; c < cells_->components; ++c)
      of_material[static_cast<std::size_t>(c)](cell) = 0.0;
}

FluidState FluidBox::at(IntVec3 cell) const {
  FluidState s = cells_->materials() == 1 ? of_one(cell) : of_several(cell);
  for (int c = 0; c < cells_->components; ++c)
    s.velocity[cells_->direction[static_cast<std::size_t>(c)]] = momentum(c, cell) / s.rho;
  return s;
}

double FluidBox::viscosity(IntVec3 c) const {
  const ice::SchemeOptions& o = cells_->part->options();
  double sum = 0;
  for (int m = 0; m < cells_->materials(); ++m) {
    const auto k = static_cast<std::size_t>(m);
    const double V = cells_->volume.empty() ? 1.0 : volume(m, c);
    if (!(V > 0)) continue;
    const auto& law =
        (cells_->materials() == 1 ? o.transport.models : o.transport.models_of_each[k]).sutherland;
    sum +=
        V *
        (law ? law->viscosity(o.materials.fluids[k].temperature(mass(m, c) / V, energy(m, c) / V))
             : o.transport.viscosities[k]);
  }
  return sum;
}

FluidState FluidBox::of_one(IntVec3 cell) const {
  const ice::Fluid& law = cells_->part->options().materials.fluids.front();
  FluidState s;
  s.rho = mass(0, cell);
  s.pressure = law.pressure(s.rho, energy(0, cell));
  s.sound = law.sound_speed(s.rho, s.pressure);
  return s;
}

FluidState FluidBox::of_several(IntVec3 cell) const {
  double M[ice::max_materials], V[ice::max_materials], E[ice::max_materials];
  for (int m = 0; m < cells_->materials(); ++m) {
    M[m] = mass(m, cell);
    V[m] = cells_->volume.empty() ? 1.0 : volume(m, cell);
    E[m] = energy(m, cell);
  }
  const ice::mixture::Equilibration::Result as_it_is = cells_->laws.look({M, V, E});
  FluidState s;
  for (int m = 0; m < cells_->materials(); ++m) s.rho += M[m];
  s.pressure = as_it_is.pressure;
  s.sound = std::sqrt(as_it_is.modulus / s.rho);
  return s;
}

}  // namespace sluice::mpmice
