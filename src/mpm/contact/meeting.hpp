// The bodies that meet at one node, as rules of contact see them.
#pragma once
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice::mpm {

struct AtNode {
  int body = 0;        // local number of the material
  int member = 0;      // of the caller's list of bodies
  double mass = 0;     // M, kg, above 0
  Vec3 before{};       // v_i of the step, m/s
  Vec3 v{};            // as the rules leave it
  bool rigid = false;  // moves by itself: takes no impulse
  // With GIMP weights S of the particles' own widths, whatever the basis of the transfers:
  double volume = 0;  // sum V S, m^3; 0: the body does not reach the node
  Vec3 gradient{};    // N = sum V grad S, m^2: out of the body
  Vec3 place{};       // sum V (x_p - x_i) S / sum V S, m
};

// What acts from outside at a node: rigid bodies, and masters whose motion is prescribed.
struct OutsideBudget {
  Vec3 impulse{};   // on all bodies that are not rigid, N s
  double work = 0;  // J
  Vec3 reaction{};  // impulse of the others on masters of specified contacts, N s
  Vec3 torque{};    // of that, about the origin of the master's motion, N m s
};

struct ContactNode {
  Vec3 place{};            // of the node, m
  double cell_volume = 1;  // m^3
  std::vector<AtNode> bodies;
  OutsideBudget outside;

  AtNode* find(int body) {
    for (AtNode& b : bodies)
      if (b.body == body) return &b;
    return nullptr;
  }
};

}  // namespace sluice::mpm
