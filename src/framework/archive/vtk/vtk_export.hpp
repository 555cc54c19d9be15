// Archives as files that ParaView and VisIt open: NAME.pvd over one .vti or .vtm an output.
//
// One level whose boxes fill a block becomes one image (.vti). Several levels become an image a box
// and, over these, a multi-block data set (.vtm, a block a level; it is what the .pvd names) and an
// overlapping AMR data set (.vthb, for filters that know AMR; NAME.vthb.series has their times).
// ParaView's reader of .vthb shows the coarsest level until it is asked for more, which nobody can
// do through a .pvd; of a .vtm it shows all. There cells below a finer level are marked in
// vtkGhostType as refined (not drawn) and as duplicates (not integrated).
//
// Cell labels are cell data; node labels point data; a face label becomes two cell arrays, NAME_low
// and NAME_high, the values on the cell's two faces (nothing is averaged). An array is called
// LABEL, or LABEL_M when the step holds the label for several materials M.
//
// Particles of all levels become one set of points a material and output (.vtp), named by
// NAME_particles.pvd.
//
// VTK's AMR takes one refinement ratio for all directions: a direction of one cell, which is not
// refined, is cut into thin copies of its cell on finer levels. With unequal ratios there is no
// .vthb and no copy.
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

// Writes into `folder` (made when absent) and returns the .pvd file (that of particles where
// nothing else is asked for). InputError where a step holds no label that was asked for.
std::filesystem::path export_vtk(const Archive& archive, const std::filesystem::path& folder,
                                 const ExportOptions& options);

}  // namespace sluice
