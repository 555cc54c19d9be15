// Labels: typed handles of variables, compared by a small integer.
//
// A label is declared once at start-up with everything users see of it: name as in a deck's <save>,
// value type, centring, unit and definition. The table of labels in docs/ is generated from here.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

enum class Centring { cell, node, x_face, y_face, z_face, particle, reduction };
// vector: three reals, stored as three arrays; long_integer: 64 bits, of which 53 are used.
// tensor: nine reals, row after row.
enum class ValueType { real, vector, integer, long_integer, tensor };

std::string_view name_of(Centring);
std::string_view name_of(ValueType);
constexpr int component_count(ValueType t) {
  return t == ValueType::vector ? 3 : t == ValueType::tensor ? 9 : 1;
}
// The direction normal to a face-centred label, or -1.
constexpr int face_direction(Centring c) {
  return c == Centring::x_face ? 0 : c == Centring::y_face ? 1 : c == Centring::z_face ? 2 : -1;
}
// Fields are kept by cell: a face by the cell above it, a node by the cell of which it is the low
// corner. So a box of cells has more layers of values on its high sides: 1 where that closes it.
constexpr IntVec3 closing_layers(Centring c) {
  if (c == Centring::node) return {1, 1, 1};
  IntVec3 layers{};
  if (const int d = face_direction(c); d >= 0) layers[d] = 1;
  return layers;
}

struct LabelInfo {
  std::string name;
  ValueType type = ValueType::real;
  Centring centring = Centring::cell;
  std::string unit;        // SI, e.g. "kg/m^3"
  std::string definition;  // one sentence
};

class Label {
 public:
  constexpr Label() = default;
  constexpr explicit Label(int id) : id_(id) {}
  constexpr int id() const { return id_; }
  constexpr bool valid() const { return id_ >= 0; }
  const LabelInfo& info() const;  // std::logic_error before it was declared
  const std::string& name() const { return info().name; }
  constexpr friend bool operator==(Label, Label) = default;
  constexpr friend auto operator<=>(Label, Label) = default;

 private:
  int id_ = -1;
};

// Declares a label, or returns the one already declared under this name with the same type and
// centring. Throws std::logic_error on a contradiction.
Label declare_label(LabelInfo info);
// The same for a name that components give to different things (phi on nodes, phi in cells): from
// now on it means this one. A run has one component, which claims its names when it is made.
Label claim_label(LabelInfo info);
std::optional<Label> find_label(std::string_view name);
std::vector<Label> all_labels();  // sorted by name

}  // namespace sluice
