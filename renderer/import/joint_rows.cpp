// SPDX-License-Identifier: MIT
// Joints' values from files: CSV with names in its first line, or JSON.
#include <charconv>
#include <cmath>
#include <sstream>

#include "renderer/import/scene_of_model.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"

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

std::vector<JointRow> rows_of_csv(const std::string& text, Model& model, Mistakes& of_file) {
  std::vector<JointRow> rows;
  std::istringstream lines(text);
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
  return rows;
}

/// {"time": 0.5, "elbow": 1.2, "ball": [1, 0, 0, 0]}
void add_row(const Json& json, const JsonPath& path, Model& model, Mistakes& of_file,
             std::vector<JointRow>& rows) {
  if (!json.is_object()) return of_file.add(path, "must be an object (" + found(json) + ")");
  JointRow row{static_cast<double>(rows.size()) / rows_a_second, {}};
  for (const auto& [name, value] : json.members()) {
    const JsonPath at = path / name;
    if (name == "time") {
      row.time = read_number(value, at, of_file).value_or(row.time);
      continue;
    }
    const ModelJoint* joint = find_joint(model, name);
    if (!joint) {
      of_file.add(at, "there is no joint of this name");
      continue;
    }
    const std::size_t width = width_of(joint->kind);
    if (width == 1 && !value.is_array()) {
      if (const auto number = read_number(value, at, of_file))
        row.values.push_back({name, {*number}});
    } else if (auto numbers = read_numbers(value, at, of_file, width)) {
      row.values.emplace_back(name, std::move(*numbers));
    }
  }
  if (!rows.empty() && !(row.time > rows.back().time)) of_file.add(path / "time", "must rise");
  rows.push_back(std::move(row));
}

std::vector<JointRow> rows_of_json(const std::string& text, Model& model, Mistakes& of_file) {
  std::vector<JointRow> rows;
  const auto json = parse_json(text, of_file);
  if (!json) return rows;
  if (!json->is_array()) add_row(*json, JsonPath(), model, of_file, rows);
  for (std::size_t i = 0; json->is_array() && i < json->size(); ++i)
    if (of_file.messages().size() < 20) add_row((*json)[i], JsonPath() / i, model, of_file, rows);
  return rows;
}

}  // namespace

namespace {

/// Files that were recorded have joints that follow others, too.
void leave_out_mimics(std::vector<JointRow>& rows, Model& model) {
  for (JointRow& row : rows)
    std::erase_if(row.values, [&](const auto& value) {
      const ModelJoint* joint = find_joint(model, value.first);
      if (!joint->mimic) return false;
      model.pass_over("values of the joint \"" + printable(value.first, 60) + "\"",
                      "it follows \"" + printable(joint->mimic->joint, 60) + "\"");
      return true;
    });
}

}  // namespace

std::vector<JointRow> read_joint_rows(const std::string& file, Model& model, Mistakes& mistakes,
                                      const std::string& option) {
  std::vector<JointRow> rows;
  Mistakes of_file(file);
  if (const auto text = read_text_file(file, of_file)) {
    const std::size_t begin = text->find_first_not_of(" \t\r\n");
    const bool is_json = begin != text->npos && ((*text)[begin] == '[' || (*text)[begin] == '{');
    rows = is_json ? rows_of_json(*text, model, of_file) : rows_of_csv(*text, model, of_file);
    if (rows.empty() && of_file.none()) of_file.add("must have rows of values");
  }
  if (of_file.none()) leave_out_mimics(rows, model);
  for (const std::string& message : of_file.messages()) mistakes.add(option + ": " + message);
  return rows;
}

}  // namespace minkray
