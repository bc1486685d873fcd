// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/fault_request.hpp"

#include <fmt/format.h>
#include <string.h>

#include <chrono>

namespace launch {

namespace {

struct Describer {
  const std::string& process;

  std::string operator()(const KillFault& kill) const {
    const char* const name = ::sigabbrev_np(kill.signal);
    const std::string signal = name == nullptr ? fmt::format("signal {}", kill.signal) : fmt::format("SIG{}", name);
    return fmt::format("kill of '{}'{}", process, kill.signal == SIGKILL ? "" : " by " + signal);
  }
  std::string operator()(const StopFault&) const { return fmt::format("stop of '{}'", process); }
  std::string operator()(const SlowFault& slow) const {
    return fmt::format("slow of '{}' to {}%", process, slow.percent);
  }
  std::string operator()(const LimitFault& limit) const {
    std::string text = fmt::format("limit of '{}' to ", process);
    if (limit.memory) {
      text += fmt::format("{} bytes{}", *limit.memory, limit.files ? " and " : "");
    }
    return limit.files ? text + fmt::format("{} files", *limit.files) : text;
  }
};

}  // namespace

std::string describe(const FaultRequest& fault) {
  std::string text = std::visit(Describer{fault.process}, fault.what);
  if (fault.lasts) {
    text += fmt::format(" for {:g} s", std::chrono::duration<double>(*fault.lasts).count());
  }
  return text;
}

}  // namespace launch
