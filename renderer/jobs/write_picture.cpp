// SPDX-License-Identifier: MIT
#include "renderer/jobs/write_picture.h"

#include <cmath>

#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"
#include "renderer/io/image_file.h"
#include "renderer/io/output_file.h"

namespace minkray {

Image to_look_at(const FinishedPicture& finished, const Display& display) {
  const auto gain = static_cast<float>(std::exp2(display.exposure));
  Image picture = finished.image;
  for (Vec3<float>& pixel : picture.pixels) pixel *= gain;
  if (display.tone_map != ToneMap::srgb)
    for (Vec3<float>& pixel : picture.pixels)
      pixel = tone_mapped(display.tone_map, pixel.cast<double>()).cast<float>();
  draw_labels(picture, finished.labels, finished.window, finished.resolution);
  return picture;
}

namespace {

std::vector<unsigned char> exr_bytes(const ExrImage& exr, bool has_halfs) {
  if (!has_halfs) return encode_exr(exr);
  ExrImage small = exr;
  for (ExrPlane& plane : small.planes)
    plane.is_half = plane.name == "R" || plane.name == "G" || plane.name == "B";
  return encode_exr(small);
}

}  // namespace

void write_picture(const std::vector<std::string>& outputs, const FinishedPicture& picture,
                   const Display& display) {
  for (const std::string& output : outputs) {
    const auto bytes = keeps_planes(output)   ? exr_bytes(picture.exr, display.has_halfs)
                       : keeps_floats(output) ? encode_image(picture.image, output)
                                              : encode_image(to_look_at(picture, display), output);
    InterruptGuard::end_if_interrupted();
    write_file(output, bytes);
    InterruptGuard::end_if_interrupted();
  }
}

void check_exposure(double exposure) {
  if (!std::isfinite(exposure) || std::abs(exposure) > 100)
    throw WrongUsage("--exposure: must be a number of stops from -100 to 100");
}

}  // namespace minkray
