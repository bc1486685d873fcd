// SPDX-License-Identifier: Apache-2.0
// The options of a Context besides the command line.
#pragma once

#include <rcl/init_options.h>

#include <cstddef>
#include <memory>

namespace rclcpp {

class InitOptions {
 public:
  // If true, SIGINT and SIGTERM shut the context down, provided that the signal handlers are installed.
  bool shutdown_on_signal = true;

  explicit InitOptions(rcl_allocator_t allocator = rcl_get_default_allocator());
  explicit InitOptions(const rcl_init_options_t& init_options);
  InitOptions(const InitOptions& other);
  InitOptions& operator=(const InitOptions& other);
  ~InitOptions() = default;

  bool auto_initialize_logging() const { return auto_initialize_logging_; }
  InitOptions& auto_initialize_logging(bool initialize_logging);

  // By default the domain comes from ROS_DOMAIN_ID.
  void set_domain_id(size_t domain_id);
  void use_default_domain_id();
  size_t get_domain_id() const;

  const rcl_init_options_t* get_rcl_init_options() const { return init_options_.get(); }

 private:
  std::shared_ptr<rcl_init_options_t> init_options_;
  bool auto_initialize_logging_ = true;
};

}  // namespace rclcpp
