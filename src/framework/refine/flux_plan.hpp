// The plan of a flux register: which faces of two levels meet, and where this rank keeps them.
#pragma once
#include <array>
#include <vector>

#include "framework/refine/face_fold.hpp"
#include "framework/refine/face_table.hpp"
#include "framework/refine/interface_patches.hpp"

namespace sluice {

using BySide = std::array<double, 6>;  // side of a cell: 2 * axis + (high ? 1 : 0)

// One patch as this rank sees it; box numbers and first slots are -1 where another rank has them.
struct FluxPatch {
  int side = 0;  // of the coarse cells
  int fine_box = -1, coarse_box = -1;
  IndexBox coarse_cells, fine_cells;
  std::ptrdiff_t fine_slot = -1;    // in the table of fine faces
  std::ptrdiff_t sum_slot = -1;     // of the sums over fine faces, one a coarse face
  std::ptrdiff_t coarse_slot = -1;  // in the table of coarse faces, and of the changes
  FaceFold fold;

  std::size_t faces() const { return coarse_cells.volume(); }
};

// A face of a cell, and where its values are.
struct CellFace {
  IntVec3 cell;
  int side = 0;
  std::ptrdiff_t slot = 0;
};

// Cells, each once, with the slots of their faces by side; -1: none.
struct CellFaces {
  std::vector<IntVec3> cells;
  std::vector<std::array<std::ptrdiff_t, 6>> slots;

  void resize(std::size_t count) {
    cells.resize(count);
    slots.resize(count);
  }
};

// Takes faces in any order; sorts them.
CellFaces by_cell(std::vector<CellFace>& faces);

// Patches shared with one other rank: the fine cells here and the coarse ones there, and the
// opposite.
struct FluxPeer {
  int rank = 0;
  std::vector<std::size_t> fine_here, coarse_here;
  std::vector<double> fine_buffer, coarse_buffer;  // values as in FaceTable
};

struct FluxPlan {
  FluxPlan(const Level& coarse, const Level& fine, int quantity_count, int rank);

  bool nothing = true;  // no finer level, or no quantities: known on all ranks
  std::size_t quantities = 0;
  IndexBox domain;  // of the coarse level
  FaceTable coarse_faces, fine_faces;
  std::vector<FluxPatch> patches;
  std::vector<FluxPeer> peers;
  std::size_t sum_count = 0;            // coarse faces whose fine cells are here
  double volume_ratio = 1;              // ratio of a fine cell to a coarse cell
  BySide back{};                        // ratio: coarse volume over that of fine cells at a face
  std::vector<CellFaces> coarse_cells;  // by local box
  std::size_t fine_boxes = 0;           // local ones

 private:
  struct LocalBoxes;
  class RowFaces;
  void add_patch(const InterfacePatch& found, const LocalBoxes& coarse, const LocalBoxes& fine,
                 IntVec3 faces_each);
  void add_peers(const Level& coarse, const Level& fine, int rank,
                 const std::vector<InterfacePatch>& found);
  void list_cells(const std::vector<GridBox>& boxes, const Axes& axes);
};

}  // namespace sluice
