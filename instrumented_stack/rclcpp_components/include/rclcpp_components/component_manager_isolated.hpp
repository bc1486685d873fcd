// SPDX-License-Identifier: Apache-2.0
// A container in which every component has its own executor and thread.
#pragma once

#include <pthread.h>

#include <chrono>
#include <cstddef>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <type_traits>
#include <typeinfo>
#include <utility>

#include "rclcpp_components/component_manager.hpp"

namespace rclcpp_components {

template <typename ExecutorT = rclcpp::executors::SingleThreadedExecutor>
class ComponentManagerIsolated : public ComponentManager {
 public:
  using ComponentManager::ComponentManager;

  ComponentManagerIsolated() = default;
  // Executors with several threads have `number_of_threads`; 0: as many as the parameter thread_num.
  explicit ComponentManagerIsolated(const rclcpp::ExecutorOptions& executor_options, size_t number_of_threads = 0)
      : executor_options_(executor_options), number_of_threads_(number_of_threads) {}

  ~ComponentManagerIsolated() override {
    for (auto& [id, dedicated] : dedicated_executors_) {
      dedicated.end();
    }
    node_wrappers_.clear();
  }

 protected:
  bool knows_all_extra_arguments() const override { return typeid(*this) == typeid(ComponentManagerIsolated); }

  void add_node_to_executor(uint64_t node_id) override {
    auto node = node_wrappers_.at(node_id).get_node_base_interface();
    const std::shared_ptr<ExecutorT> executor = make_executor();
    executor->add_node(node);
    Dedicated dedicated;
    dedicated.executor = executor;
    std::promise<void> ended;
    dedicated.ended = ended.get_future();
    dedicated.thread = std::thread([executor, node, ended = std::move(ended)]() mutable {
      // Visible in traces and debuggers. Threads that the executor starts inherit the name. It has at most 15
      // characters.
      pthread_setname_np(pthread_self(), std::string(node->get_name()).substr(0, 15).c_str());
      node.reset();
      executor->spin();
      ended.set_value();
    });
    dedicated_executors_.emplace(node_id, std::move(dedicated));
  }

  void remove_node_from_executor(uint64_t node_id) override {
    const auto dedicated = dedicated_executors_.find(node_id);
    if (dedicated != dedicated_executors_.end()) {
      dedicated->second.end();
      dedicated_executors_.erase(dedicated);
    }
  }

 private:
  std::shared_ptr<ExecutorT> make_executor() const {
    if constexpr (std::is_constructible_v<ExecutorT, const rclcpp::ExecutorOptions&, size_t>) {
      const size_t threads =
          number_of_threads_ > 0 ? number_of_threads_ : static_cast<size_t>(get_parameter("thread_num").as_int());
      return std::make_shared<ExecutorT>(executor_options_, threads);
    } else if constexpr (std::is_constructible_v<ExecutorT, const rclcpp::ExecutorOptions&>) {
      return std::make_shared<ExecutorT>(executor_options_);
    } else {
      return std::make_shared<ExecutorT>();
    }
  }

  struct Dedicated {
    // Returns when the currently running callback, if any, has returned.
    void end() {
      // Repeated, because a cancel() before spin() has begun has no effect.
      do {
        executor->cancel();
      } while (ended.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready);
      thread.join();
    }

    std::shared_ptr<rclcpp::Executor> executor;
    std::thread thread;
    std::future<void> ended;  // set when spin() has returned
  };

  const rclcpp::ExecutorOptions executor_options_{};
  const size_t number_of_threads_ = 0;
  std::map<uint64_t, Dedicated> dedicated_executors_;
};

}  // namespace rclcpp_components
