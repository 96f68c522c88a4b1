// SPDX-License-Identifier: MIT
#include "renderer/arguments/preview.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string_view>

#include "core/support/named_kind.h"
#include "renderer/cli/options.h"
#include "renderer/io/terminal_picture.h"

namespace minkray {
namespace {

constexpr NamedKind<TerminalGraphics> protocols[] = {{TerminalGraphics::kitty, "kitty", ""},
                                                     {TerminalGraphics::sixel, "sixel", ""},
                                                     {TerminalGraphics::blocks, "blocks", ""}};

/// Width of a terminal that does not report it.
constexpr int usual_columns = 80;

int terminal_columns() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return usual_columns;
}

bool has_kitty_graphics() {
  const auto variable = [](const char* name) -> std::string_view {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
  };
  return !variable("KITTY_WINDOW_ID").empty() || variable("TERM") == "xterm-kitty" ||
         variable("TERM") == "xterm-ghostty" || variable("TERM_PROGRAM") == "WezTerm";
}

constexpr int answer_milliseconds = 200;

/// Returns the terminal's response to "primary device attributes" (ECMA-48, 8.3.24): its abilities
/// as numbers; empty if there is no response.
std::string device_attributes() {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0) return "";
  termios before{};
  if (tcgetattr(STDIN_FILENO, &before) != 0) return "";
  termios silent = before;
  silent.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  if (tcsetattr(STDIN_FILENO, TCSANOW, &silent) != 0) return "";
  std::cout << "\x1b[c" << std::flush;
  std::string answer;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  for (char c = 0; c != 'c' && poll(&input, 1, answer_milliseconds) == 1;) {
    if (read(STDIN_FILENO, &c, 1) != 1) break;
    answer += c;
  }
  tcsetattr(STDIN_FILENO, TCSANOW, &before);
  return answer;
}

TerminalGraphics best_protocol() {
  if (isatty(STDOUT_FILENO) == 0) return TerminalGraphics::blocks;
  if (has_kitty_graphics()) return TerminalGraphics::kitty;
  const std::string answer = device_attributes();
  const bool has_sixels =
      answer.find(";4;") != std::string::npos || answer.find(";4c") != std::string::npos;
  return has_sixels ? TerminalGraphics::sixel : TerminalGraphics::blocks;
}

}  // namespace

void PreviewArguments::add_to(const Verb& verb) {
  std::vector<std::string> names = names_in(protocols);
  names.insert(names.begin(), "auto");
  verb.add_flag("--preview{auto}", preview,
                "Also show the picture in the terminal (auto: the best protocol that the "
                "terminal supports)")
      .one_of(names);
}

void show_preview(const Image& picture, const PreviewArguments& arguments, PreviewPlace place) {
  if (arguments.preview.empty()) return;
  const bool is_on_screen = place == PreviewPlace::top_of_screen;
  if (is_on_screen && isatty(STDOUT_FILENO) == 0) return;
  if (is_on_screen) std::cout << "\x1b[H\x1b[2J";
  const NamedKind<TerminalGraphics>* const named = row_named(protocols, arguments.preview);
  const TerminalGraphics graphics = named ? named->kind : best_protocol();
  std::cout << terminal_picture(picture, graphics, terminal_columns()) << std::flush;
}

}  // namespace minkray
