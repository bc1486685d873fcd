// SPDX-License-Identifier: Apache-2.0
// Carries out requests to the services of nodes: components are loaded, states are changed.
//
// The steps of one request follow one another; different requests run side by side, as in launch_ros. Each step waits
// for the service as long as it takes. A failed step is an error in the log, and the launch goes on. When the process
// of a node starts again, the requests to the node are made again. A request that waits for a process that has ended is
// dropped.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "launcher/process/process_event.hpp"
#include "launcher/ros/ros_client.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

class RosTasks {
 public:
  // A step that waits longer than this tells the user what it waits for.
  static constexpr Duration kPatience = std::chrono::seconds(10);

  // The references must outlive the tasks. The client is the one of the context. `idle` is called when the last task
  // has ended, `failed` when there is no client or when it can't work.
  RosTasks(LaunchContext& context, EventLoop& loop, std::function<void()> idle,
           std::function<void(const LaunchError&)> failed);

  // Called for each component that could not be loaded.
  using FailureObserver = std::function<void(const std::string& what, const SourceRange& where)>;
  void observe_failures(FailureObserver observer) { failure_observer_ = std::move(observer); }

  void start(std::vector<LoadRequest> loads, std::vector<TransitionRequest> transitions);

  // Another reading of the launch file does not ask for this component any more: it is not loaded again, and unloaded
  // if it is there and `unload` is set. Calls `done` when that is over.
  void forget(const std::string& container, const ComposableNode& node, const Environment& environment, bool unload,
              std::function<void()> done);
  // Nor for these transitions.
  void forget(const TransitionRequest& transition);

  // Gives the names of a process. A fully qualified name is the name of its node.
  void name_process(ProcessId process, const std::vector<std::string>& names);
  void on_process_event(const ProcessEvent& event);
  // The process with these names will never start.
  void on_skipped(const std::vector<std::string>& names);

  // Drops all tasks under way.
  void shutdown();

  bool idle() const { return tasks_.empty() && unloads_.empty(); }

 private:
  void note_failure(const std::string& what, const SourceRange& where) const;
  using Request = std::variant<LoadRequest, TransitionRequest>;
  struct Task {
    Request request;
    std::string owner;  // the node whose process the task depends on
    std::size_t step = 0;
    EventLoop::SourcePtr answer;
    EventLoop::SourcePtr reminder;
  };
  using TaskPlace = std::list<Task>::iterator;

  void add(Request request);
  void start(Request request, std::string owner);
  void next(TaskPlace task);
  void end(TaskPlace task);
  void on_answer(TaskPlace task, const RosAnswer& answer);
  // Returns whether the task goes on.
  bool report(const LoadRequest& request, std::size_t step, const RosAnswer& answer);
  bool report(const TransitionRequest& request, std::size_t step, const RosAnswer& answer);
  // The process of a node has ended, for now or for good.
  void drop(const std::string& node, bool restarts);

  LaunchContext& context_;
  EventLoop& loop_;
  std::function<void()> idle_;
  FailureObserver failure_observer_;
  std::function<void(const LaunchError&)> failed_;

  std::list<Task> tasks_;
  std::list<EventLoop::SourcePtr> unloads_;
  std::map<std::pair<std::string, std::string>, std::uint64_t> loaded_;  // by container and component: its number there
  std::map<ProcessId, std::string> nodes_;
  std::map<std::string, std::vector<Request>> repeated_;  // by node: the requests for each start of its process
  std::set<std::string> restarting_;                      // nodes whose process will start again
};

// What a container is asked to load, as a text: equal texts load the same.
std::string text_of(const ComposableNode& node);
// The component behind it, however it is loaded: package, plugin, namespace and name.
std::string identity_of(const ComposableNode& node);

}  // namespace launch
