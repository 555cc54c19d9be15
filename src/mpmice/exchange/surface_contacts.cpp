#include "mpmice/exchange/surface_contacts.hpp"

#include "mpmice/geometry/halving_plane.hpp"
#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice {
namespace {

constexpr double small_volume = 0.5;  // as in redistribute.cpp

template <int D>
class Contacts {
 public:
  Contacts(const Frame<D>& frame, const SolidGeometry<D>& solid, const CellAmounts<D>& fluid)
      : frame_(frame), solid_(solid), fluid_(fluid) {
    for (std::size_t d = 0; d < D; ++d) edge_[d] = frame.spacing[frame.direction[d]];
  }

  // False: there is no fluid in front of it.
  bool find(const Piece<D>& piece, SurfaceContact<D>& to) const {
    double area = 0;
    for (std::size_t d = 0; d < D; ++d) {
      to.normal[d] = piece.area[d] * frame_.face_area(static_cast<int>(d));
      area += to.normal[d] * to.normal[d];
    }
    area = std::sqrt(area);
    if (!(area > 0) || !(piece.s > 0)) return false;
    for (double& n : to.normal) n /= area;
    const Cell<D> c = frame_.wrapped(piece.cell);
    if (!frame_.in_domain(c)) return false;  // on a side of the domain
    to.area = area / frame_.cell_volume;
    to.width = width_across<D>(to.normal, edge_);
    for (std::size_t d = 0; d < D; ++d) to.place[d] = piece.cell[d] + piece.arm[d] / piece.s;
    return find_fluid(c, piece.cell, to);
  }

 private:
  bool holds_fluid(std::size_t i) const {
    return fluid_.near[i] != 0 && fluid_.volume[i] > 0 && fluid_.mass_of_all(i) > 0;
  }

  // `seen`: the same cell as the piece counts it, across periodic sides too.
  bool find_fluid(const Cell<D>& c, const Cell<D>& seen, SurfaceContact<D>& to) const {
    const std::size_t i = frame_.cells.index(c);
    const double V = fluid_.volume[i];
    to.fluid = i;
    if (!(V >= small_volume) && take_next(c, seen, to)) return true;
    if (!holds_fluid(i)) return false;
    to.to_fluid = V >= small_volume ? distance(seen, to) : 0.5 * V * to.width;
    return true;
  }

  // The cell before a small one, where it holds more.
  bool take_next(const Cell<D>& c, const Cell<D>& seen, SurfaceContact<D>& to) const {
    std::size_t along = 0;
    for (std::size_t d = 1; d < D; ++d)
      if (std::fabs(to.normal[d]) > std::fabs(to.normal[along])) along = d;
    const int step = to.normal[along] > 0 ? 1 : -1;
    Cell<D> next = c, next_seen = seen;
    next[along] += step;
    next_seen[along] += step;
    next = frame_.wrapped(next);
    if (!frame_.in_domain(next)) return false;
    const std::size_t i = frame_.cells.index(c), j = frame_.cells.index(next),
                      face = step > 0 ? frame_.cells.cell_above(i, static_cast<int>(along)) : i;
    const bool open = solid_.covered_next[along][face] < 1;
    if (!open || !holds_fluid(j) || !(fluid_.volume[j] > fluid_.volume[i])) return false;
    to.fluid = j;
    to.to_fluid = distance(next_seen, to);
    return true;
  }

  // From the piece to the centre of a cell along the normal.
  double distance(const Cell<D>& cell, const SurfaceContact<D>& to) const {
    double sum = 0;
    for (std::size_t d = 0; d < D; ++d)
      sum += to.normal[d] * edge_[d] * (cell[d] + 0.5 - to.place[d]);
    return std::max(sum, 0.0);
  }

  const Frame<D>& frame_;
  const SolidGeometry<D>& solid_;
  const CellAmounts<D>& fluid_;
  std::array<double, D> edge_{};
};

// Pieces of one face before the same cell are one contact, in the mean by area.
template <int D>
void join(KeptArray<SurfaceContact<D>>& all, std::size_t first, const SurfaceContact<D>& more) {
  for (std::size_t n = first; n < all.size(); ++n) {
    SurfaceContact<D>& to = all[n];
    if (to.fluid != more.fluid) continue;
    const double part = more.area / (to.area + more.area);
    const auto mean = [&](double& of, double other) { of += part * (other - of); };
    mean(to.width, more.width);
    mean(to.to_fluid, more.to_fluid);
    double size = 0;
    for (std::size_t d = 0; d < D; ++d) {
      mean(to.normal[d], more.normal[d]);
      mean(to.place[d], more.place[d]);
      size += to.normal[d] * to.normal[d];
    }
    for (double& n_d : to.normal) n_d /= std::sqrt(size);
    to.area += more.area;
    return;
  }
  all.push_back(more);
}

// Of faces begin to end - 1 of the n-th set.
template <int D>
KeptArray<SurfaceContact<D>> contacts_of(const Contacts<D>& contacts, const SolidSet<D>& s,
                                         std::size_t n, std::size_t begin, std::size_t end) {
  KeptArray<SurfaceContact<D>> found;
  std::size_t face = s.faces.size(), first = 0;  // the last one, and its first contact
  for_each_piece<D>(s.faces, When::end, begin, end, [&](std::size_t i, int, const Piece<D>& piece) {
    const std::uint32_t p = s.faces.particle[i];
    if (s.faces.is_inner(i) || (!s.filled.empty() && !(s.filled[p] > 0))) return;
    SurfaceContact<D> contact;
    contact.set = static_cast<std::uint32_t>(n);
    contact.particle = p;
    if (!contacts.find(piece, contact)) return;
    if (i != face) first = found.size();
    face = i;
    join(found, first, contact);
  });
  return found;
}

}  // namespace

template <int D>
KeptArray<SurfaceContact<D>> surface_contacts(const NearCells<D>& near,
                                              const SolidGeometry<D>& solid,
                                              const CellAmounts<D>& fluid,
                                              const std::vector<SolidSet<D>>& sets, int kind) {
  const Contacts<D> contacts(near.frame(), solid, fluid);
  KeptArray<SurfaceContact<D>> found;
  for (std::size_t n = 0; n < sets.size(); ++n) {
    const SolidSet<D>& s = sets[n];
    if (s.kind != kind) continue;
    std::vector<KeptArray<SurfaceContact<D>>> parts(range_count(near.team(), s.faces.size()));
    for_each_range(near.team(), s.faces.size(),
                   [&](std::size_t begin, std::size_t end, std::size_t range, int) {
                     parts[range] = contacts_of(contacts, s, n, begin, end);
                   });
    for (const auto& part : parts) found.insert(found.end(), part.begin(), part.end());
  }
  return found;
}

template KeptArray<SurfaceContact<1>> surface_contacts(const NearCells<1>&, const SolidGeometry<1>&,
                                                       const CellAmounts<1>&,
                                                       const std::vector<SolidSet<1>>&, int);
template KeptArray<SurfaceContact<2>> surface_contacts(const NearCells<2>&, const SolidGeometry<2>&,
                                                       const CellAmounts<2>&,
                                                       const std::vector<SolidSet<2>>&, int);
template KeptArray<SurfaceContact<3>> surface_contacts(const NearCells<3>&, const SolidGeometry<3>&,
                                                       const CellAmounts<3>&,
                                                       const std::vector<SolidSet<3>>&, int);

}  // namespace sluice::mpmice
