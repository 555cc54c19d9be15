// Particles into the archive and back.
//
// Variables of one material and level list its particles in the same order, so that they are joined
// by their place; position and id are always among them.
#include "framework/run/particle_archive.hpp"

#include <fmt/format.h>

#include "framework/archive/archive.hpp"
#include "framework/archive/particle_table.hpp"
#include "framework/base/json.hpp"
#include "framework/run/particle_cloud.hpp"

namespace sluice {
namespace {

ConstRealView list_view(const std::vector<double>& values) {
  ConstRealView view;
  view.data = values.data();
  view.box = {{0, 0, 0}, {static_cast<int>(values.size()), 1, 1}};
  return view;
}

std::vector<std::vector<double>> read_values(const ArchiveStep& checkpoint, Label label,
                                             int material, int level) {
  const FieldInfo* info = checkpoint.find_particles(label.name(), material, level);
  if (info == nullptr)
    throw InputError(
        fmt::format("{} holds particles of material {} on level {} without {}: it "
                    "cannot be restarted with this deck",
                    checkpoint.folder().string(), material, level, label.name()));
  return checkpoint.read_particles(*info);
}

}  // namespace

const ParticleLabels& particle_labels() {
  static const ParticleLabels labels = {
      declare_label({particle_position_name, ValueType::vector, Centring::particle, "m",
                     "Position of a particle."}),
      declare_label({particle_id_name, ValueType::long_integer, Centring::particle, "1",
                     "Number of a particle that no other of its material ever has."})};
  return labels;
}

std::vector<Label> savable_labels(const ParticleMethod& method) {
  std::vector<Label> all = {particle_labels().position, particle_labels().id};
  for (const ParticleKind& kind : method.kinds())
    for (const Label label : kind.attributes)
      if (std::find(all.begin(), all.end(), label) == all.end()) all.push_back(label);
  return all;
}

std::vector<Label> ParticleCloud::labels() const {
  return savable_labels(*method_);
}

void ParticleCloud::add_pieces(const Wanted& wanted, ParticlePieces& to) const {
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const ParticleKind& kind = method_->kinds()[k];
    const ParticleStore& store = kinds_[k].store;
    for (int l = 0; l < store.level_count(); ++l) {
      const auto asked = [&](Label label) { return wanted(label, kind.material, l); };
      std::vector<std::size_t> attributes;
      for (std::size_t a = 0; a < kind.attributes.size(); ++a)
        if (asked(kind.attributes[a])) attributes.push_back(a);
      if (attributes.empty() && !asked(particle_labels().position) && !asked(particle_labels().id))
        continue;
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        if (set.empty()) continue;
        const auto add = [&](Label label, int component, const std::vector<double>& values) {
          FieldPiece piece;
          piece.label = label;
          piece.material = kind.material;
          piece.level = l;
          piece.box_id = store.box(l, b).id;
          piece.component = component;
          piece.view = list_view(values);
          piece.cells = piece.view.box;
          to.pieces.push_back(piece);
        };
        for (int d = 0; d < 3; ++d) add(particle_labels().position, d, set.coordinates(d));
        to.numbers.emplace_back(set.ids().begin(), set.ids().end());
        add(particle_labels().id, 0, to.numbers.back());
        for (const std::size_t a : attributes) add(kind.attributes[a], 0, set.attribute_values(a));
      }
    }
  }
}

void ParticleCloud::restore(const ArchiveStep& checkpoint, const Levels& levels) {
  const auto& kept = checkpoint.info().state;
  const auto found = kept.find("particles");
  const Json json = found == kept.end() ? Json() : Json::parse(found->second);
  if (!json.contains("kinds") || json.at("kinds").size() != kinds_.size())
    throw InputError(
        fmt::format("{} was written by a run with other particles: a restart goes on "
                    "with the same <TracerParticles>",
                    checkpoint.folder().string()));
  time_ = json.at("time").get<double>();
  lay_out(levels);
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    Kind& kind = kinds_[k];
    if (communicator_->is_root()) {
      kind.made = json.at("kinds").at(k).at("made").get<std::int64_t>();
      kind.left = json.at("kinds").at(k).at("left").get<std::int64_t>();
    }
    const ParticleKind& what = method_->kinds()[k];
    for (int l = 0; l < static_cast<int>(checkpoint.grid().levels.size()); ++l) {
      if (checkpoint.find_particles(particle_labels().position.name(), what.material, l) == nullptr)
        continue;
      const auto values = [&](Label label) {
        return read_values(checkpoint, label, what.material, l);
      };
      const auto x = values(particle_labels().position);
      const auto ids = values(particle_labels().id);
      std::vector<std::vector<double>> attributes;
      for (const Label label : what.attributes) attributes.push_back(values(label).front());
      ParticleSet one = kind.store.empty_set();
      for (std::size_t n = 0; n < ids[0].size(); ++n) {
        one.clear();
        one.add({x[0][n], x[1][n], x[2][n]}, static_cast<std::int64_t>(ids[0][n]));
        for (std::size_t a = 0; a < attributes.size(); ++a) one.attribute(a, 0) = attributes[a][n];
        kind.store.adopt(one, 0);
      }
    }
  }
  settle();
}

}  // namespace sluice
