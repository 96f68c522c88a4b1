// SPDX-License-Identifier: MIT
// Rows of numbers into the poses of particles: each is checked as it comes, and kept in as little
// room as it takes. Files are read block by block.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/hash.h"
#include "renderer/scene/particles.h"

namespace minkray {

/// Fills a set row by row.
class ParticleRows {
 public:
  /// `columns` lists the meaning of a row's numbers in order: each at most once, with the position,
  /// and not both kinds of scales. Sets the set's layout.
  ParticleRows(std::vector<ParticleColumn> columns, ParticleSet& set);

  std::size_t row_numbers() const { return row_numbers_; }
  std::size_t count() const { return count_; }
  void reserve(std::size_t rows);

  /// Adds one row of row_numbers() numbers. Returns the error of an invalid row, which is not
  /// added: "rotation must not be zero (got 0 0 0 0)".
  std::optional<std::string> add(std::span<const double> row);

  /// The name of the column that a row's number belongs to.
  std::string_view column_of(std::size_t number) const;

  void finish();

 private:
  std::vector<ParticleColumn> columns_;
  ParticleSet& set_;
  std::size_t row_numbers_ = 0;
  std::size_t count_ = 0;
};

/// Adds the rows of a file: .csv (text), .f32 or .f64 (little-endian floats or doubles without
/// separators). The file must hold `count` rows, if given, and at most `most_rows`. Throws
/// std::runtime_error with the error and its row or line, without the file's name.
void read_particle_file(const std::filesystem::path& path, std::optional<std::size_t> count,
                        std::size_t most_rows, ParticleRows& rows, Hash& hash);

}  // namespace minkray
