// SPDX-License-Identifier: Apache-2.0
// The probe of each kind of watch.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "base/overloaded.hpp"
#include "launcher/health/answer_probe.hpp"
#include "launcher/health/blocked_probe.hpp"
#include "launcher/health/command_probe.hpp"
#include "launcher/health/executor_probe.hpp"
#include "launcher/health/health_monitor.hpp"
#include "launcher/health/notify_probe.hpp"
#include "launcher/health/output_probe.hpp"
#include "launcher/health/port_probe.hpp"
#include "launcher/health/topic_probe.hpp"
#include "launcher/health/usage_probe.hpp"

namespace launch {
namespace {

ProcessSpec helper_of(const ProcessSpec& spec, const CommandSucceeds& command, const HealthWatch& watch) {
  ProcessSpec helper;
  helper.name = spec.name;
  helper.argv = command.argv;
  helper.environment = spec.environment;
  helper.working_directory = spec.working_directory;
  helper.traced = false;
  helper.origin = watch.where;
  return helper;
}

}  // namespace

std::unique_ptr<HealthProbe> HealthMonitor::make_probe(const HealthWatch& watch, ProcessSpec& spec, ProcessId id,
                                                       std::size_t number) {
  const auto later = [this, id, number](const Look& look) { answer(id, number, look); };
  const auto of_graph = [&](RosRequest request) {
    return GraphWatch(ros_client_, std::move(request), spec.environment);
  };
  using Made = std::unique_ptr<HealthProbe>;
  const Overloaded make{
      [&](const ExecutorProgress&) -> Made {
        const ProgressMemory::Place place = memory_.add();
        spec.environment.insert_or_assign(executor_progress::kVariable, place.text);
        return std::make_unique<ExecutorProbe>(*place.page, watch.timeout);
      },
      [&](const OutputLines& lines) -> Made {
        return std::make_unique<OutputProbe>(OutputPattern(lines.pattern, watch.where, lines.stream, watch.where),
                                             watch.timeout);
      },
      [&](const NotBlocked&) -> Made { return std::make_unique<BlockedProbe>(watch.timeout); },
      [&](const CommandSucceeds& command) -> Made {
        return std::make_unique<CommandProbe>(loop_, supervisor_.runner(), helper_of(spec, command, watch),
                                              watch.timeout, later);
      },
      [&](const TopicIsPublished& topic) -> Made {
        return std::make_unique<TopicProbe>(of_graph(MeterTopic{topic.topic, watch.interval}), topic, watch.timeout);
      },
      [&](const ServiceAnswers& service) -> Made {
        return std::make_unique<AnswerProbe>(of_graph(AskService{service.service, watch.interval}), service.service, "",
                                             watch.timeout);
      },
      [&](const LifecycleState& state) -> Made {
        return std::make_unique<AnswerProbe>(of_graph(AskState{state.node, watch.interval}), state.node + "/get_state",
                                             state.state, watch.timeout);
      },
      [&](const PortAccepts& port) -> Made { return std::make_unique<PortProbe>(loop_, port, watch.timeout, later); },
      [&](const MemoryStays& memory) -> Made {
        return std::make_unique<MemoryProbe>(memory, watch.timeout, watch.start_period);
      },
      [&](const LoadStays& load) -> Made { return std::make_unique<LoadProbe>(load, watch.timeout); },
      [&](const Notifies& notifies) -> Made { return make_notify_probe(watch, notifies.watchdog, spec, id, number); },
  };
  return std::visit(make, watch.subject);
}

std::unique_ptr<HealthProbe> HealthMonitor::make_notify_probe(const HealthWatch& watch, bool watchdog,
                                                              ProcessSpec& spec, ProcessId id, std::size_t number) {
  const std::string socket = fmt::format("{}/notify-{}-{}", supervisor_.files_directory(), id, number);
  auto probe = std::make_unique<NotifyProbe>(
      loop_, socket, watchdog, watch.timeout,
      NotifyProbe::Callbacks{[this, id, number](const Look& look) { answer(id, number, look); },
                             [this, id](const std::string& text) { supervisor_.set_status(id, text); }});
  spec.environment.insert_or_assign("NOTIFY_SOCKET", socket);
  spec.environment.erase("WATCHDOG_PID");
  if (watchdog) {
    const auto microseconds = std::chrono::duration_cast<std::chrono::microseconds>(watch.timeout).count();
    spec.environment.insert_or_assign("WATCHDOG_USEC", std::to_string(microseconds));
  }
  return probe;
}

}  // namespace launch
