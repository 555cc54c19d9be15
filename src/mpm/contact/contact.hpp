// The deck's rules of contact, in its order, on the bodies that meet at a node.
//
// They act twice: on the velocities that particles give to nodes (A), unless OneOrTwoStep is 1,
// and on those after forces (B): docs/theory/mpm_contact.md.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "framework/grid/level.hpp"
#include "mpm/contact/master_motion.hpp"
#include "mpm/contact/meeting.hpp"
#include "mpm/contact/node_rules.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

enum class Hook { before_forces, after_forces };

class Contact {
 public:
  // Keeps references.
  Contact(const MpmScene& scene, const Level& level);

  bool any() const { return !scene_->contacts.empty(); }
  // Is a material (local number) in some rule, or asked for by one.
  bool takes(int material) const { return taken_[material]; }
  // Does a rule ask for volumes, gradients and places of bodies at nodes.
  bool needs_surfaces() const { return needs_surfaces_; }
  // Does a rule act where this body is alone: a master that deforms.
  bool leads(int material) const { return leads_[material]; }
  // Does a rule give this body and others one velocity for good: single_velocity.
  bool joins(int material) const { return joins_[material]; }
  // Half widths of a material's particles in cells.
  const std::array<double, 3>& half(int material) const { return halves_[material]; }

  void begin_step(double time, double dt);  // s
  // The motion of a master in this step, where a rule prescribes it.
  const MasterMotion* motion_of(int material) const;

  // All rules on the velocities of a meeting; what acts from outside is added to its books.
  void act(Hook hook, ContactNode& meeting) const;

 private:
  void act(const ContactRule& rule, ContactNode& meeting, std::vector<ContactBody>& parties) const;
  bool gather(const ContactRule& rule, ContactNode& meeting,
              std::vector<ContactBody>& parties) const;
  void lead(const ContactRule& rule, AtNode& master, std::vector<ContactBody>& parties) const;
  bool listed(const ContactRule& rule, int material) const;

  const MpmScene* scene_;
  Vec3 spacing_;
  bool needs_surfaces_ = false;
  std::vector<bool> taken_, leads_, joins_;          // by material
  std::vector<std::array<double, 3>> halves_;        // by material
  std::vector<SurfaceTable> tables_;                 // by material
  std::vector<std::optional<MasterMotion>> motion_;  // by material, of this step
  std::vector<double> friction_;                     // by rule
};

// mu of a rule, without unit; InputError when it varies by colour and the master has several
// colours.
double friction_of(const ContactRule& rule, const MpmScene& scene);

}  // namespace sluice::mpm
