// SPDX-License-Identifier: MIT
// Less noise: each pixel becomes a weighted mean of those around it that are of the same thing, by
// features that have no noise, and whose light differs by no more than noise does (Buades, Coll and
// Morel, "A Non-Local Algorithm for Image Denoising", 2005; the distance beside what variance
// explains, and features beside it, are those of Rousselle, Manzi and Zwicker, "Robust Denoising
// using Feature and Color Information", 2013).
#pragma once

#include "renderer/image/image.h"

namespace minkray {

/// A picture and what is known of it, all of the same size.
struct NoisyPicture {
  Image light;
  Image variance;            ///< the squared standard error of the light
  Image albedo;              ///< what the light was multiplied by last; 0 where it was not
  Image normal;              ///< or 0
  std::vector<float> depth;  ///< infinite or 0 where nothing is
};

/// The light with less noise. All threads; the bits do not depend on how many there are.
Image denoised(const NoisyPicture& picture);

}  // namespace minkray
