// Particles into the archive and back.
//
// Variables of one material and level list its particles in the same order, so that they are joined
// by their place; position and id are always among them.
#include "framework/run/levels/particle_archive.hpp"

#include <fmt/format.h>

#include "framework/archive/archive.hpp"
#include "framework/base/json.hpp"
#include "framework/run/levels/particle_cloud.hpp"

namespace sluice {
namespace {

std::vector<Label> labels_of(const ParticleKind& kind) {
  std::vector<Label> labels;
  for (const ParticleAttribute& a : kind.attributes) labels.push_back(a.label);
  for (const DerivedAttribute& d : kind.derived) labels.push_back(d.label);
  if (kind.present) labels.push_back(kind.home);
  return labels;
}

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
        fmt::format("{} contains particles of material {} on level {} without {}: it cannot be "
                    "restarted with this deck",
                    checkpoint.folder().string(), material, level, label.name()));
  return checkpoint.read_particles(*info);
}

}  // namespace

std::size_t column_of_component(const ParticleAttribute& a, int component) {
  constexpr std::size_t of_symmetric[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
  const std::size_t c = component;
  return a.symmetric ? of_symmetric[c] : c;
}

std::vector<Label> savable_labels(const ParticleMethod& method) {
  std::vector<Label> all = {particle_labels().position, particle_labels().id};
  for (const ParticleKind& kind : method.kinds())
    for (const Label label : labels_of(kind))
      if (std::find(all.begin(), all.end(), label) == all.end()) all.push_back(label);
  return all;
}

std::vector<Label> ParticleCloud::labels() const {
  return savable_labels(*method_);
}

namespace {

// Columns of the particles of a box as pieces, in the order in which archives list them.
class BoxPieces {
 public:
  BoxPieces(FieldPiece place, const ParticleStore& store, int local, ParticlePieces& to)
      : place_(std::move(place)), set_(&store.set(place_.level, local)), to_(&to) {
    if (store.by_blocks()) order_ = store.order_by_cell(place_.level, local);
  }

  void add(Label label, int component, const std::vector<double>& values) {
    FieldPiece piece = place_;
    piece.label = label;
    piece.component = component;
    piece.view = list_view(order_.empty() ? values : sorted(values));
    piece.cells = piece.view.box;
    to_->pieces.push_back(piece);
  }
  void add_own(Label label, int component, std::vector<double> values) {
    to_->numbers.push_back(std::move(values));
    add(label, component, to_->numbers.back());
  }
  // `column`: the first of the attribute.
  void add_attribute(const ParticleAttribute& a, std::size_t column) {
    for (int c = 0; c < component_count(a.label.info().type); ++c)
      add(a.label, c, set_->attribute_values(column + column_of_component(a, c)));
  }
  void add_derived(const DerivedAttribute& d) {
    const std::size_t components = component_count(d.label.info().type);
    std::vector<std::vector<double>> columns(components, std::vector<double>(set_->size()));
    d.compute(*set_, columns);
    for (std::size_t c = 0; c < components; ++c)
      add_own(d.label, static_cast<int>(c), std::move(columns[c]));
  }

 private:
  const std::vector<double>& sorted(const std::vector<double>& values) {
    std::vector<double>& to = to_->numbers.emplace_back();
    to.reserve(values.size());
    for (const std::uint32_t n : order_) to.push_back(values[n]);
    return to;
  }

  FieldPiece place_;
  const ParticleSet* set_;
  ParticlePieces* to_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

void ParticleCloud::add_pieces(const Wanted& wanted, ParticlePieces& to) const {
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const ParticleKind& kind = method_->kinds()[k];
    const ParticleStore& store = kinds_[k].store;
    for (int l = 0; l < store.level_count(); ++l) {
      const auto asked = [&](Label label) { return wanted(label, kind.material, l); };
      const std::vector<Label> labels = labels_of(kind);
      if (std::none_of(labels.begin(), labels.end(), asked) && !asked(particle_labels().position) &&
          !asked(particle_labels().id))
        continue;
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        if (set.empty()) continue;
        FieldPiece place;
        place.material = kind.material;
        place.level = l;
        place.box_id = store.box(l, b).id;
        BoxPieces pieces(place, store, b, to);
        const Label home = kind.present ? kind.home : particle_labels().position;
        for (int d = 0; d < 3; ++d) pieces.add(home, d, set.coordinates(d));
        if (kind.present) pieces.add_derived(*kind.present);
        pieces.add_own(particle_labels().id, 0, {set.ids().begin(), set.ids().end()});
        std::size_t column = 0;
        for (const ParticleAttribute& a : kind.attributes) {
          if (asked(a.label)) pieces.add_attribute(a, column);
          column += a.columns();
        }
        for (const DerivedAttribute& d : kind.derived)
          if (asked(d.label)) pieces.add_derived(d);
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
        fmt::format("{} was written by a run with other particles: a restart continues with the "
                    "same materials and <TracerParticles>",
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
      const auto x = values(what.present ? what.home : particle_labels().position);
      const auto ids = values(particle_labels().id);
      std::vector<std::vector<double>> attributes;  // columns
      for (const ParticleAttribute& a : what.attributes) {
        std::vector<std::vector<double>> all = values(a.label);
        const std::size_t first = attributes.size();
        attributes.resize(first + a.columns());
        for (std::size_t c = 0; c < all.size(); ++c)
          attributes[first + column_of_component(a, static_cast<int>(c))] = std::move(all[c]);
      }
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
  method_->laid_out(*this, levels.front()->team());
}

}  // namespace sluice
