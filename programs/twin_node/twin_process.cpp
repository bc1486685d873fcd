// SPDX-License-Identifier: Apache-2.0
#include "programs/twin_node/twin_process.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <queue>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <string>
#include <thread>
#include <utility>

#include "programs/twin_node/processor_time.hpp"

namespace twin_node {

using tracing::twin::Callback;
using tracing::twin::Executor;
using tracing::twin::kNone;

namespace {

// Of shorter runs the processor time is not asked: that takes a microsecond, and hardly any of them is interrupted.
constexpr std::int64_t kLong = 20'000;

rclcpp::QoS qos_of(const tracing::twin::Qos& qos) {
  rclcpp::QoS result = qos.depth == 0 ? rclcpp::QoS(rclcpp::KeepAll()) : rclcpp::QoS(rclcpp::KeepLast(qos.depth));
  return qos.reliable ? result.reliable() : result.best_effort();
}

std::shared_ptr<rclcpp::Executor> make_executor(const Executor& executor) {
  switch (executor.kind) {
    case Executor::Kind::kMulti:
      return std::make_shared<rclcpp::executors::MultiThreadedExecutor>(rclcpp::ExecutorOptions(), executor.threads);
    case Executor::Kind::kEvents:
      return std::make_shared<rclcpp::experimental::executors::EventsExecutor>();
    case Executor::Kind::kSingle:
      break;
  }
  return std::make_shared<rclcpp::executors::SingleThreadedExecutor>();
}

}  // namespace

TwinProcess::TwinProcess(const tracing::twin::System& system, Index process)
    : system_(system), process_(process), rules_(system), quick_(system), sendings_(system.callbacks.size()) {
  add_nodes();
  add_groups();
  add_ends();
  add_callbacks();
}

void TwinProcess::add_nodes() {
  for (Index index = 0; index < system_.nodes.size(); ++index) {
    const tracing::twin::Node& node = system_.nodes[index];
    if (node.process != process_) {
      continue;
    }
    const std::size_t slash = node.name.rfind('/');
    const std::string place = slash == 0 ? "/" : node.name.substr(0, slash);
    nodes_[index] = std::make_shared<rclcpp::Node>(node.name.substr(slash + 1), place,
                                                   rclcpp::NodeOptions().use_intra_process_comms(node.intra_process));
  }
}

void TwinProcess::add_groups() {
  for (Index index = 0; index < system_.executors.size(); ++index) {
    if (system_.executors[index].process == process_) {
      executors_[index] = make_executor(system_.executors[index]);
    }
  }
  for (Index index = 0; index < system_.groups.size(); ++index) {
    const tracing::twin::Group& group = system_.groups[index];
    if (!nodes_.contains(group.node)) {
      continue;
    }
    const auto type =
        group.reentrant ? rclcpp::CallbackGroupType::Reentrant : rclcpp::CallbackGroupType::MutuallyExclusive;
    groups_[index] = nodes_.at(group.node)->create_callback_group(type, false);
    executors_.at(group.executor)->add_callback_group(groups_[index], nodes_.at(group.node)->get_node_base_interface());
  }
  // What each node has of its own, such as the services of parameters.
  for (const auto& [index, node] : nodes_) {
    const auto group = std::find_if(system_.groups.begin(), system_.groups.end(),
                                    [wanted = index](const auto& other) { return other.node == wanted; });
    (group == system_.groups.end() ? executors_.begin()->second : executors_.at(group->executor))->add_node(node);
  }
}

void TwinProcess::add_ends() {
  // The header of the bytes, the length of the text and its end.
  constexpr std::uint64_t kFrame = 9;
  for (Index index = 0; index < system_.publishers.size(); ++index) {
    const tracing::twin::Publisher& publisher = system_.publishers[index];
    if (nodes_.contains(publisher.node)) {
      const tracing::twin::Topic& topic = system_.topics[publisher.topic];
      publishers_[index] = nodes_.at(publisher.node)->create_publisher<Message>(topic.name, qos_of(publisher.qos));
      messages_[publisher.topic].data.resize(std::max(topic.bytes, kFrame) - kFrame);
    }
  }
  for (Index index = 0; index < system_.clients.size(); ++index) {
    const tracing::twin::Client& client = system_.clients[index];
    if (!nodes_.contains(client.node)) {
      continue;
    }
    rclcpp::CallbackGroup::SharedPtr group;
    for (Index callback = 0; callback < system_.callbacks.size(); ++callback) {
      if (system_.callbacks[callback].kind == Callback::Kind::kClient && system_.callbacks[callback].client == index) {
        answers_[index] = callback;
        group = groups_.at(system_.callbacks[callback].group);
      }
    }
    clients_[index] =
        nodes_.at(client.node)->create_client<Service>(client.service, rclcpp::ServicesQoS(), std::move(group));
  }
}

void TwinProcess::add_callbacks() {
  for (Index index = 0; index < system_.callbacks.size(); ++index) {
    const Callback& callback = system_.callbacks[index];
    if (!groups_.contains(callback.group)) {
      continue;
    }
    const rclcpp::CallbackGroup::SharedPtr& group = groups_.at(callback.group);
    rclcpp::Node& node = *nodes_.at(system_.groups[callback.group].node);
    switch (callback.kind) {
      case Callback::Kind::kTimer: {
        const auto timer = node.create_wall_timer(
            std::chrono::nanoseconds(callback.period_ns), [this, index] { run(index); }, group);
        timer->cancel();
        kept_.push_back(timer);
        // One that never ran was cancelled in the system, too.
        if (callback.runs > 0) {
          timers_.push_back({timer, callback.period_ns, callback.phase_ns});
        }
        break;
      }
      case Callback::Kind::kSubscription: {
        rclcpp::SubscriptionOptions options;
        options.callback_group = group;
        kept_.push_back(node.create_subscription<Message>(
            system_.topics[callback.topic].name, qos_of(callback.qos), [this, index](const Message&) { run(index); },
            options));
        break;
      }
      case Callback::Kind::kService:
        kept_.push_back(node.create_service<Service>(
            callback.service,
            [this, index](const Service::Request::SharedPtr&, const Service::Response::SharedPtr&) { run(index); },
            rclcpp::ServicesQoS(), group));
        break;
      case Callback::Kind::kClient:
        break;
    }
  }
}

void TwinProcess::run(Index index) {
  const std::int64_t begin_ns = monotonic_ns();
  const Callback& callback = system_.callbacks[index];
  std::int64_t drawn_ns = 0;
  const std::vector<std::size_t>* outputs = nullptr;
  tracing::twin::Run run;
  if (quick_.knows(index)) {
    const tracing::twin::QuickRuns::Run next = quick_.next(index);
    drawn_ns = next.time_ns;
    outputs = next.outputs;
  } else {
    const std::lock_guard lock(rules_mutex_);
    run = rules_.next_run(index);
    drawn_ns = run.time_ns;
    outputs = run.outputs.empty() ? nullptr : &run.outputs;
  }
  const Work work(begin_ns, system_.processor_times && drawn_ns > kLong);
  std::int64_t time_ns = drawn_ns;
  const double share = 1 - callback.blocked;
  const auto work_until = [&](std::int64_t all_ns, double part) {
    work.until(std::llround(static_cast<double>(all_ns) * share * part) - callback.overhead_ns);
  };
  if (outputs != nullptr) {
    std::int64_t sending_ns = 0;
    for (const std::size_t output : *outputs) {
      work_until(drawn_ns, callback.outputs[output].called);
      const std::int64_t begin = monotonic_ns();
      send(callback.outputs[output]);
      sending_ns += monotonic_ns() - begin;
    }
    time_ns = time_of_run(index, sending_ns, drawn_ns);
  }
  work_until(time_ns, 1);
  if (const auto sleep = std::llround(static_cast<double>(time_ns) * callback.blocked); sleep > 0) {
    sleep_for(sleep);
  }
}

// A recorded time has in it what sending took, and sending takes the stand-in a time of its own, which is sometimes
// short and sometimes long. Were both drawn, a run would take the longer one. So a run in which sending is among the
// slowest takes a time that was among the slowest.
std::int64_t TwinProcess::time_of_run(Index callback, std::int64_t sending_ns, std::int64_t drawn_ns) {
  constexpr std::size_t kEnough = 16;
  const std::lock_guard lock(rules_mutex_);
  Sendings& sendings = sendings_[callback];
  if (sendings.times.size() < Sendings::kMost) {
    sendings.times.push_back(sending_ns);
  } else {
    sendings.times[sendings.next] = sending_ns;
    sendings.next = (sendings.next + 1) % Sendings::kMost;
  }
  if (sendings.times.size() < kEnough) {
    return drawn_ns;
  }
  const auto faster =
      std::count_if(sendings.times.begin(), sendings.times.end(), [&](std::int64_t time) { return time < sending_ns; });
  return system_.callbacks[callback].run_times.quantile((static_cast<double>(faster) + 0.5) /
                                                        static_cast<double>(sendings.times.size()));
}

void TwinProcess::send(const tracing::twin::Output& output) {
  for (std::size_t count = 0; count < output.times; ++count) {
    if (output.publisher != kNone) {
      publishers_.at(output.publisher)->publish(messages_.at(system_.publishers[output.publisher].topic));
    } else if (const auto& client = clients_.at(output.client); client->service_is_ready()) {
      const auto answer = answers_.find(output.client);
      client->async_send_request(std::make_shared<Service::Request>(),
                                 [this, callback = answer == answers_.end() ? kNone : answer->second](
                                     const rclcpp::Client<Service>::SharedFuture&) {
                                   if (callback != kNone) {
                                     run(callback);
                                   }
                                 });
    }
  }
}

void TwinProcess::start_timers() {
  // All processes reckon from the same time: the start of the clock. So timers keep their distance. On a busy machine a
  // timer may be set too late, and then two that were apart would run at the same time: it is set once more.
  struct Start {
    std::int64_t time_ns;
    const Timer* timer;
    int tries;
    bool operator<(const Start& other) const { return time_ns > other.time_ns; }
  };
  // Longer ones begin at once: nobody waits for them.
  constexpr std::int64_t kLongest = 2'000'000'000;
  constexpr std::int64_t kNear = 100'000;
  constexpr std::int64_t kAhead = 300'000;
  constexpr int kTries = 10;
  const std::int64_t now = monotonic_ns();
  std::priority_queue<Start> starts;
  for (const Timer& timer : timers_) {
    const std::int64_t since = (now - timer.phase_ns) % timer.period_ns;
    starts.push({timer.period_ns > kLongest ? now : now - since + timer.period_ns, &timer, 0});
  }
  while (!starts.empty() && rclcpp::ok()) {
    const Start start = starts.top();
    starts.pop();
    sleep_until(start.time_ns - kAhead);  // a thread wakes up late
    while (monotonic_ns() < start.time_ns) {
    }
    start.timer->timer->reset();
    if (monotonic_ns() - start.time_ns > kNear && start.tries < kTries && start.timer->period_ns <= kLongest) {
      start.timer->timer->cancel();
      const std::int64_t periods = (monotonic_ns() - start.time_ns) / start.timer->period_ns + 1;
      starts.push({start.time_ns + periods * start.timer->period_ns, start.timer, start.tries + 1});
    }
  }
}

void TwinProcess::spin() {
  std::vector<std::thread> threads;
  for (auto executor = std::next(executors_.begin()); executor != executors_.end(); ++executor) {
    threads.emplace_back([executor] { executor->second->spin(); });
  }
  threads.emplace_back([this] { start_timers(); });
  executors_.begin()->second->spin();
  for (std::thread& thread : threads) {
    thread.join();
  }
}

}  // namespace twin_node
