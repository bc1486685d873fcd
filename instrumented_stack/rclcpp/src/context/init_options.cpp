// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/init_options.hpp"

#include <rcl/domain_id.h>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

std::shared_ptr<rcl_init_options_t> zero_initialized() {
  return {new rcl_init_options_t(rcl_get_zero_initialized_init_options()), [](rcl_init_options_t* options) {
            if (options->impl && rcl_init_options_fini(options) != RCL_RET_OK) {
              RCLCPP_ERROR(get_logger("rclcpp"), "failed to finalize rcl init options: %s", rcl_get_error_string().str);
              rcl_reset_error();
            }
            delete options;
          }};
}

std::shared_ptr<rcl_init_options_t> copy_of(const rcl_init_options_t& other) {
  std::shared_ptr<rcl_init_options_t> options = zero_initialized();
  require_ok(rcl_init_options_copy(&other, options.get()), "failed to copy rcl init options");
  return options;
}

}  // namespace

InitOptions::InitOptions(rcl_allocator_t allocator) : init_options_(zero_initialized()) {
  require_ok(rcl_init_options_init(init_options_.get(), allocator), "failed to initialize rcl init options");
}

InitOptions::InitOptions(const rcl_init_options_t& init_options) : init_options_(copy_of(init_options)) {}

InitOptions::InitOptions(const InitOptions& other)
    : shutdown_on_signal(other.shutdown_on_signal),
      init_options_(copy_of(*other.init_options_)),
      auto_initialize_logging_(other.auto_initialize_logging_) {}

InitOptions& InitOptions::operator=(const InitOptions& other) {
  if (this != &other) {
    init_options_ = copy_of(*other.init_options_);
    shutdown_on_signal = other.shutdown_on_signal;
    auto_initialize_logging_ = other.auto_initialize_logging_;
  }
  return *this;
}

InitOptions& InitOptions::auto_initialize_logging(bool initialize_logging) {
  auto_initialize_logging_ = initialize_logging;
  return *this;
}

void InitOptions::set_domain_id(size_t domain_id) {
  require_ok(rcl_init_options_set_domain_id(init_options_.get(), domain_id),
             "failed to set domain id to rcl init options");
}

void InitOptions::use_default_domain_id() {
  size_t domain_id = RCL_DEFAULT_DOMAIN_ID;
  require_ok(rcl_get_default_domain_id(&domain_id), "failed to get default domain id");
  set_domain_id(domain_id);
}

size_t InitOptions::get_domain_id() const {
  size_t domain_id = 0;
  require_ok(rcl_init_options_get_domain_id(init_options_.get(), &domain_id),
             "failed to get domain id from rcl init options");
  return domain_id;
}

}  // namespace rclcpp
