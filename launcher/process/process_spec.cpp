// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/process_spec.hpp"

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

}  // namespace launch
