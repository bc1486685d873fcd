#include <algorithm>
#include <mutex>
#include <rosgraph_msgs/msg/clock.hpp>
#include <stdexcept>
#include <vector>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/time_source.hpp"

namespace rclcpp {

namespace {

constexpr const char* kParameter = "use_sim_time";

void require_ok(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, what);
  }
}

}  // namespace

class TimeSource::Impl : public std::enable_shared_from_this<TimeSource::Impl> {
 public:
  explicit Impl(const QoS& qos) : qos_(qos) {}

  void attach_node(const Node::SharedPtr& node) {
    detach_node();
    if (!node->has_parameter(kParameter)) {
      node->declare_parameter(kParameter, false);
    }
    const bool enabled = node->get_parameter(kParameter).as_bool();
    // Weakly: the node owns what it calls.
    auto on_change = [weak = weak_from_this()](const std::vector<Parameter>& parameters) {
      const auto self = weak.lock();
      for (const Parameter& parameter : parameters) {
        if (self && parameter.get_name() == kParameter && parameter.get_type() == PARAMETER_BOOL) {
          self->use_sim_time(parameter.as_bool());
        }
      }
    };
    // Not under our lock: a parameter that is set calls back under the lock of the node's parameters.
    auto callback = node->add_post_set_parameters_callback(std::move(on_change));
    {
      const std::lock_guard lock(mutex_);
      node_ = node;
      parameter_callback_ = std::move(callback);
    }
    use_sim_time(enabled);
  }

  void detach_node() {
    use_sim_time(false);
    const std::lock_guard lock(mutex_);
    parameter_callback_.reset();
    node_.reset();
  }

  void attach_clock(const Clock::SharedPtr& clock) {
    if (clock->get_clock_type() != RCL_ROS_TIME) {
      throw std::invalid_argument("cannot attach a clock of another type than RCL_ROS_TIME to a time source");
    }
    const std::lock_guard lock(mutex_);
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
      enable(*clock, false);
      clocks_.erase(found);
    }
  }

 private:
  void use_sim_time(bool enabled) {
    const std::lock_guard lock(mutex_);
    const Node::SharedPtr node = node_.lock();
    if (enabled == (subscription_ != nullptr) || (enabled && !node)) {
      return;
    }
    for (const Clock::SharedPtr& clock : clocks_) {
      enable(*clock, enabled);
    }
    if (!enabled) {
      subscription_.reset();
      return;
    }
    last_time_ = 0;
    subscription_ = node->create_subscription<rosgraph_msgs::msg::Clock>(
        "/clock", qos_, [weak = weak_from_this()](const rosgraph_msgs::msg::Clock& message) {
          if (const auto self = weak.lock()) {
            self->set_time(Time(message.clock).nanoseconds());
          }
        });
  }

  void set_time(rcl_time_point_value_t time) {
    const std::lock_guard lock(mutex_);
    last_time_ = time;
    for (const Clock::SharedPtr& clock : clocks_) {
      set(*clock, time);
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
  std::recursive_mutex mutex_;  // recursive: what waits for a jump of a clock may attach and detach
  std::weak_ptr<Node> node_;
  std::vector<Clock::SharedPtr> clocks_;
  node_interfaces::PostSetParametersCallbackHandle::SharedPtr parameter_callback_;
  Subscription<rosgraph_msgs::msg::Clock>::SharedPtr subscription_;  // while time is simulated
  rcl_time_point_value_t last_time_ = 0;
};

TimeSource::TimeSource(const QoS& qos, bool /*use_clock_thread*/) : impl_(std::make_shared<Impl>(qos)) {}

TimeSource::TimeSource(const Node::SharedPtr& node, const QoS& qos, bool use_clock_thread)
    : TimeSource(qos, use_clock_thread) {
  attachNode(node);
}

TimeSource::~TimeSource() = default;

void TimeSource::attachNode(const Node::SharedPtr& node) {
  impl_->attach_node(node);
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

}  // namespace rclcpp
