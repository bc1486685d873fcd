// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/health_watch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/overloaded.hpp"

namespace launch {

std::string_view kind_of(const HealthWatch& watch) {
  return std::visit(Overloaded{
                        [](const ExecutorProgress&) { return "executor"; },
                        [](const OutputLines&) { return "output"; },
                        [](const NotBlocked&) { return "blocked"; },
                        [](const CommandSucceeds&) { return "command"; },
                        [](const TopicIsPublished&) { return "topic"; },
                        [](const ServiceAnswers&) { return "service"; },
                        [](const LifecycleState&) { return "lifecycle"; },
                        [](const PortAccepts&) { return "port"; },
                        [](const Notifies&) { return "notify"; },
                        [](const MemoryStays&) { return "memory"; },
                        [](const LoadStays&) { return "load"; },
                    },
                    watch.subject);
}

std::string address_of(const PortAccepts& port) {
  if (port.protocol == PortAccepts::Protocol::kUnix) {
    return port.socket;
  }
  const bool has_colons = port.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", has_colons ? "[" : "", port.host, has_colons ? "]" : "", port.port);
}

std::string size_text(std::uint64_t bytes) {
  constexpr double kMebi = 1024.0 * 1024.0;
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / kMebi);
}

std::string_view to_string(OnUnhealthy reaction) {
  switch (reaction) {
    case OnUnhealthy::kNothing:
      return "none";
    case OnUnhealthy::kRestart:
      return "restart";
    case OnUnhealthy::kSignal:
      return "signal";
    case OnUnhealthy::kShutdown:
      return "shutdown";
  }
  return "";
}

std::string describe(const HealthWatch& watch) {
  const double timeout = std::chrono::duration<double>(watch.timeout).count();
  std::string text = std::visit(
      Overloaded{
          [&](const ExecutorProgress&) { return fmt::format("its executors never stand still for {} s", timeout); },
          [&](const OutputLines& lines) {
            return fmt::format(
                "it prints {}{} at least every {} s",
                lines.pattern.empty() ? "a line" : fmt::format("a line that matches '{}'", lines.pattern),
                lines.stream == "both" ? "" : " on " + lines.stream, timeout);
          },
          [&](const NotBlocked&) { return fmt::format("it is never blocked for {} s", timeout); },
          [&](const CommandSucceeds& command) {
            return fmt::format("'{}' ends with 0 within {} s", fmt::join(command.argv, " "), timeout);
          },
          [&](const TopicIsPublished& topic) {
            return topic.min_rate > 0
                       ? fmt::format("'{}' has at least {} messages a second, over {} s", topic.topic, topic.min_rate,
                                     timeout)
                       : fmt::format("a message comes on '{}' at least every {} s", topic.topic, timeout);
          },
          [&](const ServiceAnswers& service) {
            return fmt::format("the service '{}' answers within {} s", service.service, timeout);
          },
          [&](const LifecycleState& state) {
            return fmt::format("'{}' is {}, and says so within {} s", state.node, state.state, timeout);
          },
          [&](const PortAccepts& port) {
            return port.protocol == PortAccepts::Protocol::kUdp
                       ? fmt::format("it has the UDP port {}", port.port)
                       : fmt::format("{} accepts connections within {} s", address_of(port), timeout);
          },
          [&](const Notifies& notifies) {
            return fmt::format("it says within {} s that it is ready{}", timeout,
                               notifies.watchdog ? ", and then as often that it lives" : "");
          },
          [&](const MemoryStays& memory) {
            std::string limits;
            if (memory.most) {
              limits = fmt::format("does not have more than {} of memory", size_text(*memory.most));
            }
            if (memory.most_growth) {
              limits += fmt::format("{}does not grow by more than {}", limits.empty() ? "" : " and ",
                                    size_text(*memory.most_growth));
            }
            return fmt::format("it {} for {} s", limits, timeout);
          },
          [&](const LoadStays& load) {
            return fmt::format("it uses at most {:.0f} % of a processor, over {} s", load.most * 100, timeout);
          },
      },
      watch.subject);
  if (watch.failures > 1) {
    text += fmt::format(", {} failures in a row", watch.failures);
  }
  return watch.reaction == OnUnhealthy::kNothing ? text : fmt::format("{}; else {}", text, to_string(watch.reaction));
}

}  // namespace launch
