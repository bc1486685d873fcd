// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/context.hpp"

#include <rcl/arguments.h>
#include <rcl/init.h>
#include <rcl/logging.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/progress.hpp"
#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/detail/rcl_arguments.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

// The valid contexts, for the signal handler, which must not own them. Never destroyed, because contexts in static
// storage remove themselves when the process ends.
struct ValidContexts {
  std::mutex mutex;
  std::vector<std::weak_ptr<Context>> contexts;
};

ValidContexts& valid_contexts() {
  static auto* const contexts = new ValidContexts;
  return *contexts;
}

// Console levels and /rosout belong to the process. The first context configures them, the last one restores them.
std::mutex logging_mutex;
size_t logging_users = 0;

std::shared_ptr<void> use_logging(const rcl_context_t& context) {
  const std::lock_guard lock(logging_mutex);
  if (logging_users == 0) {
    const rcl_allocator_t allocator = rcl_get_default_allocator();
    require_ok(rcl_logging_configure(&context.global_arguments, &allocator), "failed to configure logging");
  }
  ++logging_users;
  return {nullptr, [](void*) {
            const std::lock_guard last_user_lock(logging_mutex);
            if (--logging_users == 0) {
              detail::ignore_error(rcl_logging_fini());
            }
          }};
}

}  // namespace

Context::Context() = default;

Context::~Context() {
  try {
    shutdown("context destructor was called while still not shutdown");
  } catch (const std::exception& error) {
    RCLCPP_ERROR(get_logger("rclcpp"), "failed to shut a context down in its destructor: %s", error.what());
  }
}

void Context::init(int argc, const char* const* argv, const InitOptions& init_options) {
  const std::lock_guard lock(init_mutex_);
  if (is_valid()) {
    throw ContextAlreadyInitialized();
  }
  // Nodes of an earlier initialisation keep their rcl context. If a step below fails, the deleter cleans up everything.
  const std::shared_ptr<rcl_context_t> rcl_context(
      new rcl_context_t(rcl_get_zero_initialized_context()), [](rcl_context_t* context) {
        if (rcl_context_is_valid(context) && rcl_shutdown(context) != RCL_RET_OK) {
          RCLCPP_ERROR(get_logger("rclcpp"), "failed to shut an rcl context down: %s", rcl_get_error_string().str);
          rcl_reset_error();
        }
        detail::log_error(rcl_context_fini(context), "failed to finalize an rcl context");
        delete context;
      });
  require_ok(rcl_init(argc, argv, init_options.get_rcl_init_options(), rcl_context.get()), "failed to initialize rcl");
  std::vector<std::string> unknown = detail::unparsed_ros_arguments(argv, rcl_context->global_arguments);
  if (!unknown.empty()) {
    throw exceptions::UnknownROSArgsError(std::move(unknown));
  }
  if (init_options.auto_initialize_logging()) {
    logging_ = use_logging(*rcl_context);
  }
  init_options_ = init_options;
  shutdown_reason_.clear();
  rcl_context_ = rcl_context;
  valid_ = true;
  progress::join();

  ValidContexts& valid = valid_contexts();
  const std::lock_guard valid_lock(valid.mutex);
  valid.contexts.push_back(weak_from_this());
}

size_t Context::get_domain_id() const {
  const std::lock_guard lock(init_mutex_);
  size_t domain_id = 0;
  if (!rcl_context_) {
    throw std::runtime_error("context is not initialized");
  }
  require_ok(rcl_context_get_domain_id(rcl_context_.get(), &domain_id), "failed to get domain id from context");
  return domain_id;
}

std::string Context::shutdown_reason() const {
  const std::lock_guard lock(init_mutex_);
  return shutdown_reason_;
}

bool Context::shutdown(const std::string& reason) {
  // Held until the end: if two threads shut down, the later one returns when everything is done.
  const std::lock_guard lock(init_mutex_);
  if (!is_valid()) {
    return false;
  }
  run(pre_shutdown_callbacks_);
  require_ok(rcl_shutdown(rcl_context_.get()), "failed to shut the context down");
  valid_ = false;
  shutdown_reason_ = reason;
  run(on_shutdown_callbacks_);
  interrupt_all_sleep_for();
  {
    ValidContexts& valid = valid_contexts();
    const std::lock_guard valid_lock(valid.mutex);
    valid.contexts.erase(std::remove_if(valid.contexts.begin(), valid.contexts.end(),
                                        [self = weak_from_this()](const std::weak_ptr<Context>& context) {
                                          return !context.owner_before(self) && !self.owner_before(context);
                                        }),
                         valid.contexts.end());
  }
  logging_.reset();
  return true;
}

Context::OnShutdownCallback Context::on_shutdown(OnShutdownCallback callback) {
  add_on_shutdown_callback(callback);
  return callback;
}

OnShutdownCallbackHandle Context::add_on_shutdown_callback(OnShutdownCallback callback) {
  return add(on_shutdown_callbacks_, std::move(callback));
}

bool Context::remove_on_shutdown_callback(const OnShutdownCallbackHandle& handle) {
  return remove(on_shutdown_callbacks_, handle);
}

PreShutdownCallbackHandle Context::add_pre_shutdown_callback(PreShutdownCallback callback) {
  return add(pre_shutdown_callbacks_, std::move(callback));
}

std::vector<Context::OnShutdownCallback> Context::get_on_shutdown_callbacks() const {
  return copy_of(on_shutdown_callbacks_);
}

std::vector<Context::PreShutdownCallback> Context::get_pre_shutdown_callbacks() const {
  return copy_of(pre_shutdown_callbacks_);
}

std::vector<std::function<void()>> Context::copy_of(const Callbacks& callbacks) const {
  std::vector<std::function<void()>> copies;
  const std::lock_guard lock(callbacks_mutex_);
  for (const auto& callback : callbacks) {
    copies.push_back(*callback);
  }
  return copies;
}

bool Context::remove_pre_shutdown_callback(const PreShutdownCallbackHandle& handle) {
  return remove(pre_shutdown_callbacks_, handle);
}

bool Context::sleep_for(const std::chrono::nanoseconds& nanoseconds) {
  const auto until = std::chrono::steady_clock::now() + nanoseconds;
  std::unique_lock lock(interrupt_mutex_);
  const size_t interruptions = interruptions_;
  interrupt_condition_variable_.wait_until(lock, until, [&] { return interruptions_ != interruptions || !is_valid(); });
  return is_valid();
}

void Context::interrupt_all_sleep_for() {
  const std::lock_guard lock(interrupt_mutex_);
  ++interruptions_;
  interrupt_condition_variable_.notify_all();
}

ShutdownCallbackHandle Context::add(Callbacks& callbacks, std::function<void()> callback) {
  auto shared = std::make_shared<std::function<void()>>(std::move(callback));
  ShutdownCallbackHandle handle;
  handle.callback = shared;
  const std::lock_guard lock(callbacks_mutex_);
  callbacks.push_back(std::move(shared));
  return handle;
}

bool Context::remove(Callbacks& callbacks, const ShutdownCallbackHandle& handle) {
  const std::lock_guard lock(callbacks_mutex_);
  const auto found = std::find(callbacks.begin(), callbacks.end(), handle.callback.lock());
  if (found == callbacks.end()) {
    return false;
  }
  callbacks.erase(found);
  return true;
}

void Context::run(const Callbacks& callbacks) {
  Callbacks now;
  {
    const std::lock_guard lock(callbacks_mutex_);
    now = callbacks;  // a callback may register or remove another one
  }
  for (const auto& callback : now) {
    (*callback)();
  }
}

std::vector<Context::SharedPtr> get_contexts() {
  ValidContexts& valid = valid_contexts();
  const std::lock_guard lock(valid.mutex);
  std::vector<Context::SharedPtr> contexts;
  for (const std::weak_ptr<Context>& weak : valid.contexts) {
    if (auto context = weak.lock()) {
      contexts.push_back(std::move(context));
    }
  }
  return contexts;
}

contexts::DefaultContext::SharedPtr contexts::get_global_default_context() {
  static const auto context = std::make_shared<DefaultContext>();
  return context;
}

}  // namespace rclcpp
