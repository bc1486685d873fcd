// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/time_source.hpp"

#include <algorithm>
#include <future>
#include <memory>
#include <mutex>
#include <rosgraph_msgs/msg/clock.hpp>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "rclcpp/create_subscription.hpp"
#include "rclcpp/detail/qos_parameters.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/executors/single_threaded_executor.hpp"
#include "rclcpp/node_interfaces/node_time_source.hpp"
#include "rcutils/joined_thread.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

constexpr const char* kParameter = "use_sim_time";

}  // namespace

namespace detail {

// Receives /clock for one time source, in a group of its own. Code that this thread runs must not end it: it runs under
// the clock's lock, which is needed to end simulated time.
class ClockThread {
 public:
  explicit ClockThread(node_interfaces::NodeBaseInterface::SharedPtr node_base)
      : group_(node_base->create_callback_group(CallbackGroupType::MutuallyExclusive, false)),
        executor_(std::make_shared<executors::SingleThreadedExecutor>(options_of(*node_base))) {
    executor_->add_callback_group(group_, node_base);
  }
  ~ClockThread() {
    end_.set_value();
    executor_->cancel();
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  ClockThread(const ClockThread&) = delete;
  ClockThread& operator=(const ClockThread&) = delete;

  const CallbackGroup::SharedPtr& group() const { return group_; }
  void start() {
    thread_ = rcutils::JoinedThread(
        [executor = executor_, end = end_.get_future().share()] { executor->spin_until_future_complete(end); });
  }

 private:
  static ExecutorOptions options_of(node_interfaces::NodeBaseInterface& node_base) {
    ExecutorOptions options;
    options.context = node_base.get_context();
    return options;
  }

  CallbackGroup::SharedPtr group_;
  std::shared_ptr<executors::SingleThreadedExecutor> executor_;
  std::promise<void> end_;
  rcutils::JoinedThread thread_;
};

}  // namespace detail

class TimeSource::Impl : public std::enable_shared_from_this<TimeSource::Impl> {
 public:
  Impl(const QoS& qos, bool use_clock_thread) : qos_(qos), use_clock_thread_(use_clock_thread) {}

  void attach_node(node_interfaces::NodeBaseInterface::SharedPtr node_base,
                   node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                   node_interfaces::NodeParametersInterface::SharedPtr node_parameters) {
    detach_node();
    if (!node_parameters->has_parameter(kParameter)) {
      node_parameters->declare_parameter(kParameter, ParameterValue(false));
    }
    const bool enabled = node_parameters->get_parameter(kParameter).as_bool();
    // A weak pointer, because the node owns the callback.
    auto on_change = [weak = weak_from_this()](const std::vector<Parameter>& parameters) {
      const auto self = weak.lock();
      for (const Parameter& parameter : parameters) {
        if (self && parameter.get_name() == kParameter && parameter.get_type() == PARAMETER_BOOL) {
          self->use_sim_time(parameter.as_bool());
        }
      }
    };
    auto check = [weak = weak_from_this()](const std::vector<Parameter>& parameters) {
      rcl_interfaces::msg::SetParametersResult result;
      const auto self = weak.lock();
      for (const Parameter& parameter : parameters) {
        if (self && parameter.get_name() == kParameter && parameter.get_type() == PARAMETER_BOOL &&
            parameter.as_bool() && !self->can_simulate()) {
          result.reason = "use_sim_time parameter can't be true while clocks are not all of RCL_ROS_TIME type";
          return result;
        }
      }
      result.successful = true;
      return result;
    };
    // Called without our lock: setting a parameter calls back under the lock of the node's parameters.
    auto check_callback = node_parameters->add_on_set_parameters_callback(std::move(check));
    auto callback = node_parameters->add_post_set_parameters_callback(std::move(on_change));
    {
      const std::lock_guard lock(mutex_);
      node_base_ = std::move(node_base);
      node_topics_ = std::move(node_topics);
      node_parameters_ = std::move(node_parameters);
      parameter_check_ = std::move(check_callback);
      parameter_callback_ = std::move(callback);
    }
    use_sim_time(enabled);
  }

  void detach_node() {
    use_sim_time(false);
    const std::lock_guard lock(mutex_);
    parameter_check_.reset();
    parameter_callback_.reset();
    node_base_.reset();
    node_topics_.reset();
    node_parameters_.reset();
  }

  void attach_clock(const Clock::SharedPtr& clock) {
    const std::lock_guard lock(mutex_);
    if (subscription_) {
      require_ros_time(*clock);
    }
    clocks_.push_back(clock);
    if (subscription_) {
      enable(*clock, true);
      set(*clock, last_time_);
    }
  }

  void detach_clock(const Clock::SharedPtr& clock) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find(clocks_.begin(), clocks_.end(), clock);
    if (found != clocks_.end()) {
      if (clock->get_clock_type() == RCL_ROS_TIME) {
        enable(*clock, false);
      }
      clocks_.erase(found);
    }
  }

  bool can_simulate() const {
    const std::lock_guard lock(mutex_);
    return std::all_of(clocks_.begin(), clocks_.end(),
                       [](const Clock::SharedPtr& clock) { return clock->get_clock_type() == RCL_ROS_TIME; });
  }
  bool get_use_clock_thread() const {
    const std::lock_guard lock(mutex_);
    return use_clock_thread_;
  }
  void set_use_clock_thread(bool use_clock_thread) {
    const std::lock_guard lock(mutex_);
    use_clock_thread_ = use_clock_thread;
  }
  bool has_thread() const {
    const std::lock_guard lock(mutex_);
    return thread_ != nullptr;
  }

 private:
  void use_sim_time(bool enabled) {
    // Destroyed after the lock is released, because its thread may wait for the lock.
    std::unique_ptr<detail::ClockThread> ended;
    Subscription<rosgraph_msgs::msg::Clock>::SharedPtr ended_subscription;
    const QoS qos = enabled ? qos_of_clock() : qos_;
    const std::lock_guard lock(mutex_);
    if (enabled == (subscription_ != nullptr) || (enabled && !node_base_)) {
      return;
    }
    if (enabled) {
      for (const Clock::SharedPtr& clock : clocks_) {
        require_ros_time(*clock);
      }
    }
    if (!enabled) {
      for (const Clock::SharedPtr& clock : clocks_) {
        enable(*clock, false);
      }
      ended_subscription.swap(subscription_);
      ended.swap(thread_);
      return;
    }
    last_time_ = 0;
    SubscriptionOptions options;
    std::unique_ptr<detail::ClockThread> thread;
    if (use_clock_thread_) {
      thread = std::make_unique<detail::ClockThread>(node_base_);
      options.callback_group = thread->group();
    }
    subscription_ = create_subscription<rosgraph_msgs::msg::Clock>(
        node_parameters_, node_topics_, "/clock", qos,
        [weak = weak_from_this()](const rosgraph_msgs::msg::Clock& message) {
          if (const auto self = weak.lock()) {
            self->set_time(Time(message.clock).nanoseconds());
          }
        },
        options);
    // Set last: if the creation fails, nothing has changed.
    thread_ = std::move(thread);
    for (const Clock::SharedPtr& clock : clocks_) {
      enable(*clock, true);
    }
    if (thread_) {
      thread_->start();
    }
  }

  // Declares the parameters that override it. Called without our lock, because it takes that of the node's parameters.
  QoS qos_of_clock() const {
    node_interfaces::NodeBaseInterface::SharedPtr node_base;
    node_interfaces::NodeParametersInterface::SharedPtr node_parameters;
    {
      const std::lock_guard lock(mutex_);
      node_base = node_base_;
      node_parameters = node_parameters_;
    }
    if (!node_base) {
      return qos_;
    }
    const QosOverridingOptions overridable{QosPolicyKind::Depth, QosPolicyKind::Durability, QosPolicyKind::History,
                                           QosPolicyKind::Reliability};
    return detail::overridden_qos(overridable, node_parameters, *node_base, "/clock", qos_,
                                  detail::QosEntity::Subscription);
  }

  void set_time(rcl_time_point_value_t time) {
    const std::lock_guard lock(mutex_);
    if (!subscription_) {
      return;
    }
    last_time_ = time;
    for (const Clock::SharedPtr& clock : clocks_) {
      set(*clock, time);
    }
  }

  static void require_ros_time(const Clock& clock) {
    if (clock.get_clock_type() != RCL_ROS_TIME) {
      throw std::invalid_argument("ros_time_active_ can't be true while clock is not of RCL_ROS_TIME type");
    }
  }

  static void enable(Clock& clock, bool enabled) {
    const std::lock_guard lock(clock.get_clock_mutex());
    if (enabled) {
      require_ok(rcl_enable_ros_time_override(clock.get_clock_handle()), "failed to enable simulated time");
    } else {
      require_ok(rcl_disable_ros_time_override(clock.get_clock_handle()), "failed to disable simulated time");
    }
  }

  static void set(Clock& clock, rcl_time_point_value_t time) {
    const std::lock_guard lock(clock.get_clock_mutex());
    require_ok(rcl_set_ros_time_override(clock.get_clock_handle(), time), "failed to set simulated time");
  }

  const QoS qos_;
  mutable std::recursive_mutex mutex_;  // recursive: callbacks of clock jumps may attach and detach
  bool use_clock_thread_;
  node_interfaces::NodeBaseInterface::SharedPtr node_base_;
  node_interfaces::NodeTopicsInterface::SharedPtr node_topics_;
  node_interfaces::NodeParametersInterface::SharedPtr node_parameters_;
  std::vector<Clock::SharedPtr> clocks_;
  node_interfaces::OnSetParametersCallbackHandle::SharedPtr parameter_check_;
  node_interfaces::PostSetParametersCallbackHandle::SharedPtr parameter_callback_;
  // Set while time is simulated. The thread is destroyed first.
  Subscription<rosgraph_msgs::msg::Clock>::SharedPtr subscription_;
  std::unique_ptr<detail::ClockThread> thread_;
  rcl_time_point_value_t last_time_ = 0;
};

TimeSource::TimeSource(const QoS& qos, bool use_clock_thread) : impl_(std::make_shared<Impl>(qos, use_clock_thread)) {}

TimeSource::TimeSource(const Node::SharedPtr& node, const QoS& qos, bool use_clock_thread)
    : TimeSource(qos, use_clock_thread) {
  attachNode(node);
}

TimeSource::~TimeSource() {
  impl_->detach_node();
}

void TimeSource::attachNode(const Node::SharedPtr& node) {
  impl_->attach_node(node->get_node_base_interface(), node->get_node_topics_interface(),
                     node->get_node_parameters_interface());
}
void TimeSource::attachNode(node_interfaces::NodeBaseInterface::SharedPtr node_base,
                            node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                            node_interfaces::NodeGraphInterface::SharedPtr /*node_graph*/,
                            node_interfaces::NodeServicesInterface::SharedPtr /*node_services*/,
                            node_interfaces::NodeLoggingInterface::SharedPtr /*node_logging*/,
                            node_interfaces::NodeClockInterface::SharedPtr /*node_clock*/,
                            node_interfaces::NodeParametersInterface::SharedPtr node_parameters) {
  impl_->attach_node(std::move(node_base), std::move(node_topics), std::move(node_parameters));
}
void TimeSource::detachNode() {
  impl_->detach_node();
}
void TimeSource::attachClock(const Clock::SharedPtr& clock) {
  impl_->attach_clock(clock);
}
void TimeSource::detachClock(const Clock::SharedPtr& clock) {
  impl_->detach_clock(clock);
}

bool TimeSource::get_use_clock_thread() {
  return impl_->get_use_clock_thread();
}
void TimeSource::set_use_clock_thread(bool use_clock_thread) {
  impl_->set_use_clock_thread(use_clock_thread);
}
bool TimeSource::clock_thread_is_joinable() {
  return impl_->has_thread();
}

}  // namespace rclcpp

namespace rclcpp::node_interfaces {

NodeTimeSource::NodeTimeSource(NodeBaseInterface::SharedPtr node_base, NodeTopicsInterface::SharedPtr node_topics,
                               NodeGraphInterface::SharedPtr node_graph, NodeServicesInterface::SharedPtr node_services,
                               NodeLoggingInterface::SharedPtr node_logging, NodeClockInterface::SharedPtr node_clock,
                               NodeParametersInterface::SharedPtr node_parameters, const QoS& qos,
                               bool use_clock_thread)
    : time_source_(std::make_unique<TimeSource>(qos, use_clock_thread)) {
  time_source_->attachClock(node_clock->get_clock());
  time_source_->attachNode(std::move(node_base), std::move(node_topics), std::move(node_graph),
                           std::move(node_services), std::move(node_logging), std::move(node_clock),
                           std::move(node_parameters));
}

NodeTimeSource::~NodeTimeSource() = default;

}  // namespace rclcpp::node_interfaces
