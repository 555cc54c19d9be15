// Which materials turn lost energy of motion into heat: step/lost_energy.cpp.
#include <string>

#include "framework/deck/faults.hpp"
#include "mpm/deck/readers.hpp"

namespace sluice::mpm {

std::string without_losses(const MpmScene& s) {
  if (s.implicit) return "implicit steps";
  if (s.total_lagrangian) return "total Lagrangian steps";
  if (s.transfer == Transfer::xpic) return "the transfer xpic";
  if (!s.prescribed_file.empty()) return "a prescribed deformation";
  if (s.any_water()) return "pore water";
  return "";
}

void read_lost_energy(const DeckNode& root, MpmScene& s, std::vector<Fault>& faults) {
  const DeckNode* flags = root.child("MPM");
  const DeckNode* asked = flags != nullptr ? flags->child("lost_energy") : nullptr;
  const bool everywhere = asked != nullptr && asked->text == "heat";
  if (asked != nullptr && !everywhere) return;
  if (const std::string hindrance = without_losses(s); !hindrance.empty()) {
    if (everywhere) add_not_built(faults, asked->where, "<lost_energy> heat with " + hindrance);
    return;
  }
  for (SolidMaterial& m : s.materials) {
    if (m.rigid || m.law == nullptr || !(m.constants.specific_heat > 0)) continue;
    const bool shocks = m.law->has_shock_equation() || s.viscous();
    m.lost_energy_heats = everywhere || shocks;
  }
}

}  // namespace sluice::mpm
