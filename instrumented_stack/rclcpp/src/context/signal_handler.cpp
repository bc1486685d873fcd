// SPDX-License-Identifier: Apache-2.0
// Turns SIGINT and SIGTERM into the shutdown of the contexts that ask for it.
//
// The handler itself only writes to an eventfd. A separate thread reads it and shuts the contexts down. There, locks
// and callbacks are allowed.

#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <system_error>
#include <thread>

#include "rclcpp/context.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/utilities.hpp"
#include "rcutils/joined_thread.hpp"

namespace rclcpp {

namespace {

// The data that the handler uses: lock-free atomics and an fd, which live as long as the process.
std::atomic<int> event_fd{-1};
std::atomic<int> last_signal{0};
std::atomic<bool> stop_thread{false};

// The handler that the program had set before, of either kind. It is called before ours.
struct PreviousHandler {
  std::atomic<void (*)(int)> plain{nullptr};
  std::atomic<void (*)(int, siginfo_t*, void*)> with_info{nullptr};

  void set(const struct sigaction& action) {
    const bool takes_info = (action.sa_flags & SA_SIGINFO) != 0;
    const bool is_function = action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN;
    plain = is_function && !takes_info ? action.sa_handler : nullptr;
    with_info = is_function && takes_info ? action.sa_sigaction : nullptr;
  }
  void call(int signal_number, siginfo_t* info, void* context) const {
    if (const auto function = with_info.load()) {
      function(signal_number, info, context);
    } else if (const auto plain_function = plain.load()) {
      plain_function(signal_number);
    }
  }
};
PreviousHandler previous_of_sigint;
PreviousHandler previous_of_sigterm;

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<void (*)(int)>::is_always_lock_free);

void wake_thread() {
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(event_fd, &one, sizeof one);  // fails only if a wake-up is pending
}

bool handles_sigint(SignalHandlerOptions options) {
  return options == SignalHandlerOptions::All || options == SignalHandlerOptions::SigInt;
}

bool handles_sigterm(SignalHandlerOptions options) {
  return options == SignalHandlerOptions::All || options == SignalHandlerOptions::SigTerm;
}

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
  rcutils::JoinedThread thread_;
};

}  // namespace

SignalHandler& SignalHandler::instance() {
  static SignalHandler handler;
  return handler;
}

SignalHandler::~SignalHandler() {
  uninstall();
  if (thread_.joinable()) {
    thread_.join();
  }
}

bool SignalHandler::install(SignalHandlerOptions options) {
  const std::lock_guard lock(mutex_);
  if (installed_ || options == SignalHandlerOptions::None) {
    return false;
  }
  if (thread_.joinable()) {
    thread_.join();  // from an earlier installation; uninstall() told it to end
  }
  if (event_fd < 0) {
    event_fd = eventfd(0, EFD_CLOEXEC | EFD_SEMAPHORE);
    if (event_fd < 0) {
      throw std::system_error(errno, std::generic_category(), "eventfd");
    }
  }
  stop_thread = false;
  options_ = options;
  thread_ = rcutils::JoinedThread([this] { run(); });

  struct sigaction action {};
  action.sa_sigaction = &SignalHandler::handle;
  action.sa_flags = SA_SIGINFO;  // no SA_RESTART: a thread that reads or sleeps goes on and sees the end of the context
  if (handles_sigint(options)) {
    sigaction(SIGINT, nullptr, &previous_sigint_);
    previous_of_sigint.set(previous_sigint_);
    sigaction(SIGINT, &action, nullptr);
  }
  if (handles_sigterm(options)) {
    sigaction(SIGTERM, nullptr, &previous_sigterm_);
    previous_of_sigterm.set(previous_sigterm_);
    sigaction(SIGTERM, &action, nullptr);
  }
  installed_ = true;
  return true;
}

bool SignalHandler::uninstall() {
  const std::lock_guard lock(mutex_);
  if (!installed_) {
    return false;
  }
  if (handles_sigint(options_)) {
    sigaction(SIGINT, &previous_sigint_, nullptr);
  }
  if (handles_sigterm(options_)) {
    sigaction(SIGTERM, &previous_sigterm_, nullptr);
  }
  installed_ = false;
  options_ = SignalHandlerOptions::None;
  stop_thread = true;
  if (thread_.is_of_this_process()) {
    wake_thread();
  }
  if (std::this_thread::get_id() != thread_.get_id()) {
    thread_.join();
  }
  return true;
}

bool SignalHandler::is_installed() {
  const std::lock_guard lock(mutex_);
  return installed_;
}

SignalHandlerOptions SignalHandler::current_options() {
  const std::lock_guard lock(mutex_);
  return options_;
}

void SignalHandler::handle(int signal_number, siginfo_t* info, void* context) {
  const int saved_errno = errno;
  (signal_number == SIGINT ? previous_of_sigint : previous_of_sigterm).call(signal_number, info, context);
  last_signal = signal_number;
  wake_thread();
  errno = saved_errno;
}

void SignalHandler::run() {
  while (true) {
    // A signal that came before the end of this thread must not be left to the next one, whose contexts are others.
    const bool is_last = stop_thread;
    if (const int signal_number = last_signal.exchange(0)) {
      RCLCPP_INFO(get_logger("rclcpp"), "signal_handler(signum=%d)", signal_number);
      for (const Context::SharedPtr& context : get_contexts()) {
        if (context->get_init_options().shutdown_on_signal) {
          context->shutdown("signal handler");
        }
      }
    }
    if (is_last) {
      return;
    }
    uint64_t count = 0;
    [[maybe_unused]] const ssize_t size = read(event_fd, &count, sizeof count);  // EINTR: a signal in this thread
  }
}

// The functions of rclcpp/utilities.hpp.

bool install_signal_handlers(SignalHandlerOptions signal_handler_options) {
  return SignalHandler::instance().install(signal_handler_options);
}

bool signal_handlers_installed() {
  return SignalHandler::instance().is_installed();
}

SignalHandlerOptions get_current_signal_handler_options() {
  return SignalHandler::instance().current_options();
}

bool uninstall_signal_handlers() {
  return SignalHandler::instance().uninstall();
}

}  // namespace rclcpp
