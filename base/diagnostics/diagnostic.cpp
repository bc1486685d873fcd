// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/text/names.hpp"
#include "base/text/utf8.hpp"

namespace launch {

namespace {

// The include chain shows at most this many files: a file that includes itself has a chain of hundreds.
constexpr int kShownIncludes = 8;

// A character cell of the shown line.
struct Cell {
  std::string text;        // what is printed, UTF-8
  std::size_t width = 1;   // columns on the terminal
  std::size_t offset = 0;  // byte of the line that it shows
};

constexpr std::size_t kTabWidth = 4;
constexpr std::size_t kMaximumWidth = 100;       // columns of source text shown
constexpr std::size_t kContextBeforeCaret = 40;  // columns kept before the caret when a line is cut
constexpr std::size_t kLookedAt = 1024;          // bytes before and after the caret: more than is shown of a line
constexpr std::string_view kEllipsis = "...";
constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD, for bytes that are not UTF-8

struct Style {
  std::string_view place, severity, message, gutter, caret, help, reset;
};

Style style_of(Severity severity, bool colour) {
  if (!colour) {
    return {};
  }
  const bool error = severity == Severity::kError;
  return {"\x1b[1m",  error ? "\x1b[1;31m" : "\x1b[1;35m", "\x1b[1m",
          "\x1b[34m", error ? "\x1b[1;31m" : "\x1b[1;35m", "\x1b[1;36m",
          "\x1b[0m"};
}

// The number of columns that a terminal uses for a character. The ranges are Unicode's East Asian Width "W" and "F".
std::size_t display_width(char32_t c) {
  if (c >= 0x300 && c <= 0x36F) {
    return 0;
  }
  const bool wide = (c >= 0x1100 && c <= 0x115F) || (c >= 0x2E80 && c <= 0xA4CF) || (c >= 0xAC00 && c <= 0xD7A3) ||
                    (c >= 0xF900 && c <= 0xFAFF) || (c >= 0xFE30 && c <= 0xFE6F) || (c >= 0xFF00 && c <= 0xFF60) ||
                    (c >= 0x1F300 && c <= 0x1F64F) || (c >= 0x1F900 && c <= 0x1F9FF) || (c >= 0x20000 && c <= 0x3FFFD);
  return wide ? 2 : 1;
}

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t offset = 0; offset < line.size();) {
    const CodePoint point = decode_utf8(line.substr(offset));
    const bool control = point.value < 0x20 || point.value == 0x7F || (point.value >= 0x80 && point.value < 0xA0);
    if (line[offset] == '\t') {
      cells.push_back({std::string(kTabWidth, ' '), kTabWidth, offset});
    } else if (!point.valid || control) {
      // Control characters would move the caret, or worse, steer the terminal.
      cells.push_back({std::string(kReplacement), 1, offset});
    } else {
      cells.push_back({std::string(line.substr(offset, point.size)), display_width(point.value), offset});
    }
    offset += point.size;
  }
  return cells;
}

// The line and the caret under bytes [begin, end) of it, cut to kMaximumWidth.
struct Excerpt {
  std::string text;
  std::string indent;
  std::string caret;
};

Excerpt excerpt_of(std::string_view line, std::size_t begin, std::size_t end) {
  std::size_t start = begin > kLookedAt ? begin - kLookedAt : 0;
  while (start > 0 && is_continuation_byte(line[start])) {
    --start;
  }
  line = line.substr(start, begin - start + kLookedAt);
  begin -= start;
  end = std::min(end - start, line.size());
  const std::vector<Cell> cells = cells_of(line);
  const auto first_at = [&](std::size_t offset) {
    return static_cast<std::size_t>(
        std::find_if(cells.begin(), cells.end(), [&](const Cell& cell) { return cell.offset >= offset; }) -
        cells.begin());
  };
  const auto width = [&](std::size_t from, std::size_t to) {
    std::size_t sum = 0;
    for (std::size_t i = from; i < to; ++i) {
      sum += cells[i].width;
    }
    return sum;
  };
  const std::size_t caret_first = first_at(begin);
  const std::size_t caret_last = std::max(first_at(end), caret_first);

  std::size_t shown_first = 0;
  std::size_t shown_last = cells.size();
  if (width(0, cells.size()) > kMaximumWidth) {
    shown_first = caret_first;
    while (shown_first > 0 && width(shown_first - 1, caret_first) <= kContextBeforeCaret) {
      --shown_first;
    }
    shown_last = shown_first;
    for (std::size_t columns = 0; shown_last < cells.size(); ++shown_last) {
      columns += cells[shown_last].width;
      if (columns > kMaximumWidth) {
        break;
      }
    }
  }

  Excerpt excerpt;
  if (shown_first > 0) {
    excerpt.text = kEllipsis;
    excerpt.indent = std::string(kEllipsis.size(), ' ');
  }
  for (std::size_t i = shown_first; i < shown_last; ++i) {
    excerpt.text += cells[i].text;
  }
  if (shown_last < cells.size()) {
    excerpt.text += kEllipsis;
  }
  excerpt.indent += std::string(width(shown_first, caret_first), ' ');
  const std::size_t caret_width = width(caret_first, std::min(caret_last, shown_last));
  excerpt.caret = "^" + std::string(caret_width > 1 ? caret_width - 1 : 0, '~');
  return excerpt;
}

std::string help_line(std::string_view help, const Style& style) {
  return help.empty() ? "" : fmt::format("      {}= help:{} {}\n", style.help, style.reset, help);
}

std::string plain(const std::vector<Diagnostic>& diagnostics) {
  std::string text = render(diagnostics);
  if (!text.empty()) {
    text.pop_back();  // what() is printed with a line end of its own
  }
  return text;
}

}  // namespace

LaunchError::LaunchError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(plain(diagnostics)), diagnostics_(std::move(diagnostics)) {}

LaunchError::LaunchError(std::string message, SourceRange where, std::string help, Finding finding)
    : LaunchError(
          std::vector<Diagnostic>{{Severity::kError, std::move(message), std::move(where), std::move(help), finding}}) {
}

void LaunchError::classify(Finding finding) {
  for (Diagnostic& diagnostic : diagnostics_) {
    if (diagnostic.finding == Finding::kNone) {
      diagnostic.finding = finding;
    }
  }
}

std::string render(const Diagnostic& diagnostic, bool colour, std::string_view command) {
  const Style style = style_of(diagnostic.severity, colour);
  const SourceRange& where = diagnostic.where;
  std::string result;
  if (where) {
    result += fmt::format("{}{}:{} ", style.place, to_string(where), style.reset);
  } else if (!command.empty()) {
    result += fmt::format("{}{}:{} ", style.place, command, style.reset);
  }
  result +=
      fmt::format("{}{}:{} {}{}{}\n", style.severity, diagnostic.severity == Severity::kError ? "error" : "warning",
                  style.reset, style.message, diagnostic.message, style.reset);
  if (where) {
    const SourceFile& file = *where.file;
    const std::uint32_t number = file.position(where.begin).line;
    const std::string_view line = file.line(number);
    const auto line_begin = static_cast<std::size_t>(line.data() - file.text().data());
    const std::size_t begin = std::min<std::size_t>(where.begin - line_begin, line.size());
    const std::size_t end = std::min<std::size_t>(std::max(where.end, where.begin) - line_begin, line.size());
    const Excerpt excerpt = excerpt_of(line, begin, end);
    result += fmt::format("{}{:>5} |{} {}\n", style.gutter, number, style.reset, excerpt.text);
    result += fmt::format("{}      |{} {}{}{}{}\n", style.gutter, style.reset, excerpt.indent, style.caret,
                          excerpt.caret, style.reset);
  }
  result += help_line(diagnostic.help, style);
  if (where) {
    int shown = 0;
    for (SourceRange from = where.file->included_from(); from; from = from.file->included_from()) {
      if (++shown <= kShownIncludes) {
        result += fmt::format("      {}= included from{} {}\n", style.help, style.reset, to_string(from));
      }
    }
    if (shown > kShownIncludes) {
      result += fmt::format("      {}= and from{} {} more\n", style.help, style.reset, shown - kShownIncludes);
    }
  }
  return result;
}

std::string render(const std::vector<Diagnostic>& diagnostics, bool colour, std::string_view command) {
  std::string result;
  for (const Diagnostic& diagnostic : diagnostics) {
    result += render(diagnostic, colour, command);
  }
  return result;
}

std::string help_line(std::string_view help) {
  return help_line(help, Style());
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? nearest : fmt::format("did you mean '{}'?", nearest);
}

}  // namespace launch
