// Archives as files that ParaView and VisIt open: NAME.pvd over one .vti or .vthb an output.
//
// One level whose boxes fill a block becomes one image (.vti); several levels become an overlapping
// AMR data set (.vthb) with an image a box, so that refined cells are blanked as they should be.
// Cell labels are cell data; node labels point data; a face label becomes two cell arrays, NAME_low
// and NAME_high, the values on the cell's two faces (nothing is averaged). An array is called
// LABEL, or LABEL_M when the step holds the label for several materials M.
//
// VTK's AMR takes one refinement ratio for all directions: a direction of one cell, which is not
// refined, is cut into thin copies of its cell on finer levels; unequal ratios are refused.
//
// Format: VTK's XML files, version 1.0, base64 inline, little endian (VTK file formats,
// vtk.org/wp-content/uploads/2015/04/file-formats.pdf).
#pragma once
#include <filesystem>
#include <string>

#include "framework/archive/archive.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

struct ExportOptions {
  LabelFilter labels;
  std::string time;  // one output, as for extract; empty: all
};

// Writes into `folder` (made when absent) and returns the .pvd file.
std::filesystem::path export_vtk(const Archive& archive, const std::filesystem::path& folder,
                                 const ExportOptions& options);

}  // namespace sluice
