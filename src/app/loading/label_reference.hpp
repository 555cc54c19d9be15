// The page of all labels that a deck may save, written from the labels' own declarations.
#pragma once
#include <string>

namespace sluice {

// Markdown: one table for cells, faces, reductions and the conserved state of checkpoints.
std::string label_reference();

}  // namespace sluice
