// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/process_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace launch {

std::optional<OutputRouting> OutputRouting::from_mode(std::string_view mode) {
  if (mode == "screen") {
    return OutputRouting{.out = {.screen = true}, .err = {.screen = true}};
  }
  if (mode == "log") {
    return OutputRouting{.out = {.log = true}, .err = {.screen = true, .log = true}};
  }
  if (mode == "both") {
    return OutputRouting{.out = {.screen = true, .log = true}, .err = {.screen = true, .log = true}};
  }
  if (mode == "own_log") {
    return OutputRouting{.out = {.own_log = true}, .err = {.own_log = true}};
  }
  if (mode == "full") {
    return OutputRouting{.out = {.screen = true, .log = true, .own_log = true},
                         .err = {.screen = true, .log = true, .own_log = true}};
  }
  return std::nullopt;
}

std::vector<std::string> limits_of(const ProcessSpec& spec) {
  std::vector<std::string> limits = describe(spec.limits);
  std::ranges::move(describe(spec.control_limits), std::back_inserter(limits));
  for (const std::shared_ptr<const ControlGroup>& group : spec.control_groups) {
    for (const std::string& limit : describe(group->limits)) {
      limits.push_back(fmt::format("{} together with its group ({})", limit, to_string(group->where)));
    }
  }
  return limits;
}

}  // namespace launch
