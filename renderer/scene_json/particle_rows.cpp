// SPDX-License-Identifier: MIT
#include "renderer/scene_json/particle_rows.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/files/regular_file.h"
#include "core/files/text.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

/// Files are read in blocks of this many bytes.
constexpr std::size_t block_bytes = std::size_t{1} << 20;

/// A line of text is no longer: eleven numbers of 17 digits take 300 bytes.
constexpr std::size_t longest_line = std::size_t{1} << 16;

/// Scales beyond these leave the range of doubles when they are multiplied and inverted.
constexpr double least_scale = 1e-100, most_scale = 1e100;

const ParticleColumnDescription& description_of(ParticleColumn column) {
  return particle_columns[static_cast<std::size_t>(column)];
}

std::string text_of(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    text += (text.empty() ? "" : " ") + std::string(digits, end);
  }
  return text;
}

/// Returns the condition that a column's numbers violate; empty if they are valid.
std::string_view complaint(ParticleColumn column, std::span<const double> numbers,
                           std::size_t materials) {
  for (const double number : numbers)
    if (!std::isfinite(number)) return "must be finite";
  const auto all = [&](const auto& holds) {
    return std::all_of(numbers.begin(), numbers.end(), holds);
  };
  switch (column) {
    case ParticleColumn::position:
      return "";
    case ParticleColumn::rotation:
      return all([](double x) { return x == 0; }) ? "must not be zero" : "";
    case ParticleColumn::scale:
    case ParticleColumn::scales:
      return all([](double x) { return std::abs(x) >= least_scale && std::abs(x) <= most_scale; })
                 ? ""
                 : "must not be zero, nor beyond 1e-100 to 1e100";
    case ParticleColumn::material:
      return numbers[0] >= 0 && numbers[0] < static_cast<double>(materials) &&
                     numbers[0] == std::floor(numbers[0])
                 ? ""
                 : "must be an index of the block's materials";
  }
  return "";
}

/// "row 12: rotation must not be zero (got 0 0 0 0)"
[[noreturn]] void fail(std::string_view what, std::size_t number, const std::string& complaint) {
  throw std::runtime_error(std::string(what) + " " + std::to_string(number) + ": " + complaint);
}

void check_count(std::size_t found, std::optional<std::size_t> count, std::size_t most_rows) {
  if (found == 0) throw std::runtime_error("must hold at least one row (got none)");
  if (count && found != *count)
    throw std::runtime_error("must hold " + std::to_string(*count) +
                             " rows, as \"count\" says (got " + std::to_string(found) + ")");
  if (found > most_rows)
    throw std::runtime_error("must hold at most " + std::to_string(most_rows) + " rows (got " +
                             std::to_string(found) + ")");
}

/// Rows of Number, one behind the other.
template <class Number>
void read_binary(RegularFile& file, std::optional<std::size_t> count, std::size_t most_rows,
                 ParticleRows& rows, Hash& hash) {
  static_assert(std::endian::native == std::endian::little, "the numbers' bytes must be swapped");
  const std::size_t row_bytes = rows.row_numbers() * sizeof(Number);
  const std::size_t expected = file.size() / row_bytes;
  if (const std::size_t rest = file.size() % row_bytes; rest != 0)
    fail("row", expected + 1,
         "is truncated (got " + std::to_string(rest) + " of its " + std::to_string(row_bytes) +
             " bytes)");
  check_count(expected, count, most_rows);
  rows.reserve(expected);
  std::vector<char> block(std::max<std::size_t>(block_bytes / row_bytes, 1) * row_bytes);
  std::vector<double> row(rows.row_numbers());
  for (std::size_t got = block.size(); got == block.size();) {
    got = file.read(block);
    hash.add({block.data(), got});
    if (got % row_bytes != 0) fail("row", rows.count() + got / row_bytes + 1, "is cut off");
    for (std::size_t at = 0; at < got; at += row_bytes) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        Number number;
        std::memcpy(&number, block.data() + at + i * sizeof(Number), sizeof number);
        row[i] = static_cast<double>(number);
      }
      if (rows.count() == expected) throw std::runtime_error("grew while it was read");
      if (const auto wrong = rows.add(row)) fail("row", rows.count() + 1, *wrong);
    }
  }
  check_count(rows.count(), expected, most_rows);
}

/// The numbers of one line, with commas or blanks between them.
void parse_line(std::string_view line, std::size_t number, const ParticleRows& rows,
                std::vector<double>& row) {
  row.clear();
  for (line = without_blanks(line); !line.empty();) {
    if (row.size() == rows.row_numbers())
      fail("line", number,
           "must hold " + std::to_string(rows.row_numbers()) + " numbers (got more)");
    const auto end = std::ranges::find_if(line, [](char c) { return is_blank(c) || c == ','; });
    const std::string_view word(line.begin(), end);
    double value = 0;
    if (!read_number(bare_number(word), value))
      fail("line", number,
           std::string(rows.column_of(row.size())) + " must be a number that a double can hold " +
               "(got \"" + printable(word, 40) + "\"); lines of other text begin with #");
    row.push_back(value);
    line = without_blanks(line.substr(word.size()));
    if (!line.starts_with(',')) continue;
    line = without_blanks(line.substr(1));
    if (line.empty()) fail("line", number, "must not end in a comma");
  }
  if (row.size() != rows.row_numbers())
    fail("line", number,
         "must hold " + std::to_string(rows.row_numbers()) + " numbers (got " +
             std::to_string(row.size()) + ")");
}

void read_csv(RegularFile& file, std::optional<std::size_t> count, std::size_t most_rows,
              ParticleRows& rows, Hash& hash) {
  // A number and what follows it take two bytes at least: no file makes room for rows it has not.
  if (count) rows.reserve(std::min(*count, file.size() / (2 * rows.row_numbers()) + 1));
  std::vector<char> block(block_bytes + longest_line);
  std::vector<double> row;
  std::size_t line_number = 0, kept = 0;  // kept: bytes of a line that is not complete
  const auto take = [&](std::string_view line) {
    ++line_number;
    if (line_number == 1) line = without_byte_order_mark(line);
    line = without_blanks(line);
    if (line.empty() || line.front() == '#') return;
    if (rows.count() == most_rows)
      throw std::runtime_error("must hold at most " + std::to_string(most_rows) + " rows");
    parse_line(line, line_number, rows, row);
    if (const auto wrong = rows.add(row)) fail("line", line_number, *wrong);
  };
  for (bool more = true; more;) {
    const std::size_t got = file.read(std::span(block).subspan(kept, block_bytes));
    more = got == block_bytes;
    hash.add({block.data() + kept, got});
    std::string_view text(block.data(), kept + got);
    for (std::size_t end; (end = text.find('\n')) != text.npos; text.remove_prefix(end + 1))
      take(text.substr(0, end));
    if (!more && !text.empty()) take(text);
    if (more && text.size() > longest_line)
      fail("line", line_number + 1,
           "must not be longer than " + std::to_string(longest_line) + " bytes");
    kept = text.size();
    if (more) std::memmove(block.data(), text.data(), kept);
  }
  check_count(rows.count(), count, most_rows);
}

}  // namespace

ParticleRows::ParticleRows(std::vector<ParticleColumn> columns, ParticleSet& set)
    : columns_(std::move(columns)), set_(set) {
  for (const ParticleColumn column : columns_) {
    row_numbers_ += description_of(column).numbers;
    set.has_rotation |= column == ParticleColumn::rotation;
    if (column == ParticleColumn::scale || column == ParticleColumn::scales)
      set.scale_numbers = description_of(column).numbers;
  }
}

void ParticleRows::reserve(std::size_t rows) {
  set_.poses.reserve(rows * set_.row_numbers());
  if (std::find(columns_.begin(), columns_.end(), ParticleColumn::material) != columns_.end())
    set_.material_of.reserve(rows);
}

std::optional<std::string> ParticleRows::add(std::span<const double> row) {
  // Numbers of each column in the row.
  std::span<const double> found[std::size(particle_columns)];
  std::size_t at = 0;
  for (const ParticleColumn column : columns_) {
    const ParticleColumnDescription& description = description_of(column);
    const auto numbers = row.subspan(at, description.numbers);
    at += description.numbers;
    if (const auto wrong = complaint(column, numbers, set_.materials.size()); !wrong.empty())
      return std::string(description.name) + " " + std::string(wrong) + " (got " +
             text_of(numbers) + ")";
    found[static_cast<std::size_t>(column)] = numbers;
  }
  for (const ParticleColumn column : {ParticleColumn::position, ParticleColumn::rotation,
                                      ParticleColumn::scale, ParticleColumn::scales}) {
    const auto numbers = found[static_cast<std::size_t>(column)];
    set_.poses.insert(set_.poses.end(), numbers.begin(), numbers.end());
  }
  const auto material = found[static_cast<std::size_t>(ParticleColumn::material)];
  if (!material.empty()) set_.material_of.push_back(static_cast<std::uint16_t>(material[0]));
  ++count_;
  return std::nullopt;
}

std::string_view ParticleRows::column_of(std::size_t number) const {
  for (const ParticleColumn column : columns_) {
    const ParticleColumnDescription& description = description_of(column);
    if (number < description.numbers) return description.name;
    number -= description.numbers;
  }
  return "a number";
}

void ParticleRows::finish() {
  set_.poses.shrink_to_fit();
  set_.material_of.shrink_to_fit();
}

void read_particle_file(const std::filesystem::path& path, std::optional<std::size_t> count,
                        std::size_t most_rows, ParticleRows& rows, Hash& hash) {
  const std::string kind = path.extension().string();
  if (kind != ".csv" && kind != ".f32" && kind != ".f64")
    throw std::runtime_error("its name must end in .csv, .f32 or .f64");
  RegularFile file(path);
  if (kind == ".csv") read_csv(file, count, most_rows, rows, hash);
  if (kind == ".f32") read_binary<float>(file, count, most_rows, rows, hash);
  if (kind == ".f64") read_binary<double>(file, count, most_rows, rows, hash);
  rows.finish();
}

}  // namespace minkray
