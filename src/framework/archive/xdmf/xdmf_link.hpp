// fields.xmf: an archive opened where it lies, by ParaView (XDMF Reader) and VisIt, without a copy.
//
// A collection over time; in it, for each output, the levels with one image per box, and the
// particles of each material. Every array is a range of a rank's file (a hyperslab of `values`);
// vectors and tensors, stored component after component, are joined from theirs. Cells below a
// finer level are marked in vtkGhostType, which lies in fields_covered.h5: they are neither drawn
// nor integrated. Labels on nodes and faces are left out: the boxes of an archive do not overlap,
// so that a box does not hold all values at its edges.
//
// Format: XDMF 2 (xdmf.org/index.php/XDMF_Model_and_Format).
#pragma once
#include <filesystem>

#include "framework/archive/archive.hpp"

namespace sluice {

// Writes fields.xmf, and fields_covered.h5 where there are several levels, into the archive, each
// replaced as a whole. Returns fields.xmf. InputError for a raw archive, or one without an output;
// DamageError where an output cannot be read.
std::filesystem::path write_xdmf_link(const Archive& archive);

}  // namespace sluice
