// Prints what is said on topic chatter: the component of demo_nodes_cpp.
#include "rclcpp_components/node_main.hpp"

int main(int argc, char** argv) {
  return rclcpp_components::node_main<rclcpp::executors::SingleThreadedExecutor>("demo_nodes_cpp::Listener", argc,
                                                                                 argv);
}
