// SPDX-License-Identifier: MIT
// Joints' values from files: CSV with names in its first line.
#include <charconv>
#include <cmath>
#include <sstream>

#include "renderer/import/scene_of_model.h"
#include "renderer/json/parse.h"

namespace minkray {
namespace {

/// Rows follow each other so fast unless they say when they are.
constexpr double rows_a_second = 24;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const std::size_t begin = cell.find_first_not_of(" \t\r\""),
                      end = cell.find_last_not_of(" \t\r\"");
    cells.push_back(begin == cell.npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

}  // namespace

std::vector<JointRow> read_joint_rows(const std::string& file, Model& model, Mistakes& mistakes,
                                      const std::string& option) {
  std::vector<JointRow> rows;
  Mistakes of_file(file);
  const auto text = read_text_file(file, of_file);
  const auto hand_on = [&] {
    for (const std::string& message : of_file.messages()) mistakes.add(option + ": " + message);
  };
  if (!text) {
    hand_on();
    return rows;
  }
  std::istringstream lines(*text);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  // Joints of several numbers take several columns of their name.
  std::vector<std::size_t> width_so_far(names.size());
  for (std::size_t c = 0; c < names.size(); ++c) {
    const ModelJoint* joint = find_joint(model, names[c]);
    if (names[c] == "time") continue;
    if (!joint) {
      of_file.add("line 1: there is no joint \"" + printable(names[c], 60) + "\"");
      continue;
    }
    std::size_t columns = 0;
    for (const std::string& other : names) columns += other == names[c] ? 1 : 0;
    if (columns != width_of(joint->kind))
      of_file.add("line 1: the joint \"" + printable(names[c], 60) + "\" takes " +
                  std::to_string(width_of(joint->kind)) + " columns");
  }
  for (std::size_t number = 2; std::getline(lines, line) && of_file.messages().size() < 20;
       ++number) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.empty() || (cells.size() == 1 && cells[0].empty())) continue;
    if (cells.size() != names.size()) {
      of_file.add("line " + std::to_string(number) + ": must have " + std::to_string(names.size()) +
                  " cells (got " + std::to_string(cells.size()) + ")");
      continue;
    }
    JointRow row{static_cast<double>(rows.size()) / rows_a_second, {}};
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = 0;
      const char* const end = cells[c].data() + cells[c].size();
      const auto [next, error] = std::from_chars(cells[c].data(), end, value);
      if (error != std::errc() || next != end || !std::isfinite(value)) {
        of_file.add("line " + std::to_string(number) + ": must be finite numbers (got \"" +
                    printable(cells[c], 40) + "\")");
        break;
      }
      if (names[c] == "time") {
        row.time = value;
        continue;
      }
      std::vector<double>* values = nullptr;
      for (auto& [name, known] : row.values)
        if (name == names[c]) values = &known;
      if (!values) values = &row.values.emplace_back(names[c], std::vector<double>()).second;
      values->push_back(value);
    }
    if (!rows.empty() && !(row.time > rows.back().time))
      of_file.add("line " + std::to_string(number) + ": times must rise");
    rows.push_back(std::move(row));
  }
  if (rows.empty() && of_file.none()) of_file.add("must have rows of values");
  hand_on();
  return rows;
}

}  // namespace minkray
