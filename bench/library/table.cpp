// SPDX-License-Identifier: MIT
#include "table.h"

namespace bench {
namespace {

std::string text_of(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string nanoseconds(const Caster& caster, std::size_t count) {
  return text_of("%.0f ns", 1e9 * caster.seconds / static_cast<double>(count));
}

}  // namespace

const char* Table::head() {
  return "| what | rays | Minkray | peer | figure | goal | | answers | hash |\n"
         "|---|---|---|---|---|---|---|---|---|\n";
}

void Table::add(const Duel& duel) {
  const std::vector<Answer> ours = duel.ours.answers();
  add(Figure{duel.what, duel.rays, nanoseconds(duel.ours, duel.count),
             nanoseconds(duel.peer, duel.count) + ", " + duel.peer_name + duel.peer.name,
             duel.peer.seconds / duel.ours.seconds, duel.goal, false,
             compare(ours, duel.peer.answers(), duel.trust), hash_of(ours)});
}

void Table::add(const Figure& figure) {
  const bool met = figure.goal == 0 ||
                   (figure.at_most ? figure.value <= figure.goal : figure.value >= figure.goal);
  const char* const verdict = !figure.agreement.holds ? "DISAGREE"
                              : figure.goal == 0      ? ""
                              : met                   ? "ok"
                                                      : "MISS";
  all_good_ = all_good_ && met && figure.agreement.holds;
  const std::string goal =
      figure.goal == 0 ? "" : (figure.at_most ? "<= " : ">= ") + text_of("%g", figure.goal);
  std::fprintf(out_, "| %s | %s | %s | %s | %s | %s | %s | %s | %08x |\n", figure.what.c_str(),
               figure.rays.c_str(), figure.measured.c_str(), figure.peer.c_str(),
               text_of(figure.value < 100 ? "%.2f" : "%.0f", figure.value).c_str(), goal.c_str(),
               verdict, figure.agreement.text.c_str(), figure.hash);
  std::fflush(out_);
}

std::string with_commas(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

}  // namespace bench
