// Bodies from images.
#include "framework/geometry/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "framework/base/error.hpp"
#include "framework/base/packed_text.hpp"

namespace sluice {

namespace {

// Larger blocks of voxels are halved by who asks, rather than read whole each time.
constexpr std::int64_t max_voxels_to_read = 4096;

}  // namespace

ImagePiece::ImagePiece(std::string voxels, IntVec3 res, int least, int most, const Bounds& box)
    : voxels_(std::move(voxels)), res_(res), least_(least), most_(most), box_(box) {
  const double wanted = static_cast<double>(res.x) * res.y * res.z;
  if (res.x < 1 || res.y < 1 || res.z < 1 || static_cast<double>(voxels_.size()) != wanted)
    throw InputError(
        fmt::format("image: the file has {} bytes, but res [{}, {}, {}] needs {}, one per voxel",
                    voxels_.size(), res.x, res.y, res.z, wanted));
  if (least > most || least > 255 || most < 0)
    throw InputError(
        fmt::format("image: no grey value lies in the threshold [{}, {}]; values are "
                    "0 to 255",
                    least, most));
  for (int d = 0; d < 3; ++d)
    if (!(box.lower[d] < box.upper[d]))
      throw InputError(fmt::format("image: its box is empty in {}: {} to {}", "xyz"[d],
                                   box.lower[d], box.upper[d]));
}

int ImagePiece::voxel(int d, double x) const {
  const double at = (x - box_.lower[d]) / (box_.upper[d] - box_.lower[d]) * res_[d];
  return static_cast<int>(std::clamp(std::floor(at), 0.0, res_[d] - 1.0));
}

bool ImagePiece::in_range(int i, int j, int k) const {
  const std::size_t n = i + res_.x * (j + static_cast<std::size_t>(res_.y) * k);
  const int value = static_cast<unsigned char>(voxels_[n]);
  return value >= least_ && value <= most_;
}

bool ImagePiece::inside(Vec3 p) const {
  return box_.contains(p) && in_range(voxel(0, p.x), voxel(1, p.y), voxel(2, p.z));
}

Cover ImagePiece::cover(const Bounds& box) const {
  if (!box_.meets(box)) return Cover::none;
  // voxel() rounds monotonically: the voxels of a box lie between those of its corners.
  IntVec3 lower, upper;
  for (int d = 0; d < 3; ++d) {
    lower[d] = voxel(d, box.lower[d]);
    upper[d] = voxel(d, box.upper[d]) + 1;
  }
  const IntVec3 n = upper - lower;
  if (static_cast<std::int64_t>(n.x) * n.y * n.z > max_voxels_to_read) return Cover::some;
  bool any = false, every = true;
  for (int k = lower.z; k < upper.z; ++k)
    for (int j = lower.y; j < upper.y; ++j)
      for (int i = lower.x; i < upper.x; ++i) {
        const bool here = in_range(i, j, k);
        any = any || here;
        every = every && here;
      }
  if (!any) return Cover::none;
  return every && box_.contains(box) ? Cover::all : Cover::some;
}

PiecePtr read_image(const std::string& file, IntVec3 res, int least, int most, const Bounds& box) {
  if (!std::ifstream(file))
    throw InputError(
        fmt::format("geometry file '{}' cannot be opened ({})", file, std::strerror(errno)));
  return std::make_shared<ImagePiece>(unpacked_text(file, "geometry file"), res, least, most, box);
}

}  // namespace sluice
