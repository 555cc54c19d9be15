// The page of all labels that a deck may save, written from the labels' own declarations.
#pragma once
#include <string>

namespace sluice {

// Of all components and models; before a component is made, which claims its own.
void declare_all_labels();

// Markdown: one table for cells, faces, reductions and the conserved state of checkpoints.
std::string label_reference();

}  // namespace sluice
