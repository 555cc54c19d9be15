#include "mpm/loads/check_motions.hpp"

#include "framework/scene/deck_values.hpp"
#include "mpm/loads/insertions.hpp"
#include "mpm/loads/prescribed_motion.hpp"

namespace sluice::mpm {
namespace {

Location place_of(const DeckNode& root, const char* name) {
  const DeckNode* flags = root.child("MPM");
  const DeckNode* node = flags == nullptr ? nullptr : flags->child(name);
  return node == nullptr ? root.where : node->where;
}

}  // namespace

void check_motions(const DeckNode& root, const MpmScene& scene, std::vector<Fault>& faults) {
  if (!scene.prescribed_file.empty())
    collect(faults, place_of(root, "PrescribedDeformationFile"),
            [&] { PrescribedMotion::read(scene.prescribed_file); });
  if (!scene.insert_file.empty())
    collect(faults, place_of(root, "InsertParticlesFile"),
            [&] { read_insertions(scene.insert_file, static_cast<int>(scene.materials.size())); });
}

}  // namespace sluice::mpm
