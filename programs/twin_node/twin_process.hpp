// SPDX-License-Identifier: Apache-2.0
// The nodes, callbacks and executors of one process of a twin.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include <std_srvs/srv/empty.hpp>
#include <vector>

#include "tracing/model/twin/description/output_rules.hpp"
#include "tracing/model/twin/description/quick_runs.hpp"
#include "tracing/model/twin/description/twin_system.hpp"

namespace twin_node {

class TwinProcess {
 public:
  // The system must outlive it.
  TwinProcess(const tracing::twin::System& system, tracing::twin::Index process);
  // Until the context shuts down.
  void spin();

 private:
  using Message = std_msgs::msg::String;
  using Service = std_srvs::srv::Empty;
  using Index = tracing::twin::Index;
  struct Timer {
    rclcpp::TimerBase::SharedPtr timer;
    std::int64_t period_ns = 0;
    std::int64_t phase_ns = 0;
  };

  // How long sending took in the last runs of a callback.
  struct Sendings {
    static constexpr std::size_t kMost = 128;
    std::vector<std::int64_t> times;
    std::size_t next = 0;
  };

  void add_nodes();
  void add_groups();
  void add_ends();
  void add_callbacks();
  // What a callback does.
  void run(Index callback);
  void send(const tracing::twin::Output& output);
  // How long a run takes in which sending took this long.
  std::int64_t time_of_run(Index callback, std::int64_t sending_ns, std::int64_t drawn_ns);
  // Lets each timer begin so that it keeps its distance from the others, also from those of other processes.
  void start_timers();

  const tracing::twin::System& system_;
  const Index process_;
  std::mutex rules_mutex_;
  tracing::twin::OutputRules rules_;
  tracing::twin::QuickRuns quick_;
  std::map<Index, rclcpp::Node::SharedPtr> nodes_;
  std::map<Index, std::shared_ptr<rclcpp::Executor>> executors_;
  std::map<Index, rclcpp::CallbackGroup::SharedPtr> groups_;
  std::map<Index, rclcpp::Publisher<Message>::SharedPtr> publishers_;
  std::map<Index, Message> messages_;  // by topic
  std::map<Index, rclcpp::Client<Service>::SharedPtr> clients_;
  std::map<Index, Index> answers_;  // the callback of each client
  std::vector<Sendings> sendings_;  // by callback
  std::vector<Timer> timers_;
  std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace twin_node
