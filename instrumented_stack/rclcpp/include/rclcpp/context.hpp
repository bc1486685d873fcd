// SPDX-License-Identifier: Apache-2.0
// One initialisation of ROS: the command line arguments, the middleware, and their common end.
//
// A process normally has one, which rclcpp::init() sets up. Nodes, executors and guard conditions keep their context
// alive. A context that was shut down can be initialised again.
#pragma once

#include <rcl/context.h>
#include <rcl/guard_condition.h>
#include <rcl/wait.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <typeindex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rclcpp/init_options.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp {

class ContextAlreadyInitialized : public std::runtime_error {
 public:
  ContextAlreadyInitialized() : std::runtime_error("context is already initialized") {}
};

// Identifies a registered callback, so that it can be removed.
class ShutdownCallbackHandle {
  friend class Context;
  std::weak_ptr<std::function<void()>> callback;
};
using OnShutdownCallbackHandle = ShutdownCallbackHandle;
using PreShutdownCallbackHandle = ShutdownCallbackHandle;

class Context : public std::enable_shared_from_this<Context> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Context)

  Context();
  // Shuts the context down unless that has happened already.
  virtual ~Context();

  // Parses the arguments after --ros-args and starts the middleware. Throws ContextAlreadyInitialized,
  // exceptions::UnknownROSArgsError, exceptions::RCLInvalidROSArgsError or exceptions::RCLError.
  virtual void init(int argc, const char* const* argv, const InitOptions& init_options = InitOptions());

  bool is_valid() const { return valid_; }
  const InitOptions& get_init_options() const { return init_options_; }
  size_t get_domain_id() const;

  // Empty until the context is shut down.
  std::string shutdown_reason() const;

  // Runs the pre-shutdown callbacks, invalidates the context, runs the on-shutdown callbacks and ends every
  // sleep_for(). May be called from any thread, but not from a signal handler. Returns false if the context was not
  // valid.
  virtual bool shutdown(const std::string& reason);

  // On-shutdown callbacks run in the thread that calls shutdown(), in the order of their registration.
  using OnShutdownCallback = std::function<void()>;
  OnShutdownCallback on_shutdown(OnShutdownCallback callback);
  OnShutdownCallbackHandle add_on_shutdown_callback(OnShutdownCallback callback);
  bool remove_on_shutdown_callback(const OnShutdownCallbackHandle& handle);

  // While pre-shutdown callbacks run, the context is still valid.
  using PreShutdownCallback = std::function<void()>;
  PreShutdownCallbackHandle add_pre_shutdown_callback(PreShutdownCallback callback);
  bool remove_pre_shutdown_callback(const PreShutdownCallbackHandle& handle);

  // Copies of the callbacks that are registered.
  std::vector<OnShutdownCallback> get_on_shutdown_callbacks() const;
  std::vector<PreShutdownCallback> get_pre_shutdown_callbacks() const;

  // Returns true after the whole time, false if the context ended first.
  bool sleep_for(const std::chrono::nanoseconds& nanoseconds);
  // Ends every sleep_for() of this context.
  void interrupt_all_sleep_for();

  std::shared_ptr<rcl_context_t> get_rcl_context() const { return rcl_context_; }

  // The one object of this type in the context. The first call makes it.
  template <typename SubContextT, typename... ArgumentTs>
  std::shared_ptr<SubContextT> get_sub_context(ArgumentTs&&... arguments) {
    const std::lock_guard lock(sub_contexts_mutex_);
    std::shared_ptr<void>& sub_context = sub_contexts_[typeid(SubContextT)];
    if (!sub_context) {
      sub_context = std::make_shared<SubContextT>(std::forward<ArgumentTs>(arguments)...);
    }
    return std::static_pointer_cast<SubContextT>(sub_context);
  }

 private:
  using Callbacks = std::vector<std::shared_ptr<std::function<void()>>>;

  ShutdownCallbackHandle add(Callbacks& callbacks, std::function<void()> callback);
  bool remove(Callbacks& callbacks, const ShutdownCallbackHandle& handle);
  void run(const Callbacks& callbacks);
  std::vector<std::function<void()>> copy_of(const Callbacks& callbacks) const;

  mutable std::recursive_mutex init_mutex_;  // recursive: shutdown callbacks may call back
  std::atomic<bool> valid_{false};           // not under the mutex, so that ok() never waits for a running shutdown
  std::shared_ptr<rcl_context_t> rcl_context_;
  std::shared_ptr<void> logging_;
  InitOptions init_options_;
  std::string shutdown_reason_;

  mutable std::mutex callbacks_mutex_;
  Callbacks pre_shutdown_callbacks_;
  Callbacks on_shutdown_callbacks_;

  std::recursive_mutex sub_contexts_mutex_;  // recursive: one may need another
  std::unordered_map<std::type_index, std::shared_ptr<void>> sub_contexts_;

  std::mutex interrupt_mutex_;
  std::condition_variable interrupt_condition_variable_;
  size_t interruptions_ = 0;
};

// Every valid context of the process.
std::vector<Context::SharedPtr> get_contexts();

}  // namespace rclcpp
