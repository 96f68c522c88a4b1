// SPDX-License-Identifier: MIT
// NumPy's array files (.npy):
// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <string>
#include <vector>

namespace minkray {

struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<double> values;  ///< the last index runs fastest

  /// "(3, 6)".
  std::string shape_text() const;
};

/// Reads little-endian floats of 32 or 64 bits. Throws BadInput with the file's name.
NpyArray read_npy(const std::string& file);

/// Bytes before the data of a structured array of one dimension (or two, if the second length is
/// not 1). `descr` is NumPy's list of fields in Python syntax.
std::string npy_header(const std::string& descr, std::size_t rows, std::size_t columns = 1);

}  // namespace minkray
