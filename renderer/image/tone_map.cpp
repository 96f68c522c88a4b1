// SPDX-License-Identifier: MIT
#include "renderer/image/tone_map.h"

#include <algorithm>
#include <cmath>

namespace minkray {
namespace {

double filmic(double x) {
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

/// AgX takes stops of light from here to there, in logarithms of base 2.
constexpr double least_stop = -12.47393, most_stop = 4.026069;

/// AgX's contrast curve, by a polynomial.
double agx_curve(double x) {
  const double x2 = x * x, x4 = x2 * x2;
  return 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x -
         0.00232;
}

Vec3<double> agx(const Vec3<double>& light) {
  Mat3<double> inset, outset;
  inset << 0.842479062253094, 0.0784335999999992, 0.0792237451477643,  //
      0.0423282422610123, 0.878468636469772, 0.0791661274605434,       //
      0.0423756549057051, 0.0784336, 0.879142973793104;
  outset << 1.19687900512017, -0.0980208811401368, -0.0990297440797205,  //
      -0.0528968517574562, 1.15190312990417, -0.0989611768448433,        //
      -0.0529716355144438, -0.0980434501171241, 1.15107367264116;
  Vec3<double> encoded = inset * light;
  for (int i = 0; i < 3; ++i) {
    const double stops = std::log2(std::max(encoded[i], 1e-10));
    encoded[i] = agx_curve((std::clamp(stops, least_stop, most_stop) - least_stop) /
                           (most_stop - least_stop));
  }
  encoded = outset * encoded;
  // The fit was made for screens with a gamma of 2.2.
  for (int i = 0; i < 3; ++i) encoded[i] = std::pow(std::clamp(encoded[i], 0.0, 1.0), 2.2);
  return encoded;
}

}  // namespace

Vec3<double> tone_mapped(ToneMap kind, const Vec3<double>& light) {
  const Vec3<double> positive = light.cwiseMax(0.0);
  if (kind == ToneMap::filmic)
    return Vec3<double>(filmic(positive.x()), filmic(positive.y()), filmic(positive.z()))
        .cwiseMin(1.0);
  return kind == ToneMap::agx ? agx(positive) : light;
}

}  // namespace minkray
