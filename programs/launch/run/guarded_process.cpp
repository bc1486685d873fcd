// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/run/guarded_process.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/processes/process_mark.hpp"
#include "launcher/python/interpreter/python_watch.hpp"

namespace launch {

Containment contain(const CommandLine& command) {
  try {
    return contain_this_process(command.words, Guardian::default_program());
  } catch (const std::system_error& error) {
    throw std::runtime_error(
        fmt::format("--contain needs a process namespace, which this machine does not allow: {}", error.what()));
  }
}

Guardian guard_this_process(const CommandLine& command, const Isolation& isolation, Containment containment) {
  std::vector<int> held;
  if (isolation.domain) {
    held.push_back(isolation.domain->fd());  // it may still end processes of the domain when the launcher has gone
  }
  if (containment.alive) {
    held.push_back(containment.alive.get());
  }
  Guardian guardian =
      Guardian::put_above(command.words, Guardian::default_program(), held, std::move(containment.records));
  static_cast<void>(containment.alive.release());  // until the end of this process
  const std::string mark = guardian.mark("launch", {});
  ::setenv(kMarkVariable, mark.c_str() + std::string_view(kMarkVariable).size() + 1, 1);
  return guardian;
}

void watch_python(const CommandLine& command, const Guardian& guardian) {
  const std::chrono::seconds limit(command.python.seconds);
  watch_python_of_a_run({.memory = guardian.python_at_work(),
                         .traces = guardian.python_traces(),
                         .own_descriptor = guardian.records(),
                         .call_limit = command.python.seconds_given ? std::optional(limit) : std::nullopt,
                         .expression_limit = limit,
                         .expression_memory = command.python.memory});
}

}  // namespace launch
