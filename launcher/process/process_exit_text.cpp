// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/process_exit_text.hpp"

#include <fmt/format.h>
#include <string.h>

#include <chrono>

namespace launch {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

std::string end_of(const ProcessExit& exit) {
  if (exit.code >= 0) {
    return fmt::format("exit code {}", exit.code);
  }
  const char* const name = ::sigabbrev_np(-exit.code);
  return (name == nullptr ? fmt::format("signal {}", -exit.code) : fmt::format("SIG{}", name)) +
         (exit.core_dumped ? ", core dumped," : "");
}

std::string describe(const ProcessExit& exit) {
  constexpr double kKibPerMib = 1024.0;
  return fmt::format("{} after {:.2f} s, with {:.2f} s of processor time and {:.1f} MiB", end_of(exit),
                     std::chrono::duration<double>(exit.ran_for).count(),
                     seconds(exit.usage.ru_utime) + seconds(exit.usage.ru_stime),
                     static_cast<double>(exit.usage.ru_maxrss) / kKibPerMib);
}

}  // namespace launch
