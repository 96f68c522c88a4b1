// SPDX-License-Identifier: MIT
#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/read_rotation.h"

namespace minkray {
namespace {

/// A matrix whose rows and columns have been scaled to a largest entry of 1 is taken for singular
/// if a pivot of its LU decomposition is below this: entries are rounded to half an epsilon, and
/// three of them add up in each pivot.
constexpr double singular_pivot = 8 * std::numeric_limits<double>::epsilon();

/// True if the map has an inverse in double. Rows and columns are scaled first, so that a map that
/// makes one axis a million times shorter does not count as singular.
bool is_invertible(const Mat3<double>& matrix) {
  Mat3<double> scaled = matrix;
  for (int pass = 0; pass < 2; ++pass) {
    for (int i = 0; i < 3; ++i) {
      const double largest = scaled.row(i).cwiseAbs().maxCoeff();
      if (!(largest > 0)) return false;
      scaled.row(i) /= largest;
    }
    scaled.transposeInPlace();
  }
  const Eigen::FullPivLU<Mat3<double>> lu(scaled);
  if (!(lu.matrixLU().diagonal().cwiseAbs().minCoeff() > singular_pivot)) return false;
  return matrix.inverse().allFinite();
}

std::optional<Affine<double>> read_matrix(ObjectReader& object, const Json& json) {
  const JsonPath path = object.path("matrix");
  Mistakes& mistakes = object.mistakes();
  const char* expected = "must be a list of 3 rows, each a list of 3 or of 4 numbers (";
  if (!json.is_array() || json.size() != 3) {
    mistakes.add(path, expected + found(json) + ")");
    return std::nullopt;
  }
  Affine<double> map;
  bool all_read = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& row = json[i];
    const std::size_t columns = json[0].is_array() ? json[0].size() : 0;
    if (!row.is_array() || (columns != 3 && columns != 4)) {
      mistakes.add(path / i, "must be a list of 3 or of 4 numbers (" + found(row) + ")");
      return std::nullopt;
    }
    const auto numbers = read_numbers(row, path / i, mistakes, columns);
    if (!numbers) {
      all_read = false;
      continue;
    }
    const auto index = static_cast<Eigen::Index>(i);
    map.linear.row(index) << (*numbers)[0], (*numbers)[1], (*numbers)[2];
    if (columns == 4) map.translation[index] = (*numbers)[3];
  }
  if (!all_read) return std::nullopt;
  if (!is_invertible(map.linear)) {
    mistakes.add(path,
                 "must be invertible (got a singular matrix " + printable(json.dump(), 200) + ")");
    return std::nullopt;
  }
  return map;
}

/// Three numbers, or one for all three.
std::optional<Vec3<double>> read_scale(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  if (json.is_number()) {
    const auto number = read_number(json, path, mistakes);
    if (!number) return std::nullopt;
    return Vec3<double>::Constant(*number);
  }
  if (!json.is_array()) {
    mistakes.add(path, "must be a number or a list of 3 numbers (" + found(json) + ")");
    return std::nullopt;
  }
  return read_vector(json, path, mistakes);
}

}  // namespace

std::optional<Affine<double>> read_affine(ObjectReader& object) {
  Mistakes& mistakes = object.mistakes();
  const Json* translate = object.find("translate");
  const Json* rotate = object.find("rotate");
  const Json* scale = object.find("scale");
  if (const Json* matrix = object.find("matrix")) {
    if (translate || rotate || scale) {
      mistakes.add(object.path(),
                   "must have either \"matrix\" or \"translate\", \"rotate\" and \"scale\" "
                   "(got both)");
    }
    return read_matrix(object, *matrix);
  }

  std::optional<Vec3<double>> t = Vec3<double>::Zero(), s = Vec3<double>::Ones();
  std::optional<Mat3<double>> r = Mat3<double>::Identity();
  if (translate) t = read_vector(*translate, object.path("translate"), mistakes);
  if (rotate) {
    const auto q =
        read_rotation(*rotate, object.path("rotate"), mistakes, t.value_or(Vec3<double>::Zero()));
    r = std::nullopt;
    if (q) r = rotation_matrix_of_any((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
  }
  if (scale) s = read_scale(*scale, object.path("scale"), mistakes);
  if (!t || !r || !s) return std::nullopt;
  const Affine<double> map = from_translate_rotate_scale<double>(*t, *r, *s);
  if (!is_invertible(map.linear)) {
    mistakes.add(object.path("scale"),
                 "must have no zero, nor be too small or too large to be inverted (" +
                     (scale->is_number() ? found(*scale) : "got " + scale->dump()) + ")");
    return std::nullopt;
  }
  return map;
}

}  // namespace minkray
