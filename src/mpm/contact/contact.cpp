#include "mpm/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"

namespace sluice::mpm {
namespace {

bool by_master(const ContactRule& rule) {
  return rule.kind == ContactKind::specified || rule.kind == ContactKind::specified_friction;
}

bool slides(const ContactRule& rule) {
  return rule.kind == ContactKind::friction || rule.kind == ContactKind::specified_friction ||
         rule.normal_only;
}

// The largest among a material's objects, at most half a cell.
std::array<double, 3> half_widths(const SolidMaterial& material) {
  std::array<double, 3> half{};
  for (const SeedObject& o : material.forms())
    for (std::size_t d = 0; d < 3; ++d)
      half[d] = std::max(half[d], 0.5 * std::fabs(o.map[4 * d]) / o.per_cell[static_cast<int>(d)]);
  for (double& h : half) h = h > 0 ? std::min(h, 0.5) : 0.25;
  return half;
}

double mean_half(const std::array<double, 3>& half, const Level& level) {
  double sum = 0;
  int count = 0;
  for (std::size_t d = 0; d < 3; ++d)
    if (level.active[d]) {
      sum += half[d];
      ++count;
    }
  return count > 0 ? sum / count : 0.25;
}

}  // namespace

double friction_of(const ContactRule& rule, const MpmScene& scene) {
  if (rule.friction_of_colour.empty()) return rule.friction;
  const SolidMaterial& master = scene.materials[rule.master];
  std::optional<double> colour;
  for (const SeedObject& o : master.objects) {
    if (colour && *colour != o.colour)
      throw InputError(fmt::format(
          "{}: <variable_friction> where material {} has the colours {:g} and {:g}: friction that "
          "varies over one material is not supported yet; give each colour a separate material",
          to_string(rule.where), rule.master, *colour, o.colour));
    colour = o.colour;
  }
  const auto& list = rule.friction_of_colour;
  const double wanted = colour.value_or(0);
  return std::min_element(list.begin(), list.end(),
                          [&](const auto& a, const auto& b) {
                            return std::fabs(a.first - wanted) < std::fabs(b.first - wanted);
                          })
      ->second;
}

Contact::Contact(const MpmScene& scene, const Level& level)
    : scene_(&scene), spacing_(level.spacing) {
  const std::size_t count = scene.materials.size();
  taken_.assign(count, false);
  leads_.assign(count, false);
  joins_.assign(count, false);
  motion_.resize(count);
  for (const SolidMaterial& m : scene.materials) {
    halves_.push_back(half_widths(m));
    tables_.emplace_back(mean_half(halves_.back(), level));
  }
  for (const ContactRule& rule : scene.contacts) {
    friction_.push_back(friction_of(rule, scene));
    const bool full = rule.volume_constraint > 0;
    needs_surfaces_ = needs_surfaces_ || slides(rule) || full;
    for (std::size_t m = 0; m < count; ++m) {
      const int material = static_cast<int>(m);
      if (full || listed(rule, material) || rule.exclude == material) taken_[m] = true;
      if (rule.kind == ContactKind::single_velocity && listed(rule, material)) joins_[m] = true;
    }
    if (!by_master(rule)) continue;
    const std::size_t master = rule.master;
    taken_[master] = true;
    if (!scene.materials[master].rigid) leads_[master] = true;
  }
}

bool Contact::listed(const ContactRule& rule, int material) const {
  return rule.materials.empty() ||
         std::find(rule.materials.begin(), rule.materials.end(), material) !=
             rule.materials.end() ||
         (by_master(rule) && material == rule.master);
}

void Contact::begin_step(double time, double dt) {
  for (auto& m : motion_) m.reset();
  for (const ContactRule& rule : scene_->contacts)
    if (by_master(rule) && is_prescribed(rule, time, dt))
      motion_[rule.master] = motion_in_step(rule, time, dt);
}

const MasterMotion* Contact::motion_of(int material) const {
  const auto& m = motion_[material];
  return m ? &*m : nullptr;
}

// The bodies of a rule at a node; false: it does not act there.
bool Contact::gather(const ContactRule& rule, ContactNode& meeting,
                     std::vector<ContactBody>& parties) const {
  parties.clear();
  double filled = 0;
  for (AtNode& b : meeting.bodies) {
    filled += b.volume;
    if (rule.exclude == b.body) return false;
    if (!listed(rule, b.body)) continue;
    const std::size_t m = b.body;
    parties.push_back({&b, b.rigid, scene_->materials[m].may_give_normals, &tables_[m]});
  }
  return !(rule.volume_constraint > 0) || filled > rule.volume_constraint * meeting.cell_volume;
}

// A master takes its motion, or keeps the velocity that it had before forces; the others follow.
void Contact::lead(const ContactRule& rule, AtNode& master,
                   std::vector<ContactBody>& parties) const {
  for (ContactBody& p : parties)
    if (p.at == &master) p.held = true;
  const std::size_t r = &rule - scene_->contacts.data();
  if (slides(rule)) {
    slide(parties, {rule.normal_only ? 0.0 : friction_[r], scene_->colinear_normals, spacing_});
    return;
  }
  for (ContactBody& p : parties)
    for (int d = 0; d < 3 && !p.held; ++d)
      if (rule.directions[d] != 0) p.at->v[d] = master.v[d];
}

void Contact::act(const ContactRule& rule, ContactNode& meeting,
                  std::vector<ContactBody>& parties) const {
  if (!gather(rule, meeting, parties)) return;
  static thread_local std::vector<Vec3> old;
  old.clear();
  for (const ContactBody& p : parties) old.push_back(p.at->v);
  AtNode* master = nullptr;
  Vec3 outside_velocity{};
  if (by_master(rule)) {
    master = meeting.find(rule.master);
    if (master == nullptr) return;
    if (!master->rigid) {
      const MasterMotion* motion = motion_of(rule.master);
      master->v = motion != nullptr ? motion->at(meeting.place) : master->before;
    }
    lead(rule, *master, parties);
    outside_velocity = master->v;
  } else {
    if (parties.size() < 2) return;
    held_velocity(parties, outside_velocity);
    if (rule.kind == ContactKind::single_velocity) {
      stick(parties);
    } else {
      const std::size_t r = &rule - scene_->contacts.data();
      slide(parties, {friction_[r], scene_->colinear_normals, spacing_});
    }
  }
  const bool outside =
      std::any_of(parties.begin(), parties.end(), [](const ContactBody& p) { return p.held; });
  if (!outside) return;
  OutsideBudget& books = meeting.outside;
  const MasterMotion* motion = master != nullptr ? motion_of(rule.master) : nullptr;
  const Vec3 arm = meeting.place - (motion != nullptr ? motion->origin : Vec3{});
  for (std::size_t n = 0; n < parties.size(); ++n) {
    const AtNode& b = *parties[n].at;
    if (b.rigid) continue;
    const Vec3 impulse = b.mass * (b.v - old[n]);
    books.impulse += impulse;
    books.work += dot(impulse, outside_velocity);
    if (master == nullptr || &b == master) continue;
    books.reaction -= impulse;
    books.torque -= cross(arm, impulse);
  }
}

void Contact::act(Hook hook, ContactNode& meeting) const {
  static thread_local std::vector<ContactBody> parties;
  for (const ContactRule& rule : scene_->contacts)
    if (hook == Hook::after_forces || rule.applied_before_and_after_integration)
      act(rule, meeting, parties);
}

}  // namespace sluice::mpm
