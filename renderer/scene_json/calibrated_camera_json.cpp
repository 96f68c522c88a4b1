// SPDX-License-Identifier: MIT
// Calibrated cameras as JSON.
#include "renderer/json/object_reader.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/scene/calibrated_camera.h"

namespace minkray {
namespace {

constexpr int most_camera_side = 1 << 16;

/// Reads a number that may be missing.
double number_or_zero(ObjectReader& object, const std::string& key, Range range = Range::any) {
  const Json* written = object.find(key);
  if (!written) return 0;
  return read_number(*written, object.path(key), object.mistakes(), range).value_or(0);
}

CalibratedCamera::Model read_model(ObjectReader& object) {
  const Json* written = object.find("model");
  if (!written) return CalibratedCamera::Model::pinhole;
  if (written->is_string() && written->text() == "fisheye") return CalibratedCamera::Model::fisheye;
  if (!written->is_string() || written->text() != "pinhole")
    object.mistakes().add(object.path("model"),
                          "must be \"pinhole\" or \"fisheye\" (" + found(*written) + ")");
  return CalibratedCamera::Model::pinhole;
}

CalibratedCamera read_camera(const std::string* text, Mistakes& mistakes) {
  const auto json = text ? parse_json(*text, mistakes) : std::nullopt;
  throw_if_any(mistakes);
  ObjectReader object(*json, JsonPath(), mistakes);
  const auto number = [&](const char* key, Range range) {
    const Json* written = object.require(key, "a number");
    return written ? read_number(*written, object.path(key), mistakes, range).value_or(1) : 1;
  };
  const auto pixels = [&](const char* key) {
    const Json* written = object.require(key, "a number of pixels");
    return written
               ? read_integer(*written, object.path(key), mistakes, 1, most_camera_side).value_or(1)
               : 1;
  };
  CalibratedCamera::Numbers numbers;
  numbers.model = read_model(object);
  numbers.fx = number("fx", Range::positive);
  numbers.fy = number("fy", Range::positive);
  numbers.cx = number("cx", Range::any);
  numbers.cy = number("cy", Range::any);
  numbers.width = pixels("width");
  numbers.height = pixels("height");
  const bool is_pinhole = numbers.model == CalibratedCamera::Model::pinhole;
  for (std::size_t i = 0; i < (is_pinhole ? 6 : 4); ++i)
    numbers.k[i] = number_or_zero(object, "k" + std::to_string(i + 1));
  if (is_pinhole) {
    numbers.p1 = number_or_zero(object, "p1");
    numbers.p2 = number_or_zero(object, "p2");
  }
  numbers.row_time = number_or_zero(object, "row_time", Range::not_negative);
  object.finish();
  throw_if_any(mistakes);
  return CalibratedCamera(numbers);
}

}  // namespace

CalibratedCamera read_calibrated_camera(const std::string& file) {
  Mistakes mistakes(file);
  const auto text = read_text_file(file, mistakes);
  return read_camera(text ? &*text : nullptr, mistakes);
}

CalibratedCamera parse_calibrated_camera(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  return read_camera(&text, mistakes);
}

}  // namespace minkray
