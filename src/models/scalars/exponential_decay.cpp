// The tag <exponentialDecay>, and tables of its coefficient.
#include "models/scalars/exponential_decay.hpp"

#include "framework/base/data_lines.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {

TagSpec exponential_decay_tag() {
  const auto c2 =
      tag("c2", "second coefficient")
          .once()
          .attribute(attribute("type", "constant: the same everywhere; variable: from a file")
                         .once()
                         .words({"constant", "variable"}))
          .with_children(
              {tag("value", "the coefficient")
                   .once()
                   .real()
                   .at_least(0)
                   .only_for("type", {"constant"}),
               tag("filename",
                   "a file with x, y, z and the coefficient in each line, for the cell of the "
                   "coarsest level that holds the point; other cells have 0")
                   .once()
                   .file()
                   .only_for("type", {"variable"})});
  return tag("exponentialDecay", "decay with exp(-(c1 c2 + c3) t)")
      .with_children(
          {tag("c1", "first coefficient").once().real().at_least(0), c2,
           tag("c3", "constant added to their product").real().by_default("0").unit("1/time")});
}

Decay read_decay(const DeckNode& scalar) {
  Decay d;
  const DeckNode* decay = scalar.child("exponentialDecay");
  if (decay == nullptr) return d;
  const DeckNode& c2 = *decay->child("c2");
  d.any = true;
  d.where = c2.where;
  d.c1 = decay->real("c1");
  if (const DeckNode* file = c2.child("filename"))
    d.file = file->text;
  else
    d.c2 = c2.real("value");
  d.c3 = real_or(*decay, "c3", 0);
  return d;
}

void read_field(Decay& decay, const Level& coarsest, std::vector<Fault>& faults) {
  if (decay.file.empty()) return;
  collect(faults, decay.where,
          [&] { decay.field = std::make_shared<const CellNumbers>(coarsest, decay.file); });
}

CellNumbers::CellNumbers(const Level& level, const std::string& file) {
  size_ = level.domain.size();
  std::size_t cells = 1;
  for (int d = 0; d < 3; ++d) {
    low_[d] = level.anchor[d] + level.domain.lower[d] * level.spacing[d];
    inverse_[d] = 1 / level.spacing[d];
    cells *= size_[d];
  }
  values_.assign(cells, 0.0);
  std::vector<int> points(cells, 0);
  read_table(file, {"x", "y", "z", "coefficient"}, [&](const TableRow& v) {
    std::size_t n = 0;
    for (int d = 2; d >= 0; --d) {
      const double i = std::floor((v[d] - low_[d]) * inverse_[d]);
      if (!(i >= 0 && i < size_[d])) return;  // beyond the domain
      n = n * size_[d] + static_cast<std::size_t>(i);
    }
    values_[n] += v[3];
    ++points[n];
  });
  for (std::size_t n = 0; n < cells; ++n)
    if (points[n] > 1) values_[n] /= points[n];
}

}  // namespace sluice::models
