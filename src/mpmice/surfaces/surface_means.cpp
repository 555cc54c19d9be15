#include "mpmice/surfaces/surface_means.hpp"

#include <cmath>

#include "framework/base/reduction.hpp"

namespace sluice::mpmice {
namespace {

// -n.sigma.n of a particle.
template <int D>
double pressure_along(const Frame<D>& frame, const std::array<const double*, 6>& stress,
                      std::size_t p, const std::array<double, D>& n) {
  constexpr int at[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  double sum = 0;
  for (std::size_t a = 0; a < D; ++a)
    for (std::size_t b = 0; b < D; ++b)
      sum += n[a] * n[b] *
             stress[static_cast<std::size_t>(at[frame.direction[a]][frame.direction[b]])][p];
  return -sum;
}

}  // namespace

template <int D>
void SurfaceMeans<D>::find_wave_speeds(const Frame<D>& frame) {
  double least = 1e300;
  for (const int d : frame.direction) least = std::min(least, frame.spacing[d]);
  wave_.resize(solids_->kinds().size());
  for (std::size_t k = 0; k < wave_.size(); ++k)
    wave_[k] = solids_->wave_rate(static_cast<int>(k)) * least;
}

template <int D>
double SurfaceMeans<D>::compliance(const SolidSet<D>& s, std::size_t p) const {
  const auto k = static_cast<std::size_t>(s.kind);
  if (solids_->kinds()[k].rigid || !(wave_[k] > 0)) return 0.0;
  const double rho = s.set->column(static_cast<std::size_t>(s.columns->mass))[p] /
                     s.set->column(static_cast<std::size_t>(s.columns->volume))[p];
  return 1 / (rho * wave_[k]);
}

template <int D>
double SurfaceMeans<D>::inverse_density(const SolidSet<D>& s, std::size_t p) const {
  return compliance(s, p) * wave_[static_cast<std::size_t>(s.kind)];
}

// Of this rank's particles at surfaces.
template <int D>
typename SurfaceMeans<D>::Scales SurfaceMeans<D>::largest_of(const Frame<D>& frame,
                                                             const SolidSets<D>& sets) const {
  Scales most;
  const auto include = [&](double u) { most.velocity = std::max(most.velocity, std::fabs(u)); };
  for (const SolidSet<D>& s : sets.all()) {
    const bool prescribed = solids_->is_prescribed(s.kind);
    const auto stress = columns_from<6>(*s.set, s.columns->stress);
    for (const std::uint32_t p : s.faces.particle) {
      for (const int d : frame.direction)
        include(s.set->column(static_cast<std::size_t>(s.columns->velocity + d))[p]);
      for (int k = 0; k < (1 << D) && prescribed; ++k) {
        Vec3 corner = s.set->position(p);
        for (const int d : frame.direction)
          corner[d] = s.set->column(static_cast<std::size_t>(s.columns->corners + 3 * k + d))[p];
        const Vec3 v = solids_->prescribed_velocity(s.kind, corner);
        for (const int d : frame.direction) include(v[d]);
      }
      for (const double* e : stress) most.pressure = std::max(most.pressure, 3 * std::fabs(e[p]));
      most.compliance = std::max(most.compliance, compliance(s, p));
      most.inverse_density = std::max(most.inverse_density, inverse_density(s, p));
    }
  }
  return most;
}

template <int D>
double SurfaceMeans<D>::find_scales(const Frame<D>& frame, const SolidSets<D>& sets,
                                    double impedance, Communicator& ranks) {
  find_wave_speeds(frame);
  const Scales most = largest_of(frame, sets);
  Reduction all;
  const auto v = all.add_maximum(most.velocity), p = all.add_maximum(most.pressure),
             y = all.add_maximum(most.compliance), sparse = all.add_maximum(most.inverse_density),
             z = all.add_maximum(impedance);
  ranks.reduce(all);
  // Scales below 1 would win a few bits of what is small anyway.
  const auto at_least_one = [&](Reduction::Maximum of) { return std::max(1.0, all.maximum(of)); };
  scales_ = {at_least_one(v), at_least_one(p), at_least_one(y), at_least_one(sparse)};
  return all.maximum(z) * all.maximum(sparse);
}

template <int D>
void SurfaceMeans<D>::add(const NearCells<D>& near, const SolidSets<D>& sets) {
  sums_.begin(near.frame().cells, lane_count(viscous_));
  for (const SolidSet<D>& s : sets.all())
    add_in_ranges<D>(near.team(), s.pieces.size(), sums_,
                     [&](std::size_t begin, std::size_t end, std::size_t, CellSums<D>& sums) {
                       if (s.faces.size() > 0) add_pieces(near.frame(), s, begin, end, sums);
                     });
}

template <int D>
void SurfaceMeans<D>::add_pieces(const Frame<D>& frame, const SolidSet<D>& s, std::size_t begin,
                                 std::size_t end, CellSums<D>& sums) const {
  std::array<double, D> of_largest;
  for (std::size_t a = 0; a < D; ++a)
    of_largest[a] = frame.face_area(static_cast<int>(a)) / frame.largest_face();
  const auto stress = columns_from<6>(*s.set, s.columns->stress);
  const PieceVelocity<D> velocities(frame, *solids_, s);
  s.pieces.for_each(s.faces, begin, end, [&](std::size_t i, int, const Piece<D>& piece) {
    const std::size_t p = s.faces.particle[i], c = frame.cells.index_to_add(piece.cell);
    std::array<double, D> unit = piece.n;
    double size = 0;
    for (std::size_t a = 0; a < D; ++a) {
      unit[a] *= of_largest[a];
      size += unit[a] * unit[a];
    }
    size = std::sqrt(size);
    if (!(size > 0)) return;
    for (double& n : unit) n /= size;
    const double A = size * piece.s * s.faces.weight_of(i);
    sums.lane(area)[c] += to_sum(A);
    sums.lane(pressure)[c] +=
        to_sum(A * (pressure_along<D>(frame, stress, p, unit) / scales_.pressure));
    sums.lane(soft)[c] += to_sum(A * (compliance(s, p) / scales_.compliance));
    sums.lane(light)[c] += to_sum(A * (inverse_density(s, p) / scales_.inverse_density));
    const Vec3 u = velocities.at(i, piece);
    for (int a = 0; a < D; ++a)
      sums.lane(velocity + a)[c] +=
          to_sum(A * (u[frame.direction[static_cast<std::size_t>(a)]] / scales_.velocity));
    for (int a = 0; a < D && viscous_; ++a)
      sums.lane(place + a)[c] +=
          to_sum(size * s.faces.weight_of(i) * piece.arm[static_cast<std::size_t>(a)]);
  });
}

template <int D>
void SurfaceMeans<D>::finish(const Frame<D>& frame, OnSurfaces<D>& to) {
  for (int lane = 0; lane < sums_.lanes() && frame.sides().any(); ++lane)
    sums_.fold(frame.sides(), lane);
  sums_.values(area, to.area);
  const auto mean = [&](int lane, double factor, Column& of) {
    sums_.values(lane, of);
    for (std::size_t i = 0; i < of.size(); ++i)
      of[i] = to.area[i] > 0 ? of[i] / to.area[i] * factor : 0.0;
  };
  mean(pressure, scales_.pressure, to.pressure);
  mean(soft, scales_.compliance, to.compliance);
  mean(light, scales_.inverse_density, to.inverse_density);
  for (int a = 0; a < D; ++a)
    mean(velocity + a, scales_.velocity, to.velocity[static_cast<std::size_t>(a)]);
  for (int a = 0; a < D && viscous_; ++a) mean(place + a, 1, to.place[static_cast<std::size_t>(a)]);
}

template class SurfaceMeans<1>;
template class SurfaceMeans<2>;
template class SurfaceMeans<3>;

}  // namespace sluice::mpmice
