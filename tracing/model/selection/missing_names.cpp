// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/selection/missing_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/diagnostics/diagnostic.hpp"

namespace tracing {
namespace {

constexpr std::size_t kMostNames = 20;

}  // namespace

std::string nothing_is_called(std::string_view kind, const std::vector<std::string>& patterns,
                              const std::vector<std::string>& names) {
  std::string text = fmt::format("no {} is called '{}'; what was read has ", kind, fmt::join(patterns, "' or '"));
  if (names.empty()) {
    return text + fmt::format("no {}{}", kind, kind.ends_with('s') ? "es" : "s");
  }
  const std::size_t told = std::min(names.size(), kMostNames);
  text += fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(told), ", "));
  if (told < names.size()) {
    text += fmt::format(" and {} more", names.size() - told);
  }
  const std::string help = patterns.empty() ? "" : launch::did_you_mean(patterns.front(), names);
  return help.empty() ? text : text + "; " + help;
}

}  // namespace tracing
