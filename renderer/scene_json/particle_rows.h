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
  /// The columns say what a row's numbers are, in their order; each at most once, the position
  /// among them, and not both kinds of scales. Sets the set's layout.
  ParticleRows(std::vector<ParticleColumn> columns, ParticleSet& set);

  std::size_t row_numbers() const { return row_numbers_; }
  std::size_t count() const { return count_; }
  void reserve(std::size_t rows);

  /// One row of row_numbers() numbers. What is wrong with it, if anything: "rotation must not be
  /// zero (got 0 0 0 0)"; it is then left out.
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

/// Adds the rows of a file: .csv (text) or .f32 or .f64 (little-endian floats or doubles, nothing
/// between them). `count`: how many rows it must hold. At most `most_rows`. Throws
/// std::runtime_error that says what is wrong, and in which row or line, without the file's name.
void read_particle_file(const std::filesystem::path& path, std::optional<std::size_t> count,
                        std::size_t most_rows, ParticleRows& rows, Hash& hash);

}  // namespace minkray
