// What a run hands to the archive: views of fields, and what to write of them.
#pragma once
#include <cstdint>

#include "framework/field/array_view.hpp"
#include "framework/field/label.hpp"

namespace sluice {

// One component of one label and material on one box. Exactly `cells` is written, so ghost cells
// stay behind; a face label's piece includes the closing layer on the high side only where the
// caller says so (at the domain's end), so that pieces do not overlap.
struct FieldPiece {
  Label label;
  int material = 0;
  int level = 0;
  int box_id = 0;
  int component = 0;
  IndexBox cells;
  ConstRealView view;
  bool gzip = false;  // HDF5's deflate; of all pieces of one label, material and level or of none
};

}  // namespace sluice
