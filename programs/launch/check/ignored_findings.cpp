// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/check/ignored_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include "programs/launch/check/finding_table.hpp"

namespace launch {

namespace {

constexpr std::string_view kMark = "launch: ignore";
constexpr std::string_view kForm = "write launch: ignore LF0501: REASON";

// One id of a comment.
struct Ignored {
  Finding finding;
  std::uint32_t first_line;
  std::uint32_t last_line;
  SourceRange where;  // of the id
  bool used = false;
};

struct Comments {
  std::vector<Ignored> ignored;
  std::vector<Diagnostic> wrong;
};

// The comment that begins at `at`, without its marks. nullopt when none begins there.
std::optional<std::string_view> comment_at(std::string_view text, std::size_t at) {
  const bool xml = text.substr(at).starts_with("<!--");
  if (!xml && text[at] != '#') {
    return std::nullopt;
  }
  const std::size_t begin = at + (xml ? 4 : 1);
  return text.substr(begin, std::min(text.find(xml ? "-->" : "\n", begin), text.size()) - begin);
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r") == std::string_view::npos;
}

class Reader {
 public:
  explicit Reader(const std::shared_ptr<const SourceFile>& file) : file_(file), text_(file->text()) {}

  Comments read() {
    for (std::size_t mark = text_.find(kMark); mark != std::string_view::npos; mark = text_.find(kMark, mark + 1)) {
      const std::size_t last = mark == 0 ? std::string_view::npos : text_.find_last_not_of(" \t", mark - 1);
      if (last == std::string_view::npos) {
        continue;
      }
      const std::size_t begin = text_[last] == '#' ? last : last >= 3 ? last - 3 : last;
      if (const auto comment = comment_at(text_, begin)) {
        take(begin, *comment, mark + kMark.size());
      }
    }
    return std::move(comments_);
  }

 private:
  SourceRange range(std::size_t begin, std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }

  void wrong(std::string message, std::size_t begin, std::size_t end, std::string help = std::string(kForm)) {
    comments_.wrong.push_back(
        {Severity::kWarning, std::move(message), range(begin, end), std::move(help), Finding::kUselessIgnore});
  }

  // `at` stands behind the mark.
  void take(std::size_t begin, std::string_view comment, std::size_t at) {
    const std::size_t end = static_cast<std::size_t>(comment.data() - text_.data()) + comment.size();
    const std::uint32_t line = file_->position(end).line;
    const std::size_t line_begin = text_.rfind('\n', begin) + 1;
    const std::size_t line_end = std::min(text_.find('\n', end), text_.size());
    const std::string_view behind = text_.substr(end, line_end - end);
    const bool alone = is_blank(text_.substr(line_begin, begin - line_begin)) &&
                       is_blank(behind.starts_with("-->") ? behind.substr(3) : behind);
    const std::size_t colon = std::min(text_.find(':', at), end);
    if (is_blank(text_.substr(std::min(colon + 1, end), end - std::min(colon + 1, end)))) {
      wrong("a comment that ignores findings gives no reason", at - kMark.size(), colon);
    }
    std::size_t ids = 0;
    while (at < colon) {
      const std::size_t id_begin = std::min(text_.find_first_not_of(" \t,", at), colon);
      const std::size_t id_end = std::min(text_.find_first_of(" \t,\r\n:", id_begin), colon);
      at = id_end;
      if (id_begin == id_end) {
        break;
      }
      ++ids;
      const std::string id(text_.substr(id_begin, id_end - id_begin));
      if (const std::optional<Finding> finding = find_finding(id)) {
        comments_.ignored.push_back(
            {*finding, file_->position(begin).line, alone ? line + 1 : line, range(id_begin, id_end)});
      } else {
        const LaunchError error = unknown_finding(id);
        wrong(error.diagnostics().front().message, id_begin, id_end, error.diagnostics().front().help);
      }
    }
    if (ids == 0) {
      wrong("a comment that ignores findings names none", at - kMark.size(), at);
    }
  }

  std::shared_ptr<const SourceFile> file_;
  std::string_view text_;
  Comments comments_;
};

}  // namespace

void leave_out_ignored(const std::shared_ptr<const SourceFile>& file, std::vector<Diagnostic>& found) {
  std::map<std::string, Comments> comments;  // by the path of the file
  const auto of = [&](const std::shared_ptr<const SourceFile>& one) -> Comments& {
    std::error_code ignored;
    const auto [known, added] = comments.try_emplace(std::filesystem::weakly_canonical(one->path(), ignored).string());
    if (added) {
      known->second = Reader(one).read();
    }
    return known->second;
  };
  std::erase_if(found, [&](const Diagnostic& diagnostic) {
    if (!diagnostic.where) {
      return false;
    }
    const std::uint32_t line = diagnostic.where.file->position(diagnostic.where.begin).line;
    bool ignored = false;
    for (Ignored& one : of(diagnostic.where.file).ignored) {
      if (one.finding == diagnostic.finding && one.first_line <= line && line <= one.last_line) {
        one.used = true;
        ignored = true;
      }
    }
    return ignored;
  });
  if (file == nullptr) {
    return;
  }
  Comments& own = of(file);
  found.insert(found.end(), own.wrong.begin(), own.wrong.end());
  for (const Ignored& one : own.ignored) {
    if (!one.used) {
      found.push_back({Severity::kWarning, fmt::format("there is no {} here to ignore", finding_id(one.finding)),
                       one.where, "a comment is for its own line and for the next one; remove it",
                       Finding::kUselessIgnore});
    }
  }
}

}  // namespace launch
