#include "app/plan/best_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/loading/scene_loader.hpp"
#include "app/loading/sluice_schema.hpp"
#include "framework/deck/load_deck.hpp"

namespace sluice {
namespace {

std::string component_of(const DeckNode& root) {
  const DeckNode* named = root.find("SimulationComponent");
  return named == nullptr ? "" : named->attribute("type").value_or("");
}

bool is_flag(const DeckNode& mpm, const char* name) {
  const DeckNode* node = mpm.child(name);
  return node != nullptr && node->text == "true";
}

class Chooser {
 public:
  Chooser(const std::string& file, const std::vector<std::string>& overrides)
      : file_(file), given_(overrides), deck_(load_good_deck(file, overrides)) {}

  BestSettings choose() {
    const DeckNode* mpm = root().child("MPM");
    const std::string component = component_of(root());
    if (mpm == nullptr || component == "ice") return {{}, {"no solids: nothing to choose"}};
    if (root().child("CFD") != nullptr)
      return {{},
              {"solids beside a fluid move with carried corners: <interpolator> has no effect on "
               "how the fluid meets them; the studies know no better setting"}};
    if (mpm->child("time_integrator") != nullptr && mpm->string("time_integrator") == "implicit")
      return {{}, {"implicit steps: no study says that another basis is better"}};
    if (neither_touches_nor_breaks() && !is_flag(*mpm, "total_lagrangian") &&
        takes(total_lagrangian(),
              fmt::format(
                  "one body that neither touches nor breaks: total Lagrangian GIMP has 1/{:.0f} "
                  "of the error of GIMP and takes {:.1f} times as long (study axis_aligned)",
                  1 / total_lagrangian_gain.error, total_lagrangian_gain.time)))
      return std::move(found_);
    if (is_flag(*mpm, "total_lagrangian"))
      return {{}, {"total Lagrangian already: the best that the studies know"}};
    for (const char* basis : {"cpdi", "carried_corners"})
      if (takes(
              one_particle_with(basis),
              fmt::format("{} with one particle along each direction has 1/{:.0f} of the error of "
                          "GIMP with two and takes {:.1f} times as long (study axis_aligned)",
                          basis, 1 / corner_basis_gain.error, corner_basis_gain.time)))
        return std::move(found_);
    return {{}, {"none of the better settings goes with what else the deck has"}};
  }

 private:
  const DeckNode& root() const { return *deck_.root; }

  std::vector<const DeckNode*> solids() const {
    const DeckNode* block = root().find("MaterialProperties/MPM");
    return block == nullptr ? std::vector<const DeckNode*>{} : block->all("material");
  }

  // One material, in one piece, whose law knows no damage.
  bool neither_touches_nor_breaks() const {
    const auto materials = solids();
    if (materials.size() != 1 || materials[0]->all("geom_object").size() != 1) return false;
    for (const char* tag : {"damage_model", "erosion", "failure_criteria", "stability_check"})
      if (has_below(*materials[0], tag)) return false;
    return true;
  }

  static bool has_below(const DeckNode& node, const char* tag) {
    return std::any_of(node.children.begin(), node.children.end(), [&](const auto& child) {
      return (child->name == tag && !child->defaulted) || has_below(*child, tag);
    });
  }

  // Sets the particles along each direction that has several cells.
  std::vector<std::string> particles(int count) const {
    std::vector<std::string> overrides;
    const auto materials = solids();
    for (std::size_t m = 0; m < materials.size(); ++m) {
      const auto objects = materials[m]->all("geom_object");
      for (std::size_t o = 0; o < objects.size(); ++o) {
        const DeckNode* res = objects[o]->child("res");
        if (res == nullptr) continue;
        IntVec3 n = res->as_int_vector();
        for (int d = 0; d < 3; ++d) n[d] = n[d] > 1 || count == 1 ? count : n[d];
        overrides.push_back(
            fmt::format("MaterialProperties/MPM/material[{}]/geom_object[{}]/res=[{},{},{}]", m + 1,
                        o + 1, n.x, n.y, n.z));
      }
    }
    return overrides;
  }

  std::vector<std::string> one_particle_with(const char* basis) const {
    std::vector<std::string> overrides = {fmt::format("MPM/interpolator={}", basis)};
    for (std::string& one : particles(1)) overrides.push_back(std::move(one));
    return overrides;
  }

  std::vector<std::string> total_lagrangian() const {
    return {"MPM/interpolator=gimp", "MPM/total_lagrangian=true"};
  }

  // Are these accepted by the deck; then they are found.
  bool takes(std::vector<std::string> overrides, std::string reason) {
    std::vector<std::string> all = given_;
    all.insert(all.end(), overrides.begin(), overrides.end());
    const Deck tried = load_deck(file_, all, sluice_schema());
    if (!tried.good()) return false;
    const auto faults = scene_faults(tried);
    if (std::any_of(faults.begin(), faults.end(),
                    [](const Fault& f) { return f.severity == Severity::error; }))
      return false;
    found_ = {std::move(overrides), {std::move(reason)}};
    return true;
  }

  std::string file_;
  std::vector<std::string> given_;
  Deck deck_;
  BestSettings found_;
};

}  // namespace

BestSettings best_settings(const std::string& deck, const std::vector<std::string>& overrides) {
  return Chooser(deck, overrides).choose();
}

}  // namespace sluice
