// Rules of contact at one node: bodies that stick, and bodies that slide with friction.
//
// Both conserve momentum to round-off for any number of bodies and never make energy. Bodies that
// are held (rigid, or with a prescribed motion) count as infinitely heavy.
#pragma once
#include <span>

#include "mpm/contact/meeting.hpp"
#include "mpm/contact/surface_table.hpp"

namespace sluice::mpm {

// One body in a rule.
struct ContactBody {
  AtNode* at = nullptr;
  bool held = false;                    // its velocity stays
  bool gives_normal = true;             // may its own surface be the one along which all slide
  const SurfaceTable* table = nullptr;  // of its particles' widths
};

struct Slip {
  double friction = 0;         // mu
  bool common_normals = true;  // the larger of a body's normal and that of the others
  Vec3 spacing{1, 1, 1};       // of nodes, m
};

// Surfaces nearer than this touch, in cells.
inline constexpr double touching_gap = 0.1;

// Velocity (m/s) of all that are held: their mean by mass. False: none is held.
bool held_velocity(std::span<const ContactBody> parties, Vec3& v);

// All take one velocity: v_cm = sum M v / sum M, or that of those that are held.
void stick(std::span<ContactBody> parties);

// What comes together is stopped along the normal, and held back along the surface by at most
// mu times that. Bodies that do not reach the node with GIMP weights take no part.
void slide(std::span<ContactBody> parties, const Slip& slip);

// Unit normal out of party m; false: there is none.
bool normal_of(std::span<const ContactBody> parties, std::size_t m, bool common, Vec3& normal);

// Distance between the surfaces of party m and of the others along the normal out of it, in cells;
// negative: they overlap.
double gap_of(std::span<const ContactBody> parties, std::size_t m, Vec3 normal, Vec3 spacing);

}  // namespace sluice::mpm
