// SPDX-License-Identifier: MIT
// Mixture of two materials by an amount.
#pragma once

#include "renderer/surfaces/lobes.h"

namespace minkray {

class MixBsdf final : public Bsdf {
 public:
  /// Refers to both; `amount` is the second one's part.
  MixBsdf(const Bsdf& first, const Bsdf& second, double amount)
      : lobes_{Lobe{&first, Colour::Constant(1 - amount), 1 - amount},
               Lobe{&second, Colour::Constant(amount), amount}} {}

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override {
    return eval_of(lobes_, at, w_in);
  }
  double pdf(const Shading& at, const Vec3<double>& w_in) const override {
    return pdf_of(lobes_, at, w_in);
  }
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override {
    return sample_of(lobes_, at, choice);
  }
  bool is_sharp() const override {
    return lobes_[0].bsdf->is_sharp() && lobes_[1].bsdf->is_sharp();
  }
  bool lets_through() const override {
    return lobes_[0].bsdf->lets_through() || lobes_[1].bsdf->lets_through();
  }
  bool has_grain() const override {
    return lobes_[0].bsdf->has_grain() || lobes_[1].bsdf->has_grain();
  }

 private:
  std::array<Lobe, 2> lobes_;
};

}  // namespace minkray
