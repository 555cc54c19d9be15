// The points of a deck of Peridigm: text meshes and PdQuickGrid, and its node sets.
#pragma once
#include <vector>

#include "framework/deck/faults.hpp"
#include "peridynamics/peridigm/parameters.hpp"

namespace sluice::peridynamics {

struct MeshPoint {
  Vec3 place{};  // m
  int block = 1;
  double volume = 0;  // m^3
};

struct Mesh {
  std::vector<MeshPoint> points;  // point n has the number n + 1
  Vec3 cell{};                    // of PdQuickGrid: its edges; else 0
};

// `folder`: of the deck, where its files are.
Mesh read_mesh(const Parameter& discretization, const std::string& folder,
               std::vector<Fault>& faults);
// Numbers of points, from 1, of a node set: a list in the deck, or the name of a file of numbers.
std::vector<int> read_node_set(const Parameter& set, const std::string& folder, int points,
                               std::vector<Fault>& faults);
// Does some pair count as neighbours in PdQuickGrid, where a ball reaches cells, and not by the
// distance of their middles.
bool cells_reach_farther(const Mesh& mesh, double horizon);

// A number; a fault and 0 where it is none.
double number_of(const Parameter& p, std::vector<Fault>& faults);

}  // namespace sluice::peridynamics
