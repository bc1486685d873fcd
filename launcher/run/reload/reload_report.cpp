// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/reload/reload_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace launch {
namespace {

constexpr std::size_t kNamed = 5;  // processes in one line

void add(std::vector<std::string>& parts, const std::vector<ReloadReport::Line>& lines, const char* one,
         const char* several) {
  if (lines.empty()) {
    return;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < lines.size() && i < kNamed; ++i) {
    names.push_back(lines[i].process);
  }
  parts.push_back(fmt::format("{} {} ({}{})", lines.size(), lines.size() == 1 ? one : several, fmt::join(names, ", "),
                              lines.size() > kNamed ? ", …" : ""));
}

}  // namespace

std::string summary(const ReloadReport& report) {
  std::vector<std::string> parts;
  add(parts, report.ends, "ends", "end");
  add(parts, report.restarts, "restarts", "restart");
  add(parts, report.sets, "gets parameters", "get parameters");
  add(parts, report.takes_over, "takes over its settings", "take over their settings");
  add(parts, report.starts, "starts", "start");
  parts.push_back(fmt::format("{} {} as {}", report.stays, report.stays == 1 ? "stays" : "stay",
                              report.stays == 1 ? "it is" : "they are"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace launch
