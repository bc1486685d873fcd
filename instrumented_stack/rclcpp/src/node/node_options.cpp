// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_options.hpp"

#include "rclcpp/detail/rcl_arguments.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

const rcl_node_options_t* NodeOptions::get_rcl_node_options() const {
  if (!rcl_node_options_) {
    rcl_node_options_ = make_rcl_node_options();
  }
  return rcl_node_options_.get();
}

std::shared_ptr<const rcl_node_options_t> NodeOptions::make_rcl_node_options() const {
  const std::shared_ptr<rcl_node_options_t> options(new rcl_node_options_t(rcl_node_get_default_options()),
                                                    [](rcl_node_options_t* finished) {
                                                      detail::ignore_error(rcl_node_options_fini(finished));
                                                      delete finished;
                                                    });
  options->allocator = allocator_;
  options->use_global_arguments = use_global_arguments_;
  options->enable_rosout = enable_rosout_;
  options->rosout_qos = rosout_qos_.get_rmw_qos_profile();
  detail::parse_arguments(arguments_, options->arguments);
  return options;
}

}  // namespace rclcpp
