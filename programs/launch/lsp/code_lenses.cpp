// SPDX-License-Identifier: Apache-2.0
// What an editor shows above a launch file: commands for it, and how much it starts.
#include <fmt/format.h>

#include "programs/launch/lsp/features.hpp"

namespace launch::lsp {

Json code_lenses(const Reading& reading, std::optional<std::size_t> processes) {
  const bool has_root = !reading.outline.elements.empty();
  const Span root = has_root ? reading.outline.elements.front().tag_span : Span{0, 0};
  const Json range = reading.document.range(root.begin, root.end);
  const auto lens = [&](const std::string& title, const char* command) {
    return Json{{"range", range}, {"command", {{"title", title}, {"command", command}, {"arguments", {reading.path}}}}};
  };
  Json lenses = {lens("run", "launch.run"), lens("check", "launch.check")};
  if (processes) {
    lenses.push_back(lens(fmt::format("{} process{}", *processes, *processes == 1 ? "" : "es"), "launch.graph"));
  }
  return lenses;
}

}  // namespace launch::lsp
