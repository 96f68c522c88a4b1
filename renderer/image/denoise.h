// SPDX-License-Identifier: MIT
// Denoiser: each pixel becomes a weighted mean of nearby pixels with similar noise-free features
// and similar light (Buades, Coll and Morel, "A Non-Local Algorithm for Image Denoising", 2005).
// Variance and features enter the weights as in Rousselle, Manzi and Zwicker, "Robust Denoising
// using Feature and Color Information", 2013.
#pragma once

#include "renderer/image/image.h"

namespace minkray {

/// A picture and what is known of it, all of the same size.
struct NoisyPicture {
  Image light;
  Image variance;            ///< the squared standard error of the light
  Image albedo;              ///< last factor of the light; 0 if there was none
  Image normal;              ///< or 0
  std::vector<float> depth;  ///< infinite or 0 where nothing is
};

/// The light with less noise. All threads; the bits do not depend on how many there are.
Image denoised(const NoisyPicture& picture);

}  // namespace minkray
