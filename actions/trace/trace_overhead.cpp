// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/trace_overhead.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "base/diagnostics/diagnostic.hpp"
#include "tracing/record/plan/event_classes.hpp"

namespace launch {

double perform_percentage(const Template& text, Scope& scope) {
  const std::string given = text.perform(scope);
  double percent = 0;
  const char* const end = given.data() + given.size();
  const auto read = std::from_chars(given.data(), end, percent);
  if (read.ec != std::errc() || std::string_view(read.ptr, end) != "%" || !(percent > 0)) {
    throw LaunchError(
        fmt::format("max-overhead is expected to be a percentage of a processor like 2%, got '{}'", given),
        text.where());
  }
  return percent / 100;
}

void check_drop_order(const std::vector<std::string>& order, const SourceRange& where) {
  const std::vector<std::string>& known = tracing::droppable_classes();
  for (const std::string& name : order) {
    if (name.find(':') == std::string::npos && std::find(known.begin(), known.end(), name) == known.end()) {
      throw LaunchError(fmt::format("there is no class of events '{}'", name), where,
                        fmt::format("drop-order takes {}, or events as PROVIDER:NAME", fmt::join(known, ", ")));
    }
  }
}

}  // namespace launch
