// SPDX-License-Identifier: MIT
// Order in which a picture's tiles are rendered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace minkray {

/// The tiles of a grid of `columns` by `rows`, which are numbered row by row, along Hilbert's curve
/// (Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891): a range of it
/// is a patch, wherever it is cut, so that a thread's tiles share what is in its cache.
std::vector<std::uint32_t> along_curve(std::size_t columns, std::size_t rows);

}  // namespace minkray
