// SPDX-License-Identifier: MIT
#include "bench/image/report.h"

#include <iomanip>
#include <ostream>
#include <sstream>

namespace minkray::bench {
namespace {

constexpr int name_width = 32, entry_width = 13;

std::string number(double value, int digits = 3) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string percent(std::size_t part, std::size_t all) {
  return all == 0 ? "-"
                  : number(100.0 * static_cast<double>(part) / static_cast<double>(all)) + "%";
}

std::ostream& cell(std::ostream& out, const std::string& text, int width = 11) {
  return out << std::right << std::setw(width) << text;
}

}  // namespace

void print(std::ostream& out, const CastResults& results) {
  out << "\n"
      << results.count << " " << results.rays << ", of which " << number(100 * results.hit_rate)
      << "% hit; one thread\n"
      << std::left << std::setw(name_width + entry_width) << "";
  for (const char* head : {"ns a ray", "ratio", "one hits", "other", "dt median", "dt 99%"})
    cell(out, head);
  out << "\n";
  for (const CastSpeed& speed : results.speeds) {
    const Agreement& a = speed.agreement;
    out << std::left << std::setw(name_width) << speed.contender << std::setw(entry_width)
        << speed.entry;
    cell(out, number(speed.nanoseconds, 4));
    cell(out, number(speed.ratio));
    cell(out, percent(a.only_one, a.rays));
    cell(out, percent(a.other_instance, a.hits));
    cell(out, number(a.typical, 2));
    cell(out, number(a.most_of_all, 2)) << "\n";
  }
  out << std::flush;
}

void print(std::ostream& out, const std::vector<ImageTime>& times) {
  out << std::left << std::setw(name_width + entry_width) << "";
  for (const char* head :
       {"build s", "ratio", "trace s", "ratio", "Mray/s", "image", "MB", "heap MB", "picture"})
    cell(out, head, 10);
  out << "\n";
  for (const ImageTime& time : times) {
    out << std::left << std::setw(name_width) << time.contender << std::setw(entry_width)
        << time.entry;
    cell(out, number(time.build_seconds), 10);
    cell(out, number(time.build_ratio), 10);
    cell(out, number(time.trace_seconds), 10);
    cell(out, number(time.trace_ratio), 10);
    cell(out, number(static_cast<double>(time.rays) / time.trace_seconds / 1e6), 10);
    cell(out, number(time.image_ratio), 10);
    cell(out, number(static_cast<double>(time.bytes) / 1e6, 4), 10);
    cell(out, number(static_cast<double>(time.heap_bytes) / 1e6, 4), 10);
    cell(out, number(time.picture_difference, 2), 10) << "\n";
  }
  out << std::flush;
}

void print(std::ostream& out, const std::vector<Goal>& goals) {
  out << "\n| measure | asked | measured | |\n|---|---|---|---|\n";
  for (const Goal& goal : goals)
    out << "| " << goal.what << " | " << goal.asked << " | " << number(goal.measured) << " | "
        << (goal.met() ? "met" : "missed") << " |\n";
  out << std::flush;
}

Json as_json(const CastResults& results) {
  Json list = Json::array();
  for (const CastSpeed& speed : results.speeds) {
    const Agreement& a = speed.agreement;
    list.push_back({{"tracer", speed.contender},
                    {"entry", speed.entry},
                    {"ns_per_ray", speed.nanoseconds},
                    {"ratio", speed.ratio},
                    {"only_one_hits", a.only_one},
                    {"other_instance", a.other_instance},
                    {"dt_median", a.typical},
                    {"dt_p99", a.most_of_all}});
  }
  return {{"rays", results.rays},
          {"count", results.count},
          {"hit_rate", results.hit_rate},
          {"tracers", std::move(list)}};
}

Json as_json(const std::vector<ImageTime>& times) {
  Json list = Json::array();
  for (const ImageTime& time : times)
    list.push_back({{"tracer", time.contender},
                    {"entry", time.entry},
                    {"build_seconds", time.build_seconds},
                    {"hierarchy_seconds", time.hierarchy_seconds},
                    {"trace_seconds", time.trace_seconds},
                    {"ratios",
                     {{"build", time.build_ratio},
                      {"hierarchy", time.hierarchy_ratio},
                      {"trace", time.trace_ratio},
                      {"image", time.image_ratio}}},
                    {"rays", time.rays},
                    {"mrays_per_second", static_cast<double>(time.rays) / time.trace_seconds / 1e6},
                    {"bytes", time.bytes},
                    {"heap_bytes", time.heap_bytes},
                    {"picture_difference", time.picture_difference}});
  return list;
}

Json as_json(const std::vector<Goal>& goals) {
  Json list = Json::array();
  for (const Goal& goal : goals)
    list.push_back({{"measure", goal.what},
                    {"asked", goal.asked},
                    {"measured", goal.measured},
                    {"met", goal.met()}});
  return list;
}

}  // namespace minkray::bench
