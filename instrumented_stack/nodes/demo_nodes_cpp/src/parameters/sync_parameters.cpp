// SPDX-License-Identifier: Apache-2.0
// Nodes that set their own parameters through their services, read them and end.
#include <vector>

#include "own_parameters.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class ListParameters : public rclcpp::Node {
 public:
  explicit ListParameters(const rclcpp::NodeOptions& options) : Node("list_parameters", options) {
    declare_parameter("foo", 0);
    declare_parameter("bar", "");
    declare_parameter("baz", 0.);
    declare_parameter("foo.first", 0);
    declare_parameter("foo.second", 0);
    declare_parameter("foobar", false);
    rclcpp::SyncParametersClient client(this);
    if (wait_for_service(client, get_logger())) {
      RCLCPP_INFO(get_logger(), "Setting parameters...");
      client.set_parameters({rclcpp::Parameter("foo", 2), rclcpp::Parameter("bar", "hello"),
                             rclcpp::Parameter("baz", 1.45), rclcpp::Parameter("foo.first", 8),
                             rclcpp::Parameter("foo.second", 42), rclcpp::Parameter("foobar", true)});
      RCLCPP_INFO(get_logger(), "Listing parameters...");
      RCLCPP_INFO(get_logger(), "%s", to_text(client.list_parameters({"foo", "bar"}, 10)).c_str());
    }
    rclcpp::shutdown();
  }
};

class SetAndGetParameters : public rclcpp::Node {
 public:
  explicit SetAndGetParameters(const rclcpp::NodeOptions& options) : Node("set_and_get_parameters", options) {
    declare_parameter("foo", 0);
    declare_parameter("bar", "");
    declare_parameter("baz", 0.);
    declare_parameter("foobar", false);
    declare_parameter("foobarbaz", std::vector<bool>{});
    declare_parameter("toto", std::vector<uint8_t>{});
    rclcpp::SyncParametersClient client(this);
    if (wait_for_service(client, get_logger())) {
      report_failures(client.set_parameters({rclcpp::Parameter("foo", 2), rclcpp::Parameter("bar", "hello"),
                                             rclcpp::Parameter("baz", 1.45), rclcpp::Parameter("foobar", true),
                                             rclcpp::Parameter("foobarbaz", std::vector<bool>{true, false}),
                                             rclcpp::Parameter("toto", std::vector<uint8_t>{0xff, 0x7f})}),
                      get_logger());
      RCLCPP_INFO(get_logger(), "%s", to_text(client.get_parameters({"foo", "baz", "foobarbaz", "toto"})).c_str());
    }
    rclcpp::shutdown();
  }
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ListParameters)
RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::SetAndGetParameters)
