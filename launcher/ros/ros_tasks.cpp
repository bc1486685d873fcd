// SPDX-License-Identifier: Apache-2.0
#include "launcher/ros/ros_tasks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "launcher/ros/ros_protocol.hpp"

namespace launch {

namespace {

constexpr const char* kLoadLogger = "launch_ros.actions.load_composable_nodes";
constexpr const char* kLifecycleLogger = "launch_ros.utilities.lifecycle_event_manager";

// The target of load_composable_node may lack the first slash: relative names are those of the root namespace.
std::string absolute(const std::string& name) {
  return name.starts_with('/') ? name : "/" + name;
}

std::string node_of(const LoadRequest& request) {
  return absolute(request.target);
}
std::string node_of(const TransitionRequest& request) {
  return absolute(request.node);
}

std::size_t steps_of(const LoadRequest& request) {
  return request.nodes.size();
}
std::size_t steps_of(const TransitionRequest& request) {
  return request.transitions.size();
}

RosRequest ros_request(const LoadRequest& request, std::size_t step) {
  return LoadNode{node_of(request), request.nodes[step]};
}
RosRequest ros_request(const TransitionRequest& request, std::size_t step) {
  return ChangeState{node_of(request), request.transitions[step]};
}

const SourceRange& place_of(const LoadRequest& request, std::size_t step) {
  return request.nodes[step].origin;
}
const SourceRange& place_of(const TransitionRequest& request, std::size_t) {
  return request.origin;
}

const char* logger_of(const LoadRequest&) {
  return kLoadLogger;
}
const char* logger_of(const TransitionRequest&) {
  return kLifecycleLogger;
}

// The error message of a container may end with a line end.
std::string without_line_end(std::string text) {
  while (text.ends_with('\n')) {
    text.pop_back();
  }
  return text;
}

}  // namespace

RosTasks::RosTasks(LaunchContext& context, EventLoop& loop, std::function<void()> idle,
                   std::function<void(const LaunchError&)> failed)
    : context_(context), loop_(loop), idle_(std::move(idle)), failed_(std::move(failed)) {}

void RosTasks::start(std::vector<LoadRequest> loads, std::vector<TransitionRequest> transitions) {
  if (context_.ros_client() == nullptr && !(loads.empty() && transitions.empty())) {
    failed_(LaunchError("there is no ROS client to load components and change states",
                        loads.empty() ? transitions.front().origin : loads.front().origin));
    return;
  }
  for (LoadRequest& request : loads) {
    add(std::move(request));
  }
  for (TransitionRequest& request : transitions) {
    add(std::move(request));
  }
}

void RosTasks::forget(const std::string& container, const ComposableNode& node, const Environment& environment,
                      bool unload, std::function<void()> done) {
  const std::string owner = absolute(container);
  const std::string text = text_of(node);
  const auto drop_from = [&](LoadRequest& load) {
    const auto found = std::find_if(load.nodes.begin(), load.nodes.end(),
                                    [&](const ComposableNode& each) { return text_of(each) == text; });
    return found != load.nodes.end() && (load.nodes.erase(found), true);
  };
  for (Request& request : repeated_[owner]) {
    if (auto* const load = std::get_if<LoadRequest>(&request); load != nullptr && drop_from(*load)) {
      break;
    }
  }
  const auto loaded = loaded_.extract({owner, identity_of(node)});
  if (!unload || loaded.empty() || context_.ros_client() == nullptr) {
    done();
    return;
  }
  const auto place = unloads_.insert(unloads_.end(), nullptr);
  *place = context_.ros_client()->ask(
      UnloadNode{owner, loaded.mapped()}, environment, kPatience,
      [this, place, name = node.name, container, done = std::move(done)](const RosAnswer& answer) {
        const EventLoop::SourcePtr answered = std::move(*place);
        const std::function<void()> then = done;
        if (!answer.ok) {
          context_.message(LogLevel::kWarning, kLoadLogger,
                           fmt::format("Failed to unload node '{}' from container '{}': {}", name, container,
                                       without_line_end(answer.error)));
        }
        unloads_.erase(place);
        then();
        if (idle()) {
          idle_();
        }
      });
}

void RosTasks::forget(const TransitionRequest& transition) {
  const auto found = repeated_.find(node_of(transition));
  if (found != repeated_.end()) {
    std::erase_if(found->second, [&](const Request& request) {
      const auto* const known = std::get_if<TransitionRequest>(&request);
      return known != nullptr && known->transitions == transition.transitions;
    });
  }
}

std::string text_of(const ComposableNode& node) {
  return to_line(RosRequestLine{0, LoadNode{"", node}, Duration(0)}) + (node.autostart ? "autostart" : "");
}

std::string identity_of(const ComposableNode& node) {
  return fmt::format("{} {} {} {}", node.package, node.plugin, node.name_space, node.name);
}

void RosTasks::name_process(ProcessId process, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (name.starts_with('/')) {
      nodes_[process] = name;
    }
  }
}

void RosTasks::on_skipped(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (name.starts_with('/')) {
      drop(name, false);
    }
  }
}

void RosTasks::add(Request request) {
  std::string node = std::visit([](const auto& given) { return node_of(given); }, request);
  const auto* const transitions = std::get_if<TransitionRequest>(&request);
  if (transitions == nullptr || transitions->autostart) {
    repeated_[node].push_back(request);
  }
  if (!restarting_.contains(node)) {
    start(std::move(request), std::move(node));
  }
}

void RosTasks::start(Request request, std::string owner) {
  tasks_.push_back({std::move(request), std::move(owner), 0, nullptr, nullptr});
  next(std::prev(tasks_.end()));
}

void RosTasks::next(TaskPlace task) {
  std::visit(
      [&](const auto& request) {
        if (task->step == steps_of(request)) {
          end(task);
          return;
        }
        const RosRequest step = ros_request(request, task->step);
        task->reminder = loop_.after(kPatience, [this, task, text = describe(step)] {
          std::visit(
              [&](const auto& late) {
                context_.message(LogLevel::kWarning, logger_of(late),
                                 fmt::format("still waiting for {} ({})", text, to_string(place_of(late, task->step))));
              },
              task->request);
        });
        task->answer = context_.ros_client()->ask(step, request.environment, Duration(0),
                                                  [this, task](const RosAnswer& answer) { on_answer(task, answer); });
      },
      task->request);
}

void RosTasks::end(TaskPlace task) {
  tasks_.erase(task);
  if (idle()) {
    idle_();
  }
}

void RosTasks::on_answer(TaskPlace task, const RosAnswer& answer) {
  const EventLoop::SourcePtr answered = std::move(task->answer);  // outlives its callback
  task->reminder.reset();
  if (answer.client_lost) {
    const SourceRange where =
        std::visit([&](const auto& request) { return place_of(request, task->step); }, task->request);
    end(task);
    failed_(LaunchError(answer.error, where));
    return;
  }
  const std::size_t step = task->step++;
  if (std::visit([&](const auto& request) { return report(request, step, answer); }, task->request)) {
    next(task);
  } else {
    end(task);
  }
}

bool RosTasks::report(const LoadRequest& request, std::size_t step, const RosAnswer& answer) {
  const ComposableNode& node = request.nodes[step];
  if (!answer.ok) {
    context_.message(LogLevel::kError, kLoadLogger,
                     fmt::format("Failed to load node '{}' of type '{}' in container '{}': {} ({})", node.name,
                                 node.plugin, request.target, without_line_end(answer.error), to_string(node.origin)));
    note_failure(fmt::format("component '{}' of type '{}' was not loaded", node.name, node.plugin), node.origin);
    return true;  // a component that can't be loaded doesn't prevent the loading of the others
  }
  loaded_.insert_or_assign({node_of(request), identity_of(node)}, answer.unique_id);
  context_.message(LogLevel::kInfo, kLoadLogger,
                   fmt::format("Loaded node '{}' in container '{}'", answer.node, request.target));
  if (node.autostart) {
    start(TransitionRequest{answer.node, {"configure", "activate"}, true, request.environment, node.origin},
          node_of(request));
  }
  return true;
}

bool RosTasks::report(const TransitionRequest& request, std::size_t step, const RosAnswer& answer) {
  if (answer.ok) {
    return true;
  }
  context_.message(
      LogLevel::kError, kLifecycleLogger,
      fmt::format("Failed to make transition '{}' for LifecycleNode '{}'{} ({})", request.transitions[step],
                  request.node, answer.error.empty() ? std::string() : ": " + answer.error, to_string(request.origin)));
  return false;
}

void RosTasks::note_failure(const std::string& what, const SourceRange& where) const {
  if (failure_observer_) {
    failure_observer_(what, where);
  }
}

void RosTasks::on_process_event(const ProcessEvent& event) {
  const auto found = nodes_.find(event.id);
  if (found == nodes_.end()) {
    return;
  }
  const std::string& node = found->second;
  if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    drop(node, exited->will_respawn);
  } else if (const auto* const failed = std::get_if<ProcessStartFailed>(&event.what)) {
    drop(node, failed->will_respawn);
  } else if (std::holds_alternative<ProcessStarted>(event.what) && restarting_.erase(node) != 0) {
    for (const Request& request : repeated_[node]) {
      start(request, node);
    }
  }
}

void RosTasks::drop(const std::string& node, bool restarts) {
  if (restarts) {
    restarting_.insert(node);
  }
  for (auto task = tasks_.begin(); task != tasks_.end();) {
    const auto dropped = task++;
    if (dropped->owner != node) {
      continue;
    }
    if (!restarts) {
      std::visit(
          [&](const auto& request) {
            RosAnswer ended;
            ended.error = "its process does not run";
            for (std::size_t step = dropped->step; step < steps_of(request) && report(request, step, ended); ++step) {
            }
          },
          dropped->request);
    }
    end(dropped);
  }
}

void RosTasks::shutdown() {
  for (const Task& task : tasks_) {
    std::visit(
        [&](const auto& request) {
          context_.message(
              LogLevel::kWarning, logger_of(request),
              fmt::format("Abandoning wait for {}, due to shutdown.", describe(ros_request(request, task.step))));
        },
        task.request);
  }
  tasks_.clear();
  unloads_.clear();
  repeated_.clear();
  if (RosClient* const client = context_.ros_client()) {
    client->close();
  }
}

}  // namespace launch
