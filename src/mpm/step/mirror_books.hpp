// Impulse of mirrors on particles whose shape functions reach beyond them.
//
// The sums of an image i' join those of its node i with the normal component turned round, and the
// image gets the node's change of velocity likewise. Along the normal particles therefore take
// (M_i - M_i') dv_i where the node has (M_i + M_i') dv_i, and f_i - f_i' acts where f_i + f_i' sums
// up to nothing. The mirror gives the difference, -2 (dk f_i' + M_i' dv_i).
#pragma once
#include "mpm/step/body.hpp"
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/node_step.hpp"
#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {

// Of forces in a block whose lanes are M, v_i | f.
void book_mirrored_forces(const LevelNodes& nodes, const Body& body, BlockMember of, double kick,
                          NodeBooks& books);
// Of the changes of velocity that lanes of a body hold after the step on nodes, before images get
// the velocities of their nodes.
void book_mirrored_changes(const LevelNodes& nodes, const Body& body, int m, const NodeLanes& of,
                           NodeBooks& books);

}  // namespace sluice::mpm
