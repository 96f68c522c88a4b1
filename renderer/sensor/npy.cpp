// SPDX-License-Identifier: MIT
#include "renderer/sensor/npy.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/files/regular_file.h"
#include "core/files/text.h"
#include "renderer/base/errors.h"
#include "renderer/base/of_file.h"

namespace minkray {
namespace {

constexpr std::size_t most_bytes = std::size_t{16} << 30;
constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t longest_header = 65536;

/// Returns the text after "'key':" in the header, which is a Python dictionary.
std::string_view after(std::string_view header, std::string_view key) {
  const std::size_t at = header.find("'" + std::string(key) + "'");
  if (at == header.npos) throw BadInput("its header lacks '" + std::string(key) + "'");
  std::string_view rest = header.substr(header.find(':', at) + 1);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  return rest;
}

/// Converts from column order to row order.
std::vector<double> transposed(const std::vector<double>& columns, std::size_t rows,
                               std::size_t width) {
  std::vector<double> values(columns.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < width; ++k) values[i * width + k] = columns[k * rows + i];
  return values;
}

NpyArray parse(const std::string& bytes) {
  if (!bytes.starts_with(magic) || bytes.size() < 12) throw BadInput("not an .npy file");
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const int major = byte(6);
  const std::size_t start = major == 1 ? 10 : 12;
  const std::size_t length = major == 1
                                 ? byte(8) | std::size_t{byte(9)} << 8
                                 : byte(8) | std::size_t{byte(9)} << 8 |
                                       std::size_t{byte(10)} << 16 | std::size_t{byte(11)} << 24;
  if (major > 3 || length > longest_header || start + length > bytes.size())
    throw BadInput("is an .npy file of an unknown kind, or truncated");
  const std::string_view header(bytes.data() + start, length);
  const std::string_view kind = after(header, "descr");
  const bool is_double = kind.starts_with("'<f8'"), is_float = kind.starts_with("'<f4'");
  if (!is_double && !is_float)
    throw BadInput("must hold little-endian floats of 32 or 64 bits, '<f4' or '<f8'");
  const bool first_index_is_fastest = after(header, "fortran_order").starts_with("True");
  NpyArray array;
  std::string_view shape = after(header, "shape");
  shape = shape.substr(0, shape.find(')'));
  std::size_t count = 1;
  while (!shape.empty()) {
    std::size_t size = 0;
    if (!take_number(shape, size)) {
      shape.remove_prefix(1);
      continue;
    }
    array.shape.push_back(size);
    if (size != 0 && count > most_bytes / size) throw BadInput("is larger than can be read");
    count *= size;
  }
  if (first_index_is_fastest && array.shape.size() > 2)
    throw BadInput("must be in C order (numpy.ascontiguousarray)");
  const std::size_t width = is_double ? 8 : 4;
  if (bytes.size() - start - length != count * width)
    throw BadInput("must have " + std::to_string(count * width) + " bytes of numbers (got " +
                   std::to_string(bytes.size() - start - length) + ")");
  static_assert(std::endian::native == std::endian::little);
  const char* const data = bytes.data() + start + length;
  array.values.resize(count);
  if (is_double) {
    // An empty array has a null pointer, which memcpy must not get.
    std::copy_n(data, count * sizeof(double), reinterpret_cast<char*>(array.values.data()));
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      float value;
      std::memcpy(&value, data + 4 * i, sizeof value);
      array.values[i] = static_cast<double>(value);
    }
  }
  if (first_index_is_fastest && array.shape.size() == 2)
    array.values = transposed(array.values, array.shape[0], array.shape[1]);
  return array;
}

}  // namespace

std::string NpyArray::shape_text() const {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

NpyArray read_npy(const std::string& file) {
  return of_file(file, [&] { return parse(read_regular_file(file, most_bytes)); });
}

std::string npy_header(const std::string& descr, std::size_t rows, std::size_t columns) {
  const std::string shape = columns == 1
                                ? "(" + std::to_string(rows) + ",)"
                                : "(" + std::to_string(rows) + ", " + std::to_string(columns) + ")";
  std::string text = "{'descr': " + descr + ", 'fortran_order': False, 'shape': " + shape + ", }";
  // Pads the header so that the data begin at a multiple of 64.
  text.resize((text.size() + 1 + 10 + 63) / 64 * 64 - 10 - 1, ' ');
  text += '\n';
  std::string header(magic);
  header += '\x01';
  header += '\0';
  header += static_cast<char>(text.size() & 255);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

}  // namespace minkray
