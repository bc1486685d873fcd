// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/output_tail.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace launch {

void OutputTail::add(const std::string& label, std::string_view line) {
  Lines& lines = processes_[label];
  std::string kept(line.substr(0, kLineLength));
  if (line.size() > kLineLength) {
    while (!kept.empty() && (static_cast<unsigned char>(line[kept.size()]) & 0xC0U) == 0x80U) {
      kept.pop_back();  // not within a character
    }
    kept += "…";
  }
  lines.last.push_back(std::move(kept));
  if (lines.last.size() > kLines) {
    lines.last.pop_front();
  }
  ++lines.count;
  lines.time = ++count_;
}

void OutputTail::show(Failure& failure, const std::vector<std::string>& labels) const {
  std::vector<std::pair<std::string, const Lines*>> shown;
  for (const auto& [label, lines] : processes_) {
    if (labels.empty() || std::find(labels.begin(), labels.end(), label) != labels.end()) {
      shown.emplace_back(label, &lines);
    }
  }
  if (labels.empty() && shown.size() > kShownProcesses) {
    std::sort(shown.begin(), shown.end(), [](const auto& a, const auto& b) { return a.second->time > b.second->time; });
    shown.resize(kShownProcesses);
    std::sort(shown.begin(), shown.end());
  }
  if (shown.empty()) {
    return;
  }
  std::vector<std::string> names;
  for (const auto& [label, lines] : shown) {
    names.push_back(label);
    for (const std::string& line : lines->last) {
      failure.evidence.push_back(shown.size() == 1 ? line : fmt::format("[{}] {}", label, line));
    }
  }
  failure.evidence_title = fmt::format("last lines of {}", fmt::join(names, ", "));
}

}  // namespace launch
