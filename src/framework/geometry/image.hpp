// The image piece: voxels of a file of bytes whose grey value lies between two thresholds. Points
// in m.
#pragma once
#include <string>

#include "framework/geometry/piece.hpp"

namespace sluice {

// `voxels`: one byte each, x fastest, then y; they fill the box from low corner to high corner. A
// voxel belongs to the piece where least <= value <= most; a point on the face of two voxels
// belongs to the upper one, on the box's own upper faces to the last.
class ImagePiece final : public GeometryPiece {
 public:
  // InputError when there are not res.x res.y res.z voxels, or the box or the range is empty.
  ImagePiece(std::string voxels, IntVec3 res, int least, int most, const Bounds& box);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return box_; }
  Cover cover(const Bounds& box) const override;

 private:
  int voxel(int direction, double x) const;
  bool in_range(int i, int j, int k) const;

  std::string voxels_;
  IntVec3 res_;
  int least_, most_;
  Bounds box_;
};

// Voxels of a file, gzipped or not. InputError where it cannot be opened, or as above.
PiecePtr read_image(const std::string& file, IntVec3 res, int least, int most, const Bounds& box);

}  // namespace sluice
