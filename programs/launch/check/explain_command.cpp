// SPDX-License-Identifier: Apache-2.0
// `launch explain`: tells what the findings of `launch check` mean, and the reasoning of those of `launch report`.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "base/text/ascii.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/check/finding_table.hpp"
#include "programs/launch/command_functions.hpp"
#include "tracing/model/finding_kinds/finding_kinds.hpp"

namespace launch {

namespace {

constexpr std::size_t kColumns = 100;  // of a paragraph

std::string_view severity_name(Severity severity) {
  return severity == Severity::kError ? "error" : "warning";
}

std::string wrapped(std::string_view text) {
  std::string result;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (column != 0 && column + 1 + word.size() > kColumns) {
      result += "\n";
      column = 0;
    }
    result += (column == 0 ? "" : " ");
    result += word;
    column += word.size() + (column == 0 ? 0 : 1);
  }
  return result + "\n";
}

std::string indented(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    result += line.empty() ? "\n" : fmt::format("    {}\n", line);
    text.remove_prefix(end + 1);
  }
  return result;
}

std::string explanation(const FindingInfo& info) {
  std::string text = fmt::format("{}: {} ({})\n\n{}\nExample:\n\n{}", finding_id(info.finding), info.title,
                                 severity_name(info.severity), wrapped(info.explanation), indented(info.example));
  if (!info.parameter_file.empty()) {
    text += fmt::format("\nparams.yaml:\n\n{}", indented(info.parameter_file));
  }
  return text;
}

// "Drifting timer" of a report is "drifting_timer" in its JSON; either is understood, in upper or lower case.
const tracing::FindingWords* find_words(std::string_view name) {
  const auto plain = [](std::string_view text) {
    std::string result = lower(text);
    std::replace(result.begin(), result.end(), ' ', '_');
    return result;
  };
  const auto found = std::find_if(std::begin(tracing::kFindingWords), std::end(tracing::kFindingWords),
                                  [&](const tracing::FindingWords& words) {
                                    return plain(name) == words.name || plain(name) == plain(words.title);
                                  });
  return found == std::end(tracing::kFindingWords) ? nullptr : found;
}

std::string list() {
  std::string text;
  for (const FindingInfo& info : finding_table()) {
    text += fmt::format("{}  {:7}  {}\n", finding_id(info.finding), severity_name(info.severity), info.title);
  }
  text += "\nof launch report:\n";
  for (const tracing::FindingWords& words : tracing::kFindingWords) {
    text += fmt::format("{:20} {}\n", words.name, words.title);
  }
  return text;
}

std::string_view language_of(std::string_view example) {
  return example.front() == '<' ? "xml" : example.starts_with("launch:") ? "yaml" : "python";
}

std::string page() {
  std::string text =
      "# Findings of launch check\n\n"
      "`launch explain --markdown` prints this page, and `launch explain ID` one section of it. An error of an action\n"
      "that its condition leaves out is a warning. Unknown names and missing attributes are errors there, too.\n"
      "`launch check --disable ID` leaves a finding out.\n";
  for (const FindingInfo& info : finding_table()) {
    text +=
        fmt::format("\n## {}: {}\n\nSeverity: {}.\n\n{}\n```{}\n{}```\n", finding_id(info.finding), info.title,
                    severity_name(info.severity), wrapped(info.explanation), language_of(info.example), info.example);
    if (!info.parameter_file.empty()) {
      text += fmt::format("\n`params.yaml`:\n\n```yaml\n{}```\n", info.parameter_file);
    }
  }
  return text;
}

}  // namespace

Words finding_words(const Words& /*words*/) {
  Words ids;
  for (const FindingInfo& info : finding_table()) {
    ids.push_back(finding_id(info.finding));
  }
  for (const tracing::FindingWords& words_of : tracing::kFindingWords) {
    ids.emplace_back(words_of.name);
  }
  return ids;
}

int explain_command(const Words& words) {
  std::string id;
  bool markdown = false;
  Subcommand command(
      "launch explain",
      "Explains a finding of launch check, with an example, or one of launch report. Without an id: lists "
      "all.");
  command.take_text("id", id, "id of the finding, such as LF0101, or its name: drifting_timer");
  command.take_flag("--markdown", markdown, "all explanations as a page");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  ResultOutput result("launch explain");
  if (markdown) {
    result.print(page());
  } else if (id.empty()) {
    result.print(list());
  } else if (const tracing::FindingWords* const of_report = find_words(id)) {
    result.print(fmt::format("{}: {}\n\n{}", of_report->name, of_report->title, wrapped(of_report->explanation)));
  } else if (const auto finding = find_finding(id)) {
    result.print(explanation(finding_info(*finding)));
  } else {
    print_usage_error(unknown_finding(id), "launch explain");
    return kWrongCommandLine;
  }
  return result.finish() ? 0 : 1;
}

}  // namespace launch
