#include "mpm/outputs/node_fields.hpp"

#include <cmath>
#include <functional>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/mean_on_nodes.hpp"

namespace sluice::mpm {
namespace {

struct NodeLabels {
  Label mass, volume, velocity, velocity_star, acceleration, internal_force, external_force, stress,
      temperature, heating, displacement, concentration;
};

const NodeLabels& labels() {
  const auto declare = [](const char* name, ValueType type, const char* unit,
                          const char* definition) {
    return declare_label({name, type, Centring::node, unit, definition});
  };
  using enum ValueType;
  static const NodeLabels l = {
      declare("g.mass", real, "kg", "Mass of a material at a node: sum m S."),
      declare("g.volume", real, "m^3", "Volume of a material at a node: sum V S."),
      declare("g.velocity", vector, "m/s",
              "Velocity of a material at a node: sum m v S over its "
              "mass."),
      declare("g.velocity_star", vector, "m/s",
              "Velocity of a material at a node after a further step of the last length, before "
              "contact and boundary values."),
      declare("g.acceleration", vector, "m/s^2",
              "Acceleration of a material at a node by stress, loads and gravity."),
      declare("g.internalforce", vector, "N",
              "Force of the stress on a node: -sum V sigma grad S."),
      declare("g.externalforce", vector, "N", "Force of loads on a node: sum f S."),
      declare("g.stressFS", tensor, "Pa",
              "Volume-weighted mean stress of a material around a node."),
      declare("g.temperature", real, "K",
              "Mass-weighted mean temperature of a material around a node."),
      declare(
          "g.dTdt", real, "K/s",
          "Mass-weighted mean rate of temperature of a material around a node in the last step."),
      declare("g.displacement", vector, "m",
              "Mass-weighted mean displacement of a material around a node."),
      declare("g.concentration", real, "1",
              "Mass-weighted mean concentration of a material around a node."),
  };
  return l;
}

// act(node index, lanes) for the nodes that hold particles' contributions.
void for_each_full_node(const BlockTable& table, const NodeLanes& nodes,
                        const std::function<void(IntVec3, const std::int64_t*)>& act) {
  const BlockShape& shape = table.shape();
  for (int b = 0; b < table.count(); ++b) {
    for_each_node(shape, shape.lower(table.block(b)), [&](int n, IntVec3 at) {
      const std::int64_t* node = nodes.sums(b) + n * lanes;
      if (node[count_lane] != 0 && sum_in(node, 0) > 0) act(at, node);
    });
  }
}

class BodyFields {
 public:
  BodyFields(const Scene& scene, const MpmScene& solids, SolidStep& step, const StageScope& scope,
             int body, GridFields& fields)
      : scene_(scene),
        solids_(solids),
        step_(step),
        scope_(scope),
        number_(body),
        body_(step.bodies()[body]),
        material_(body_.material->index),
        fields_(fields) {}

  void store() {
    store_motion();
    store_means();
  }

 private:
  bool has(Label l) const { return fields_.has(l, material_); }
  void set(Label l, IntVec3 at, Vec3 v) {
    for (int d = 0; d < 3 && has(l); ++d) fields_.set(l, material_, d, at, v[d]);
  }
  void set(Label l, IntVec3 at, double v) {
    if (has(l)) fields_.set(l, material_, 0, at, v);
  }

  void store_motion() {
    const NodeLabels& l = labels();
    for_each_full_node(body_.table, body_.nodes, [&](IntVec3 at, const std::int64_t* node) {
      const double mass = sum_in(node, 0) / body_.units.mass;
      Vec3 v, f;
      for (int d = 0; d < 3; ++d) {
        v[d] = body_.units.reference[d] + sum_in(node, 1 + d) / body_.units.momentum / mass;
        f[d] = sum_in(node, 4 + d) / body_.units.force;
      }
      const Vec3 a = f * (1 / mass) + scene_.constants.gravity;
      set(l.mass, at, mass);
      set(l.velocity, at, v);
      set(l.internal_force, at, f);
      set(l.acceleration, at, a);
      set(l.velocity_star, at, v + a * scope_.step.dt);
    });
  }

  // Means by volume or mass: two passes of up to seven lanes, weight first.
  void store_means() {
    const NodeLabels& l = labels();
    const Columns& c = body_.carried->columns;
    if (has(l.volume) || has(l.stress)) {
      constexpr int components[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
      mean(c.volume, c.stress, 6, [&](IntVec3 at, double volume, const double* s) {
        set(l.volume, at, volume);
        for (int e = 0; e < 9 && has(l.stress); ++e)
          fields_.set(l.stress, material_, e, at, s[components[e]]);
      });
    }
    if (has(l.temperature))
      mean(c.mass, c.temperature, 1,
           [&](IntVec3 at, double, const double* T) { set(l.temperature, at, T[0]); });
    if (has(l.concentration) && c.concentration >= 0)
      mean(c.mass, c.concentration, 1,
           [&](IntVec3 at, double, const double* C) { set(l.concentration, at, C[0]); });
    if (has(l.heating) && c.heating >= 0)
      mean(c.mass, c.heating, 1,
           [&](IntVec3 at, double, const double* rate) { set(l.heating, at, rate[0]); });
    if (has(l.displacement) && c.displacement >= 0)
      mean(c.mass, c.displacement, 3, [&](IntVec3 at, double, const double* u) {
        set(l.displacement, at, Vec3{u[0], u[1], u[2]});
      });
  }

  using Store = std::function<void(IntVec3, double weight, const double* means)>;
  void mean(int weight, int first, int count, const Store& store) {
    const std::vector<NodeMean> means =
        mean_on_nodes(solids_, step_.nodes(), step_.body(number_), number_, step_.work(),
                      *scope_.ranks, {weight, first, count});
    for (const NodeMean& m : means) store(m.node, m.weight, m.mean.data());
  }

  const Scene& scene_;
  const MpmScene& solids_;
  SolidStep& step_;
  const StageScope& scope_;
  int number_;
  const Body& body_;
  int material_;
  GridFields& fields_;
};

}  // namespace

std::vector<Label> node_labels() {
  const NodeLabels& l = labels();
  return {l.mass,         l.volume,         l.velocity,       l.velocity_star,
          l.acceleration, l.internal_force, l.external_force, l.stress,
          l.temperature,  l.heating,        l.displacement,   l.concentration};
}

void store_node_fields(const Scene& scene, const MpmScene& solids, SolidStep& step,
                       const StageScope& scope, GridFields& fields) {
  step.begin(scope);
  step.to_grid(scope);
  step.fold();
  step.share_sums(scope);
  for (std::size_t b = 0; b < step.bodies().size(); ++b)
    BodyFields(scene, solids, step, scope, static_cast<int>(b), fields).store();
}

}  // namespace sluice::mpm
