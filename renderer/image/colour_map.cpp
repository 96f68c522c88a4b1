// SPDX-License-Identifier: MIT
#include "renderer/image/colour_map.h"

#include <array>

#include "renderer/image/colour.h"

namespace minkray {

Vec3<float> inferno(double value) {
  // Least-squares coefficients of the published table, by Matt Zucker (CC0), for sRGB.
  static constexpr std::array<std::array<double, 3>, 7> coefficients = {{
      {0.0002189403691192265, 0.001651004631001012, -0.01948089843709184},
      {0.1065134194856116, 0.5639564367884091, 3.932712388889277},
      {11.60249308247187, -3.972853965665698, -15.9423941062914},
      {-41.70399613139459, 17.43639888205313, 44.35414519872813},
      {77.162935699427, -33.40235894210092, -81.80730925738993},
      {-71.31942824499214, 32.62606426397723, 73.20951985803202},
      {25.13112622477341, -12.24266895238567, -23.07032500287172},
  }};
  const double x = value > 0 ? std::min(value, 1.0) : 0.0;
  Vec3<float> colour;
  for (int channel = 0; channel < 3; ++channel) {
    double sum = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;)
      sum = sum * x + coefficients[i][static_cast<std::size_t>(channel)];
    colour[channel] = static_cast<float>(from_srgb(std::clamp(sum, 0.0, 1.0)));
  }
  return colour;
}

}  // namespace minkray
