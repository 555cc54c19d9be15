// Faces of particles that have vanished: who shared one with them now has an outer face.
//
// Particles of a body share corners to the bit, so that faces are known by the places of their
// corners, in an order of their own.
#pragma once
#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "framework/base/communicator.hpp"
#include "mpmice/geometry/outer_faces.hpp"

namespace sluice::mpmice {

template <int D>
class VanishedFaces {
 public:
  // Of particle p of a body.
  void add(int body, const CornerColumns<D>& x, std::size_t p) {
    for (int face = 0; face < faces_of_particle<D>; ++face)
      keys_.push_back(key_of(body, x, p, face));
  }
  // Collective: then all ranks know all.
  void tell_all(Communicator& ranks) {
    std::string bytes(keys_.size() * sizeof(Key), '\0');
    if (!keys_.empty()) std::memcpy(bytes.data(), keys_.data(), bytes.size());
    keys_.clear();
    for (const std::string& of_rank : ranks.gather_to_all(bytes)) {
      const std::size_t before = keys_.size();
      keys_.resize(before + of_rank.size() / sizeof(Key));
      if (!of_rank.empty()) std::memcpy(keys_.data() + before, of_rank.data(), of_rank.size());
    }
    std::sort(keys_.begin(), keys_.end());
  }
  bool empty() const { return keys_.empty(); }
  // Bits of the faces of particle p of a body that are among them.
  std::uint8_t faces_of(int body, const CornerColumns<D>& x, std::size_t p) const {
    std::uint8_t bits = 0;
    for (int face = 0; face < faces_of_particle<D>; ++face)
      if (std::binary_search(keys_.begin(), keys_.end(), key_of(body, x, p, face)))
        bits = static_cast<std::uint8_t>(bits | (1 << face));
    return bits;
  }

 private:
  // The body, then the corners in rising order.
  using Key = std::array<double, 1 + D * corners_of_face<D>>;
  static Key key_of(int body, const CornerColumns<D>& x, std::size_t p, int face) {
    std::array<std::array<double, D>, corners_of_face<D>> corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (std::size_t d = 0; d < D; ++d)
        corners[k][d] = x[face_corners<D>[static_cast<std::size_t>(face)][k]][d][p];
    std::sort(corners.begin(), corners.end());
    Key key{};
    key[0] = body;
    for (std::size_t k = 0; k < corners.size(); ++k)
      std::copy(corners[k].begin(), corners[k].end(), key.begin() + 1 + static_cast<int>(k * D));
    return key;
  }
  std::vector<Key> keys_;
};

}  // namespace sluice::mpmice
