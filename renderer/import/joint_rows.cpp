// SPDX-License-Identifier: MIT
// Reads rows of joint values: CSV with names in its first line, or JSON.
#include <algorithm>
#include <set>
#include <unordered_map>

#include "renderer/base/csv.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

/// Limit of reported mistakes: a file with more has one mistake many times.
constexpr std::size_t most_mistakes = 20;

/// In each row each link, joint and shape of the model has its place. Ten minutes of a humanoid at
/// a thousand rows per second have a fifth of these.
constexpr std::size_t most_keys = 100'000'000;

class RowReader {
 public:
  RowReader(Model& model, Mistakes& of_file, double rows_per_second)
      : model_(model),
        of_file_(of_file),
        rows_per_second_(rows_per_second),
        joints_(joints_by_name(model)) {
    size_ = std::max(model.links.size(), model.geoms.size());
    std::size_t joints = 0;
    for (const ModelLink& link : model.links) joints += link.joints.size();
    size_ = std::max<std::size_t>({size_, joints, 1});
    most_ = std::max<std::size_t>(most_keys / size_, 1);
  }

  std::vector<JointRow> read(std::string_view text) {
    text = without_byte_order_mark(text);
    const std::string_view content = without_blanks(text);
    if (content.starts_with('[') || content.starts_with('{'))
      read_json(text);
    else
      read_csv(text);
    if (rows_.empty() && of_file_.none()) of_file_.add("must have rows of values");
    if (of_file_.none()) leave_out_mimics();
    return std::move(rows_);
  }

 private:
  bool has_most_mistakes() const { return of_file_.messages().size() >= most_mistakes; }

  const ModelJoint* joint_of(const std::string& name) const {
    const auto found = joints_.find(name);
    return found == joints_.end() ? nullptr : found->second;
  }

  std::string complaint_of_count(const std::string& got) const {
    return "must have at most " + std::to_string(most_) + " rows, for a model of " +
           std::to_string(size_) + " links, shapes or joints (got " + got + ")";
  }

  void read_csv(std::string_view text) {
    CsvLines lines(text, LastComma::ends_line);
    const std::vector<std::string> names(lines.cells().begin(), lines.cells().end());
    // Joints of several numbers take several columns of their name.
    std::unordered_map<std::string, std::size_t> columns;
    for (const std::string& name : names) ++columns[name];
    std::set<std::string> told;
    for (const std::string& name : names) {
      if (has_most_mistakes() || !told.insert(name).second) continue;
      const std::string column = "line 1: column \"" + printable(name, 60) + "\": ";
      const ModelJoint* joint = name == "time" ? nullptr : joint_of(name);
      const std::size_t width = joint ? width_of(joint->kind) : 1;
      if (name != "time" && !joint)
        of_file_.add(column + "no joint has this name");
      else if (columns[name] > 1 && width == 1)
        of_file_.add(column + "duplicate (given " + std::to_string(columns[name]) + " times)");
      else if (columns[name] != width)
        of_file_.add(column + "must be given " + std::to_string(width) +
                     " times, once for each number of the joint (got " +
                     std::to_string(columns[name]) + ")");
    }
    JointRow pattern;
    std::unordered_map<std::string, std::size_t> places;
    std::vector<std::size_t> place_of_column;
    for (const std::string& name : names) {
      const auto [at, is_new] = places.try_emplace(name, pattern.values.size());
      if (is_new && name != "time") pattern.values.push_back({name, {}});
      place_of_column.push_back(at->second);
    }
    while (!has_most_mistakes() && lines.next()) {
      const std::string where = "line " + std::to_string(lines.number()) + ": ";
      const std::vector<std::string_view>& cells = lines.cells();
      if (rows_.size() == most_) return of_file_.add(where + complaint_of_count("one more"));
      if (cells.size() != names.size()) {
        of_file_.add(where + "must have " + std::to_string(names.size()) + " cells (got " +
                     std::to_string(cells.size()) + ")");
        continue;
      }
      JointRow row = pattern;
      row.time = time_of_next();
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto value = finite_number(cells[c]);
        if (!value) {
          of_file_.add(where + "must be finite numbers (got \"" + printable(cells[c], 40) + "\")");
          break;
        }
        if (names[c] == "time")
          row.time = *value;
        else
          row.values[place_of_column[c]].second.push_back(*value);
      }
      if (!rows_.empty() && !(row.time > rows_.back().time))
        of_file_.add(where + "times must increase");
      rows_.push_back(std::move(row));
    }
  }

  void read_json(std::string_view text) {
    const auto json = parse_json(text, of_file_);
    if (!json) return;
    if (!json->is_array()) return add_row(*json, JsonPath());
    if (json->size() > most_) return of_file_.add(complaint_of_count(std::to_string(json->size())));
    for (std::size_t i = 0; i < json->size() && !has_most_mistakes(); ++i)
      add_row((*json)[i], JsonPath() / i);
  }

  /// {"time": 0.5, "elbow": 1.2, "ball": [1, 0, 0, 0]}
  void add_row(const Json& json, const JsonPath& path) {
    if (!json.is_object()) return of_file_.add(path, "must be an object (" + found(json) + ")");
    JointRow row{time_of_next(), {}};
    for (const auto& [name, value] : json.members()) {
      const JsonPath at = path / name;
      if (name == "time") {
        row.time = read_number(value, at, of_file_).value_or(row.time);
        continue;
      }
      const ModelJoint* joint = joint_of(name);
      if (!joint) {
        of_file_.add(at, "no joint has this name");
        continue;
      }
      const std::size_t width = width_of(joint->kind);
      if (width == 1 && !value.is_array()) {
        if (const auto number = read_number(value, at, of_file_))
          row.values.push_back({name, {*number}});
      } else if (auto numbers = read_numbers(value, at, of_file_, width)) {
        row.values.emplace_back(name, std::move(*numbers));
      }
    }
    if (!rows_.empty() && !(row.time > rows_.back().time))
      of_file_.add(path / "time", "must increase");
    rows_.push_back(std::move(row));
  }

  double time_of_next() const { return static_cast<double>(rows_.size()) / rows_per_second_; }

  /// Files that were recorded have joints that follow others, too.
  void leave_out_mimics() {
    for (JointRow& row : rows_)
      std::erase_if(row.values, [&](const auto& value) {
        const ModelJoint* joint = joint_of(value.first);
        if (!joint->mimic) return false;
        model_.pass_over("values of the joint \"" + printable(value.first, 60) + "\"",
                         "it follows \"" + printable(joint->mimic->joint, 60) + "\"");
        return true;
      });
  }

  Model& model_;
  Mistakes& of_file_;
  const double rows_per_second_;
  const JointsByName joints_;
  std::size_t size_ = 1, most_ = 1;  ///< of the model; of rows
  std::vector<JointRow> rows_;
};

}  // namespace

std::vector<JointRow> read_joint_rows(const std::string& file, Model& model, Mistakes& mistakes,
                                      const std::string& option, double rows_per_second) {
  std::vector<JointRow> rows;
  Mistakes of_file(file);
  if (const auto text = read_text_file(file, of_file))
    rows = RowReader(model, of_file, rows_per_second).read(*text);
  for (const std::string& message : of_file.messages()) mistakes.add(option + ": " + message);
  return rows;
}

}  // namespace minkray
