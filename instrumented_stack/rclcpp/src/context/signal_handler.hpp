// SPDX-License-Identifier: Apache-2.0
// Turns SIGINT and SIGTERM into the shutdown of the contexts that ask for it.
//
// The handler itself only writes to an eventfd. A separate thread reads it and shuts the contexts down. There, locks
// and callbacks are allowed.
#pragma once

#include <atomic>
#include <csignal>
#include <mutex>
#include <thread>

#include "rclcpp/utilities.hpp"

namespace rclcpp {

class SignalHandler {
 public:
  static SignalHandler& instance();

  SignalHandler(const SignalHandler&) = delete;
  SignalHandler& operator=(const SignalHandler&) = delete;

  bool install(SignalHandlerOptions options);
  // May be called from a shutdown that a signal caused. The thread then ends by itself.
  bool uninstall();
  bool is_installed();
  SignalHandlerOptions current_options();

 private:
  SignalHandler() = default;
  ~SignalHandler();

  static void handle(int signal_number, siginfo_t* info, void* context);
  void run();

  std::mutex mutex_;
  bool installed_ = false;
  SignalHandlerOptions options_ = SignalHandlerOptions::None;
  struct sigaction previous_sigint_ {};
  struct sigaction previous_sigterm_ {};
  std::thread thread_;
};

}  // namespace rclcpp
