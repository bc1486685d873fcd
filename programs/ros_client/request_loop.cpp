// SPDX-License-Identifier: Apache-2.0
#include "programs/ros_client/request_loop.hpp"

#include <fmt/format.h>
#include <rcl/graph.h>
#include <rcl/wait.h>

#include <algorithm>
#include <rclcpp/exceptions.hpp>

namespace launch {

namespace {

// The graph is looked at again after this time even when no change was reported: endpoints are matched a little later
// than they are found, and a match is no event of its own.
constexpr std::chrono::milliseconds kPatience{50};

void require_ok(rcl_ret_t ret) {
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, "cannot wait for the graph");
  }
}

class WaitSet {
 public:
  WaitSet(std::size_t subscriptions, std::size_t clients, rcl_context_t* context) {
    require_ok(rcl_wait_set_init(&set_, subscriptions, 2, 0, clients, 0, 0, context, rcl_get_default_allocator()));
  }
  ~WaitSet() { (void)rcl_wait_set_fini(&set_); }
  WaitSet(const WaitSet&) = delete;
  WaitSet& operator=(const WaitSet&) = delete;

  rcl_wait_set_t& set() { return set_; }

 private:
  rcl_wait_set_t set_ = rcl_get_zero_initialized_wait_set();
};

RosAnswer failure(std::string error) {
  RosAnswer answer;
  answer.error = std::move(error);
  return answer;
}

}  // namespace

std::unique_ptr<Operation> make_operation(const RosRequest& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::visit(
      [&](const auto& given) -> std::unique_ptr<Operation> {
        if constexpr (requires { call(given, node, answer); }) {
          return call(given, node, std::move(answer));
        } else if constexpr (requires { wait_for(given, node, answer); }) {
          return wait_for(given, node, std::move(answer));
        } else {
          return watch(given, node, std::move(answer));
        }
      },
      request);
}

RequestLoop::RequestLoop(rclcpp::Node& node, Send send) : node_(node), send_(std::move(send)) {}

void RequestLoop::post(RosRequestLine line) {
  {
    const std::lock_guard lock(mutex_);
    posted_.push_back(std::move(line));
  }
  wake_.trigger();
}

void RequestLoop::quit() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  wake_.trigger();
}

void RequestLoop::run() {
  while (take_posted()) {
    look();
    wait();
  }
  under_way_.clear();
}

bool RequestLoop::take_posted() {
  std::vector<RosRequestLine> lines;
  {
    const std::lock_guard lock(mutex_);
    if (quit_) {
      return false;
    }
    lines.swap(posted_);
  }
  for (const RosRequestLine& line : lines) {
    if (line.request) {
      start(line);
    } else {
      under_way_.erase(line.id);
    }
  }
  return true;
}

void RequestLoop::start(const RosRequestLine& line) {
  try {
    UnderWay request;
    request.operation = make_operation(*line.request, node_, [this, id = line.id](const RosAnswer& answer) {
      send_({id, answer});
    });
    request.timeout = line.timeout;
    if (line.timeout > Duration(0)) {
      request.deadline = Clock::now() + line.timeout;
    }
    under_way_.emplace(line.id, std::move(request));
  } catch (const std::exception& error) {
    send_({line.id, failure(error.what())});
  }
}

void RequestLoop::look() {
  for (auto place = under_way_.begin(); place != under_way_.end();) {
    UnderWay& request = place->second;
    bool over = false;
    try {
      request.operation->look();
      over = request.operation->has_ended();
    } catch (const std::exception& error) {
      send_({place->first, failure(error.what())});
      over = true;
    }
    if (!over && request.deadline && Clock::now() >= *request.deadline) {
      send_({place->first, failure(fmt::format("waited in vain for {} ({} s)", request.operation->waits_for(),
                                               std::chrono::duration<double>(request.timeout).count()))});
      over = true;
    }
    place = over ? under_way_.erase(place) : std::next(place);
  }
}

void RequestLoop::wait() {
  Operation::WakeUps wake_ups{{}, {}, kPatience};
  for (const auto& [id, request] : under_way_) {
    request.operation->add_to(wake_ups);
    if (request.deadline) {
      wake_ups.patience = std::clamp<std::chrono::nanoseconds>(*request.deadline - Clock::now(),
                                                               std::chrono::nanoseconds(0), wake_ups.patience);
    }
  }
  rcl_node_t* const node = node_.get_node_base_interface()->get_rcl_node_handle();
  WaitSet wait(wake_ups.subscriptions.size(), wake_ups.clients.size(), node->context);
  require_ok(rcl_wait_set_add_guard_condition(&wait.set(), rcl_node_get_graph_guard_condition(node), nullptr));
  require_ok(rcl_wait_set_add_guard_condition(&wait.set(), &wake_.get_rcl_guard_condition(), nullptr));
  for (const rcl_subscription_t* subscription : wake_ups.subscriptions) {
    require_ok(rcl_wait_set_add_subscription(&wait.set(), subscription, nullptr));
  }
  for (const rcl_client_t* client : wake_ups.clients) {
    require_ok(rcl_wait_set_add_client(&wait.set(), client, nullptr));
  }
  const rcl_ret_t ret = rcl_wait(&wait.set(), under_way_.empty() ? -1 : wake_ups.patience.count());
  if (ret == RCL_RET_TIMEOUT) {
    rcl_reset_error();
  } else {
    require_ok(ret);
  }
}

}  // namespace launch
