// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/top/top_screen.hpp"

#define NCURSES_NOMACROS 1
#include <fmt/format.h>
#include <langinfo.h>
#include <locale.h>
#include <ncurses.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "programs/launch/steer/process_text.hpp"

// Its header, term.h, makes macros of names such as `lines`.
extern "C" char* tigetstr(const char* name);

namespace launch {
namespace {

constexpr int kHeadingLines = 2;  // the heading, and the names of the columns
constexpr int kFootLines = 2;     // a message or what is typed, and the keys
constexpr int kEscapeDelay = 25;  // milliseconds after which ESC is a key of its own

// `text` in exactly `width` columns.
std::string fit(const std::string& text, std::size_t width) {
  std::string cut;
  std::size_t columns = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
    if (begins && columns == width) {
      break;
    }
    columns += begins ? 1 : 0;
    cut += text[i];
  }
  return cut + std::string(width - columns, ' ');
}

// Names differ at the end more often than at the beginning: "driver-17" and "driver-18".
std::string fit_name(const std::string& name, std::size_t width) {
  if (columns_of(name) <= width) {
    return fit(name, width);
  }
  const std::size_t head = width / 3;
  std::size_t begin = name.size();
  for (std::size_t tail = 0; tail + head + 1 < width; ++tail) {
    do {
      --begin;
    } while ((static_cast<unsigned char>(name[begin]) & 0xC0U) == 0x80U);
  }
  static const bool has_dots = std::string_view(::nl_langinfo(CODESET)) == "UTF-8";
  return fit(name, head) + (has_dots ? "…" : "~") + name.substr(begin);
}

// "45.0 MiB", or with its share of a limit "45.0M  70%".
std::string memory_column(const TopRow& row) {
  std::string text = memory_text(row.memory);
  if (row.memory_share < 0) {
    return text;
  }
  const std::size_t unit = text.find(' ');
  return fmt::format("{}{} {:>3.0f}%", text.substr(0, unit), text[unit + 1], 100 * row.memory_share);
}

std::string line_of(const TopRow& row, std::size_t name_width) {
  return fmt::format("{} {} {:>8} {:>6} {:>10} {:>8} {:>8}  {}", fit_name(row.name, name_width), fit(row.state, 18),
                     row.pid.empty() ? "-" : row.pid, row.pid.empty() ? "-" : fmt::format("{:.1f}", row.cpu),
                     row.pid.empty() ? "-" : memory_column(row), row.restarts, fmt::format("{:.0f}", row.lines),
                     row.place);
}

}  // namespace

TopScreen::TopScreen() {
  const char* const type = std::getenv("TERM");
  if (type == nullptr || *type == '\0' || std::string_view(type) == "dumb") {
    throw std::runtime_error(
        "nothing can be drawn on this terminal (TERM is 'dumb' or empty); 'launch ps' prints a table");
  }
  ::setlocale(LC_ALL, "");
  if (::newterm(nullptr, stdout, stdin) == nullptr) {
    throw std::runtime_error("the terminal is not known, see the variable TERM");
  }
  ::cbreak();
  ::noecho();
  ::nodelay(stdscr, true);
  ::keypad(stdscr, true);
  ::set_escdelay(kEscapeDelay);
  ::curs_set(0);
}

TopScreen::~TopScreen() {
  ::endwin();
  // Without a screen of its own, the view stays there, and what follows would be written into its last line.
  if (const char* const leaves = ::tigetstr("rmcup"); leaves == nullptr || leaves == reinterpret_cast<char*>(-1)) {
    ::fputs("\n", stdout);
    ::fflush(stdout);
  }
}

std::size_t TopScreen::height() const {
  return static_cast<std::size_t>(std::max(::getmaxy(stdscr) - kHeadingLines - kFootLines, 1));
}

std::size_t TopScreen::width() const {
  return static_cast<std::size_t>(std::max(::getmaxx(stdscr), 1));
}

void TopScreen::put(int line, const std::string& text, int attributes) {
  ::wattrset(stdscr, attributes);
  ::mvwaddstr(stdscr, line, 0, fit(text, width()).c_str());
  ::wattrset(stdscr, 0);
}

void TopScreen::draw_table(const TopView& view) {
  std::size_t name_width = 12;
  for (const TopRow& row : view.rows) {
    name_width = std::max(name_width, columns_of(row.name));
  }
  // The figures shall fit into 80 columns.
  name_width = std::min<std::size_t>(name_width, static_cast<std::size_t>(std::max(::getmaxx(stdscr) - 64, 12)));
  put(1,
      fmt::format("{} {} {:>8} {:>6} {:>10} {:>8} {:>8}  PLACE", fit("NAME", name_width), fit("STATE", 18), "PID",
                  "CPU %", "MEMORY", "RESTARTS", "LINES/S"),
      A_REVERSE);
  const std::size_t rows = height();
  first_ = std::min(first_, view.selected);
  first_ = std::max(first_, view.selected + 1 > rows ? view.selected + 1 - rows : 0);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t row = first_ + i;
    put(static_cast<int>(i) + kHeadingLines, row < view.rows.size() ? line_of(view.rows[row], name_width) : "",
        row < view.rows.size() && row == view.selected ? A_BOLD | A_REVERSE : 0);
  }
}

void TopScreen::draw_lines(const TopView& view) {
  put(1, view.title, A_REVERSE);
  const std::size_t rows = height();
  const std::size_t scrolled = std::min(view.scrolled, view.lines.size());
  const std::size_t end = view.from_beginning ? view.lines.size() : view.lines.size() - scrolled;
  const std::size_t begin = view.from_beginning ? scrolled : end > rows ? end - rows : 0;
  for (std::size_t i = 0; i < rows; ++i) {
    put(static_cast<int>(i) + kHeadingLines, begin + i < end ? view.lines[begin + i] : "");
  }
}

void TopScreen::draw(const TopView& view) {
  put(0, view.heading, A_BOLD);
  if (view.title.empty()) {
    draw_table(view);
  } else {
    draw_lines(view);
  }
  const int last = ::getmaxy(stdscr) - 1;
  put(last - 1, view.prompt.empty() ? view.message : view.prompt + view.input + "_");
  // Not the whole line: some terminals scroll when their last cell is written.
  ::mvwaddstr(stdscr, last, 0, fit(view.keys, static_cast<std::size_t>(std::max(::getmaxx(stdscr) - 1, 1))).c_str());
  ::wrefresh(stdscr);
}

int TopScreen::key() {
  const int read = ::wgetch(stdscr);
  switch (read) {
    case ERR:
      return kNone;
    case KEY_UP:
      return kUp;
    case KEY_DOWN:
      return kDown;
    case KEY_PPAGE:
      return kPageUp;
    case KEY_NPAGE:
      return kPageDown;
    case KEY_HOME:
      return kHome;
    case KEY_END:
      return kEnd;
    case KEY_ENTER:
    case '\n':
    case '\r':
      return kEnter;
    case '\033':
      return kEscape;
    case KEY_BACKSPACE:
    case '\b':
    case '\x7f':
      return kBackspace;
    case KEY_RESIZE:
      ::wclear(stdscr);
      return kResize;
    default:
      return read;
  }
}

}  // namespace launch
