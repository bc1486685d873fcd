// SPDX-License-Identifier: Apache-2.0
#include "nodes.hpp"

#include <tracetools/tracetools.h>

#include <atomic>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "transmission.hpp"

namespace reference_system {

namespace {

constexpr size_t kDepth = 10;

// Work that takes time and cannot be optimised away: it counts primes.
uint64_t crunch_numbers(uint64_t limit) {
  uint64_t primes = 0;
  for (uint64_t number = 2; number <= limit; ++number) {
    bool is_prime = true;
    for (uint64_t divisor = 2; divisor * divisor <= number && is_prime; ++divisor) {
      is_prime = number % divisor != 0;
    }
    primes += is_prime;
  }
  return primes;
}

class ReferenceNode : public rclcpp::Node {
 public:
  ReferenceNode(const NodeDescription& description, const Settings& settings)
      : Node(description.name, rclcpp::NodeOptions().use_intra_process_comms(settings.use_intra_process_comms)),
        settings_(settings) {
    for (const std::string& output : description.outputs) {
      publishers_.push_back(create_publisher<Message>(output, kDepth));
    }
    sequence_numbers_.resize(description.outputs.size());
    inputs_.resize(description.inputs.size());
  }

 protected:
  using Input = Message::ConstSharedPtr;

  void work() { primes_ += crunch_numbers(settings_.number_crunch_limit); }

  template <typename CallbackT>
  void subscribe(const std::string& topic, CallbackT callback) {
    subscriptions_.push_back(create_subscription<Message>(topic, kDepth, std::move(callback)));
  }

  // Keeps the message of an input, and counts its sender's dropped messages.
  void keep(size_t input, Input message) {
    if (message->size > 0) {
      const auto& sender = message->stats[message->size - 1];
      uint32_t& last = last_sequence_numbers_[input];
      if (last != 0 && sender.sequence_number > last + 1) {
        dropped_samples_ += sender.sequence_number - last - 1;
      }
      last = sender.sequence_number;
    }
    inputs_[input] = std::move(message);
  }

  // Publishes a message with the history of the kept inputs.
  void publish(size_t output = 0) {
    auto message = std::make_unique<Message>();
    for (const Input& input : inputs_) {
      if (input) {
        merge_history(*input, *message);
      }
    }
    sign(get_name(), ++sequence_numbers_[output], dropped_samples_, *message);
    publishers_[output]->publish(std::move(message));
  }

  // The rcl handles of all subscriptions and publishers, as in the trace.
  std::vector<const void*> subscription_handles() const {
    std::vector<const void*> handles;
    for (const auto& subscription : subscriptions_) {
      handles.push_back(subscription->get_subscription_handle().get());
    }
    return handles;
  }
  std::vector<const void*> publisher_handles() const {
    std::vector<const void*> handles;
    for (const auto& publisher : publishers_) {
      handles.push_back(publisher->get_publisher_handle().get());
    }
    return handles;
  }

  std::vector<Input> inputs_;

 private:
  Settings settings_;
  std::vector<rclcpp::Publisher<Message>::SharedPtr> publishers_;
  std::vector<rclcpp::Subscription<Message>::SharedPtr> subscriptions_;
  std::map<size_t, uint32_t> last_sequence_numbers_;
  uint32_t dropped_samples_ = 0;
  std::vector<uint32_t> sequence_numbers_;  // index: output
  uint64_t primes_ = 0;
};

class Sensor : public ReferenceNode {
 public:
  Sensor(const NodeDescription& description, const Settings& settings) : ReferenceNode(description, settings) {
    timer_ = create_wall_timer(description.period, [this] { publish(); });
  }

 private:
  rclcpp::TimerBase::SharedPtr timer_;
};

class Transform : public ReferenceNode {
 public:
  Transform(const NodeDescription& description, const Settings& settings) : ReferenceNode(description, settings) {
    subscribe(description.inputs.front(), [this](Input message) {
      keep(0, std::move(message));
      work();
      publish();
    });
  }
};

class Fusion : public ReferenceNode {
 public:
  Fusion(const NodeDescription& description, const Settings& settings) : ReferenceNode(description, settings) {
    for (size_t i = 0; i < description.inputs.size(); ++i) {
      subscribe(description.inputs[i], [this, i](Input message) {
        keep(i, std::move(message));
        fuse();
      });
    }
    // The trace cannot show that an earlier message is part of a message that is published later.
    [[maybe_unused]] std::vector<const void*> subscriptions = subscription_handles();
    [[maybe_unused]] std::vector<const void*> publishers = publisher_handles();
    TRACETOOLS_TRACEPOINT(message_link_partial_sync, subscriptions.data(), subscriptions.size(), publishers.data(),
                          publishers.size());
  }

 private:
  void fuse() {
    for (const Input& input : inputs_) {
      if (!input) {
        return;
      }
    }
    work();
    publish();
    for (Input& input : inputs_) {
      input.reset();
    }
  }
};

class Cyclic : public ReferenceNode {
 public:
  Cyclic(const NodeDescription& description, const Settings& settings) : ReferenceNode(description, settings) {
    for (size_t i = 0; i < description.inputs.size(); ++i) {
      subscribe(description.inputs[i], [this, i](Input message) { keep(i, std::move(message)); });
    }
    timer_ = create_wall_timer(description.period, [this] {
      work();
      publish();
    });
    [[maybe_unused]] std::vector<const void*> subscriptions = subscription_handles();
    [[maybe_unused]] std::vector<const void*> publishers = publisher_handles();
    TRACETOOLS_TRACEPOINT(message_link_periodic_async, subscriptions.data(), subscriptions.size(), publishers.data(),
                          publishers.size());
  }

 private:
  rclcpp::TimerBase::SharedPtr timer_;
};

class Intersection : public ReferenceNode {
 public:
  Intersection(const NodeDescription& description, const Settings& settings) : ReferenceNode(description, settings) {
    for (size_t i = 0; i < description.inputs.size(); ++i) {
      subscribe(description.inputs[i], [this, i](Input message) {
        keep(i, std::move(message));
        work();
        publish(i);
        inputs_[i].reset();
      });
    }
  }
};

// Command nodes of this process that are still waiting for messages.
std::atomic<size_t> waiting_commands{0};

class Command : public ReferenceNode {
 public:
  Command(const NodeDescription& description, const Settings& settings) : ReferenceNode(description, settings) {
    if (settings.messages > 0) {
      ++waiting_commands;
    }
    const size_t all = nodes_before(description.inputs.front()).size();
    subscribe(description.inputs.front(), [this, all, remaining = settings.messages](Input message) mutable {
      times_.add(*message);
      if (remaining > 0 && number_of_nodes(*message) == all && --remaining == 0 && --waiting_commands == 0) {
        rclcpp::shutdown();
      }
    });
  }

  ~Command() override {
    for (const auto& [node, time] : times_.times()) {
      RCLCPP_INFO(get_logger(), "%lu messages from %s: min %.3f ms, mean %.3f ms, max %.3f ms, %u dropped behind it",
                  time.count, node.c_str(), static_cast<double>(time.min_ns) * 1e-6,
                  time.sum_ns / static_cast<double>(time.count) * 1e-6, static_cast<double>(time.max_ns) * 1e-6,
                  time.dropped);
    }
  }

 private:
  TravelTimes times_;
};

}  // namespace

std::shared_ptr<rclcpp::Node> create_node(const NodeDescription& description, const Settings& settings) {
  switch (description.kind) {
    case Kind::Sensor:
      return std::make_shared<Sensor>(description, settings);
    case Kind::Transform:
      return std::make_shared<Transform>(description, settings);
    case Kind::Fusion:
      return std::make_shared<Fusion>(description, settings);
    case Kind::Cyclic:
      return std::make_shared<Cyclic>(description, settings);
    case Kind::Intersection:
      return std::make_shared<Intersection>(description, settings);
    case Kind::Command:
      return std::make_shared<Command>(description, settings);
  }
  throw std::invalid_argument("unknown kind of node");
}

}  // namespace reference_system
