// Faces of particles that have vanished: who shared one with them now has an outer face, and takes
// over what the surface there remembers.
//
// Particles of a body share corners to the bit, so that faces are known by the places of their
// corners, in an order of their own; across periodic sides they differ by exactly the period.
#pragma once
#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>
#include <vector>

#include "models/burn/burn_law.hpp"
#include "mpmice/geometry/block_sharers.hpp"
#include "mpmice/geometry/outer_faces.hpp"

namespace sluice::mpmice {

// Periodic directions: where the domain begins and its length (m), which is 0 in the others.
template <int D>
struct Periods {
  std::array<double, D> low{}, length{};
};

template <int D>
class VanishedFaces {
 public:
  explicit VanishedFaces(const Periods<D>& periods = {}) : periods_(periods) {}
  // Of particle p of a body, whose surface remembered this.
  void add(int body, const CornerColumns<D>& x, std::size_t p,
           const models::SurfaceHistory& surface = {}) {
    for (int face = 0; face < faces_of_particle<D>; ++face)
      faces_.push_back({key_of(body, x, p, face), surface});
  }
  // Collective among neighbours (null: there are none): then those that share cells know them.
  void tell_neighbours(const BlockSharers<D>* sharers) {
    if (sharers != nullptr) {
      std::vector<double> mine(faces_.size() * numbers);
      for (std::size_t n = 0; n < faces_.size(); ++n)
        std::memcpy(mine.data() + n * numbers, &faces_[n], sizeof(Face));
      const typename BlockSharers<D>::Buffers out(sharers->neighbour_count(), mine);
      typename BlockSharers<D>::Buffers in;
      sharers->swap(out, in);
      for (const std::vector<double>& from : in)
        for (std::size_t at = 0; at < from.size(); at += numbers)
          std::memcpy(static_cast<void*>(&faces_.emplace_back()), from.data() + at, sizeof(Face));
    }
    std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) {
      return std::tie(a.key, a.surface.temperature, a.surface.gradient) <
             std::tie(b.key, b.surface.temperature, b.surface.gradient);
    });
  }
  bool empty() const { return faces_.empty(); }
  struct Exposed {
    std::uint8_t faces = 0;  // bits
    // Of the vanished neighbour with the steepest gradient; unlit: none has burned by such a law.
    models::SurfaceHistory surface;
  };
  // What particle p of a body shared with them.
  Exposed exposed(int body, const CornerColumns<D>& x, std::size_t p) const {
    Exposed to;
    for (int face = 0; face < faces_of_particle<D>; ++face) {
      const Key key = key_of(body, x, p, face);
      const auto found = std::lower_bound(faces_.begin(), faces_.end(), key,
                                          [](const Face& f, const Key& k) { return f.key < k; });
      if (found == faces_.end() || found->key != key) continue;
      to.faces = static_cast<std::uint8_t>(to.faces | (1 << face));
      if (found->surface.lit() && (!to.surface.lit() || steeper(found->surface, to.surface)))
        to.surface = found->surface;
    }
    return to;
  }

 private:
  // The body, then the corners in rising order.
  using Key = std::array<double, 1 + D * corners_of_face<D>>;
  struct Face {
    Key key;
    models::SurfaceHistory surface;
  };
  static constexpr std::size_t numbers = sizeof(Face) / sizeof(double);
  static_assert(sizeof(Face) % sizeof(double) == 0);
  static bool steeper(const models::SurfaceHistory& a, const models::SurfaceHistory& b) {
    return std::array{a.gradient, a.temperature} > std::array{b.gradient, b.temperature};
  }
  Key key_of(int body, const CornerColumns<D>& x, std::size_t p, int face) const {
    std::array<std::array<double, D>, corners_of_face<D>> corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (std::size_t d = 0; d < D; ++d) corners[k][d] = x[face_corners<D>[face][k]][d][p];
    for (std::size_t d = 0; d < D; ++d) {
      const double length = periods_.length[d];
      if (length == 0) continue;
      double least = corners[0][d];
      for (const auto& corner : corners) least = std::min(least, corner[d]);
      // Sums of corners and periods are exact.
      double turned = 0;
      while (least + turned < periods_.low[d]) turned += length;
      while (least + turned >= periods_.low[d] + length) turned -= length;
      for (auto& corner : corners) corner[d] += turned;
    }
    std::sort(corners.begin(), corners.end());
    Key key{};
    key[0] = body;
    for (std::size_t k = 0; k < corners.size(); ++k)
      std::copy(corners[k].begin(), corners[k].end(), key.begin() + 1 + static_cast<int>(k * D));
    return key;
  }
  Periods<D> periods_;
  std::vector<Face> faces_;
};

}  // namespace sluice::mpmice
