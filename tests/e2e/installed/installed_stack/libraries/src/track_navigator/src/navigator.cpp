// SPDX-License-Identifier: Apache-2.0
#include "track_navigator/navigator.hpp"

#include <lifecycle_msgs/msg/state.hpp>
#include <numeric>
#include <rclcpp_components/register_node_macro.hpp>

namespace track_navigator {

Navigator::Navigator(const rclcpp::NodeOptions& options)
    : LifecycleNode("navigator", "", options), loader_("track_navigator", "track_navigator::Layer") {
  declare_parameter("layers", std::vector<std::string>{"map", "inflation"});
  declare_parameter("map.plugin", "track_navigator::StaticLayer");
  declare_parameter("inflation.plugin", "inflation");
  declare_parameter("bond_heartbeat_period", 0.01);
}

Navigator::~Navigator() {
  release();
}

Navigator::CallbackReturn Navigator::on_configure(const rclcpp_lifecycle::State&) {
  frames_ = std::make_shared<track_frames_ros::Buffer>(get_clock());
  listener_ = std::make_unique<track_frames_ros::Listener>(*frames_, this);
  for (const std::string& name : get_parameter("layers").as_string_array()) {
    const std::string type = get_parameter(name + ".plugin").as_string();
    try {
      layers_.push_back(loader_.createSharedInstance(type));
      layers_.back()->configure(std::static_pointer_cast<LifecycleNode>(shared_from_this()), name, frames_);
    } catch (const pluginlib::PluginlibException& error) {
      RCLCPP_FATAL(get_logger(), "Failed to create layer. Exception: %s", error.what());
      return CallbackReturn::FAILURE;
    }
  }
  publisher_ = create_publisher<std_msgs::msg::Header>("computed", 1);
  diagnostics_ = std::make_unique<track_diagnostics::Updater>(this, 0.5);
  server_ = rclcpp_action::create_server<Action>(
      get_node_base_interface(), get_node_clock_interface(), get_node_logging_interface(),
      get_node_waitables_interface(), "compute",
      [this](const rclcpp_action::GoalUUID& id, std::shared_ptr<const Action::Goal> goal) {
        return handle_goal(id, goal);
      },
      [](const std::shared_ptr<GoalHandle>) { return rclcpp_action::CancelResponse::ACCEPT; },
      [this](const std::shared_ptr<GoalHandle> goal) {
        if (worker_.joinable()) {
          worker_.join();
        }
        worker_ = std::thread([this, goal] { compute(goal); });
      },
      rcl_action_server_get_default_options(), nullptr);
  return CallbackReturn::SUCCESS;
}

Navigator::CallbackReturn Navigator::on_activate(const rclcpp_lifecycle::State& state) {
  LifecycleNode::on_activate(state);
  for (const Layer::Ptr& layer : layers_) {
    layer->activate();
  }
  bond_ = std::make_unique<track_bond::Bond>("bond", get_name(),
                                             std::static_pointer_cast<LifecycleNode>(shared_from_this()), nullptr);
  const auto beat =
      std::chrono::milliseconds(static_cast<int>(1000 * get_parameter("bond_heartbeat_period").as_double()));
  bond_->start(beat, std::chrono::minutes(1));
  return CallbackReturn::SUCCESS;
}

Navigator::CallbackReturn Navigator::on_deactivate(const rclcpp_lifecycle::State& state) {
  for (const Layer::Ptr& layer : layers_) {
    layer->deactivate();
  }
  bond_.reset();
  LifecycleNode::on_deactivate(state);
  return CallbackReturn::SUCCESS;
}

Navigator::CallbackReturn Navigator::on_cleanup(const rclcpp_lifecycle::State&) {
  release();
  return CallbackReturn::SUCCESS;
}

Navigator::CallbackReturn Navigator::on_shutdown(const rclcpp_lifecycle::State&) {
  release();
  return CallbackReturn::SUCCESS;
}

rclcpp_action::GoalResponse Navigator::handle_goal(const rclcpp_action::GoalUUID& id,
                                                   std::shared_ptr<const Action::Goal> goal) {
  const bool is_active = get_current_state().id() == lifecycle_msgs::msg::State::PRIMARY_STATE_ACTIVE;
  RCLCPP_DEBUG(get_logger(), "goal %s of order %d", rclcpp_action::to_string(id).c_str(), goal->order);
  return is_active ? rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE : rclcpp_action::GoalResponse::REJECT;
}

void Navigator::compute(const std::shared_ptr<GoalHandle>& goal) {
  const auto result = std::make_shared<Action::Result>();
  const auto feedback = std::make_shared<Action::Feedback>();
  Costs costs;
  for (const Layer::Ptr& layer : layers_) {
    layer->update(costs);
    feedback->sequence.push_back(std::accumulate(costs.begin(), costs.end(), 0));
    goal->publish_feedback(feedback);
  }
  if (goal->is_canceling()) {
    goal->canceled(result);
    return;
  }
  result->sequence.assign(costs.begin(), costs.end());
  std_msgs::msg::Header header;
  header.stamp = now();
  publisher_->publish(header);
  goal->succeed(result);
}

void Navigator::release() {
  if (worker_.joinable()) {
    worker_.join();
  }
  server_.reset();
  for (const Layer::Ptr& layer : layers_) {
    layer->cleanup();
  }
  layers_.clear();
  bond_.reset();
  diagnostics_.reset();
  publisher_.reset();
  listener_.reset();
  frames_.reset();
}

}  // namespace track_navigator

RCLCPP_COMPONENTS_REGISTER_NODE(track_navigator::Navigator)
