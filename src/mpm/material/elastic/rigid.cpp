// rigid: moves as it is told and has no stress of its own.
#include "mpm/material/elastic/rigid.hpp"

#include "mpm/material/base/material_model.hpp"

namespace sluice::mpm {
namespace {

class Rigid final : public Material {
 public:
  explicit Rigid(double bulk) : bulk_(bulk) {}
  void start(const Batch& b) const override { rest(b); }
  std::optional<BatchFault> update(const Batch& b) const override {
    rest(b);
    return std::nullopt;
  }
  bool rigid() const override { return true; }
  double bulk_modulus() const override { return bulk_; }

 private:
  static void rest(const Batch& b) {
    for (double* column : b.stress)
      for (int i = 0; i < b.count; ++i) column[i] = 0;
    for (int i = 0; i < b.count; ++i) b.energy[i] = b.wave_speed[i] = 0;
  }
  double bulk_;
};

}  // namespace

std::shared_ptr<const Material> make_rigid(double bulk_modulus) {
  return std::make_shared<Rigid>(bulk_modulus);
}

MaterialModel rigid_model() {
  return {"rigid",
          {},
          "rigid body without stress, with prescribed motion: tools, anvils, pistons",
          {tag("shear_modulus", "G, Pa; used only at its neighbours").real().above(0),
           tag("bulk_modulus", "K, Pa; used only at its neighbours").real().above(0)},
          [](const Parameters& p) -> std::shared_ptr<const Material> {
            return make_rigid(p.has("bulk_modulus") ? p.real("bulk_modulus") : 0);
          }};
}

}  // namespace sluice::mpm
