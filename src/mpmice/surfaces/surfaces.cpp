#include "mpmice/surfaces/surfaces.hpp"

namespace sluice::mpmice {

template <int D>
void Surfaces<D>::begin(const NearCells<D>& near, SolidSets<D>& sets, const Warehouse& state,
                        int slot, Communicator& ranks) {
  geometry_.use(near.team());
  sets.find_faces(near, false, ranks);
  geometry_.begin_at_start(near.frame(), sets.all());
  previous_.gather(near.frame(), state, slot);
}

template <int D>
double Surfaces<D>::add_means(const NearCells<D>& near, const SolidSets<D>& sets, double impedance,
                              Communicator& ranks) {
  const double most = means_.find_scales(near.frame(), sets, impedance, ranks);
  means_.add(near, sets);
  return most;
}

template <int D>
void Surfaces<D>::finish(const NearCells<D>& near, const SolidSets<D>& sets, Communicator& ranks) {
  SolidInCells<D> found;
  geometry_.finish_at_start(near.frame(), sets.all(), &ranks, found);
  solid_.take_start(found);
  previous_.take(near, solid_.theta);
  means_.finish(near.frame(), on_);
}

template <int D>
void Surfaces<D>::find_moved(const NearCells<D>& near, SolidSets<D>& sets, Communicator& ranks) {
  sets.find_faces(near, true, ranks);
  SolidInCells<D> at_end;
  SweptVolumes<D> swept;
  geometry_.find_moved(near.frame(), sets.all(), ranks, at_end, swept);
  solid_.take_end(at_end);
  solid_.take_swept(swept);
  keep_open(near);
}

template <int D>
void Surfaces<D>::find_at_end(const NearCells<D>& near, SolidSets<D>& sets, Communicator& ranks) {
  sets.find_faces(near, true, ranks);
  SolidInCells<D> found;
  geometry_.find_at_end(near.frame(), sets.all(), ranks, found);
  solid_.take_end(found);
}

template <int D>
void Surfaces<D>::keep_open(const NearCells<D>& near) {
  keep_pockets(near, solid_);
  close_cells_at_sides(near, solid_);
}

template class Surfaces<1>;
template class Surfaces<2>;
template class Surfaces<3>;

}  // namespace sluice::mpmice
