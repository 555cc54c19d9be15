// Images of points of other ranks, across periodic sides, mirrored at symmetric sides: who sends
// which of its points, found once for a layout of boxes, and their values whenever they change.
//
// An image stands at s X + o: s = 1 and o = +-L across a periodic side, s = -1 and o = 2 X_side at
// a mirror. Its vectors are s u, its numbers those of the point. Every number is the owner's, bit
// for bit.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/base/aligned_vector.hpp"
#include "framework/base/communicator.hpp"
#include "framework/base/vec3.hpp"
#include "framework/grid/level.hpp"
#include "framework/grid/side.hpp"

namespace sluice::peridynamics {

struct OwnPoint {
  Vec3 place{};
  double volume = 0;
  std::int64_t id = 0;
  int material = 0;
};

class Ghosts {
 public:
  struct Arrived {
    OwnPoint point;  // as the image stands
    int image = 0;
  };

  // The images within `reach` (m) of this rank's boxes. Collective.
  std::vector<Arrived> find(const Level& level, const std::vector<Side>& mirrors, double reach,
                            const std::vector<OwnPoint>& own, Communicator& ranks);
  // Where own points and arrived images stand in the columns.
  void place(const std::vector<int>& entry_of_own, const std::vector<int>& entry_of_arrived);

  bool any() const { return !arrived_.empty() || sends_; }
  // Collective: values of images are those of their points.
  void fill(std::span<double* const> columns);
  void fill_vector(const std::array<double*, 3>& vector);

 private:
  struct Image {
    Vec3 scale{1, 1, 1}, offset{};
  };
  struct Partner {
    int rank = 0;
    std::vector<int> own;    // to send: own points, afterwards their entries
    std::vector<int> image;  // of each
    std::vector<int> entry;  // received
    std::vector<int> image_here;
    std::vector<double> out, in;
  };
  void list_images(const Level& level, const std::vector<Side>& mirrors);
  void choose(const Level& level, double reach, const std::vector<OwnPoint>& own, int rank);
  void swap(int numbers);

  std::vector<Image> images_;
  std::vector<Partner> partners_;  // this rank itself among them
  std::vector<Arrived> arrived_;
  bool sends_ = false;
  int rank_ = 0;
};

}  // namespace sluice::peridynamics
