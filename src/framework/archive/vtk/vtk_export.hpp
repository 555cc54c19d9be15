// Archives as files that ParaView and VisIt open: NAME.pvd over one .vti or .vtm an output.
//
// One level whose boxes fill a block becomes one image (.vti). Several levels become an image a box
// and, over these, a multi-block data set (.vtm, a block a level); cells below a finer level are
// marked in vtkGhostType as refined (not drawn) and as duplicates (not integrated). For filters
// that know AMR the same images, unmarked, can be put under an overlapping AMR data set instead
// (.vthb; NAME.vthb.series has their times): VTK marks cells itself as it loads levels. ParaView's
// reader of .vthb shows the coarsest level until it is asked for more.
//
// An array is called LABEL, or LABEL_MATERIAL when the archive holds the label for several
// materials. Particles of all levels become one set of points a material and output (.vtp), named
// by NAME_particles.pvd.
//
// Format: VTK's XML files, version 1.0, little endian, raw appended data compressed by zlib (VTK
// file formats, vtk.org/wp-content/uploads/2015/04/file-formats.pdf).
#pragma once
#include <filesystem>
#include <string>

#include "framework/archive/archive.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

struct ExportOptions {
  LabelFilter labels;
  std::string time;  // one output, as for extract; empty: all
  bool amr = false;  // several levels as .vthb
};

// Writes into `folder` (made when absent) and returns the file to open: the .pvd (that of particles
// where nothing else is asked for), or the series of .vthb. InputError where a step holds no label
// that was asked for, or with `amr` where directions are refined by different ratios.
std::filesystem::path export_vtk(const Archive& archive, const std::filesystem::path& folder,
                                 const ExportOptions& options);

}  // namespace sluice
