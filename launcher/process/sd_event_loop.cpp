// SPDX-License-Identifier: Apache-2.0
// The EventLoop on sd-event(3). It needs libsystemd only; systemd itself need not run.
#include <pthread.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <systemd/sd-event.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "base/monotonic_clock.hpp"
#include "launcher/process/descriptor_watch.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {
namespace {

// Signals go before everything else. All other sources share one priority, so sd-event takes the source that has waited
// longest: a child that floods its output can't starve timers or posts, as it could with different priorities.
constexpr std::int64_t kSignalPriority = SD_EVENT_PRIORITY_IMPORTANT;

constexpr std::uint64_t kTimerAccuracyMicroseconds = 100;

int check(int result, const char* what) {
  if (result < 0) {
    throw std::system_error(-result, std::system_category(), what);
  }
  return result;
}

struct SourceDeleter {
  void operator()(sd_event_source* source) const { sd_event_source_disable_unref(source); }
};
using SdSource = std::unique_ptr<sd_event_source, SourceDeleter>;

struct EventDeleter {
  void operator()(sd_event* event) const { sd_event_unref(event); }
};

class SdEventLoop final : public EventLoop {
 public:
  SdEventLoop();
  ~SdEventLoop() override;

  SourcePtr on_readable(int fd, Callback callback) override { return watch_.on_readable(fd, std::move(callback)); }
  SourcePtr on_writable(int fd, Callback callback) override { return watch_.on_writable(fd, std::move(callback)); }
  SourcePtr on_exit(int pidfd, Callback callback) override { return watch_.on_exit(pidfd, std::move(callback)); }
  SourcePtr after(Duration delay, Callback callback) override;
  SourcePtr on_signal(const std::vector<int>& signals, std::function<void(Signal)> callback) override;
  void post(Callback callback) override;
  Duration now() const override;
  void run() override;
  void quit() override { quit_ = true; }

 private:
  // Lives until its Handle is gone and none of its callbacks is running.
  struct Registration : std::enable_shared_from_this<Registration> {
    explicit Registration(SdEventLoop& owner) : loop(owner) {}

    SdEventLoop& loop;
    Callback callback;
    std::function<void(Signal)> signal_callback;
    std::vector<SdSource> sources;
    bool cancelled = false;
  };

  class Handle final : public Source {
   public:
    explicit Handle(std::shared_ptr<Registration> registration) : registration_(std::move(registration)) {}
    ~Handle() override {
      registration_->cancelled = true;
      registration_->sources.clear();
    }

   private:
    std::shared_ptr<Registration> registration_;
  };

  static int descriptors_ready(sd_event_source* source, int fd, std::uint32_t events, void* data);
  static int expired(sd_event_source* source, std::uint64_t microseconds, void* data);
  static int signalled(sd_event_source* source, const signalfd_siginfo* info, void* data);
  static int posted(sd_event_source* source, int fd, std::uint32_t events, void* data);

  // Keeps exceptions of callbacks out of sd-event's C frames; run() throws them again.
  template <typename Function>
  void guard(Function&& function) noexcept {
    try {
      function();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  bool interrupted() const { return quit_ || failure_; }
  void run_posted();

  std::unique_ptr<sd_event, EventDeleter> event_;
  bool quit_ = false;
  std::exception_ptr failure_;

  DescriptorWatch watch_;
  SdSource watch_source_;

  UniqueFd post_fd_;
  SdSource post_source_;
  std::mutex post_mutex_;
  std::deque<Callback> posts_;  // guarded by post_mutex_
};

SdEventLoop::SdEventLoop() {
  sd_event* event = nullptr;
  check(sd_event_new(&event), "cannot create an event loop");
  event_.reset(event);

  sd_event_source* source = nullptr;
  check(sd_event_add_io(event, &source, watch_.fd(), EPOLLIN, &SdEventLoop::descriptors_ready, this),
        "cannot watch descriptors");
  watch_source_.reset(source);

  post_fd_.reset(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!post_fd_) {
    throw std::system_error(errno, std::system_category(), "cannot create an eventfd");
  }
  check(sd_event_add_io(event, &source, post_fd_.get(), EPOLLIN, &SdEventLoop::posted, this),
        "cannot watch an eventfd");
  post_source_.reset(source);
}

SdEventLoop::~SdEventLoop() = default;

int SdEventLoop::descriptors_ready(sd_event_source*, int, std::uint32_t, void* data) {
  auto& loop = *static_cast<SdEventLoop*>(data);
  loop.guard([&] {
    loop.watch_.run_batch([&](const Callback& callback) { loop.guard(callback); }, [&] { return loop.interrupted(); });
  });
  return 0;
}

EventLoop::SourcePtr SdEventLoop::after(Duration delay, Callback callback) {
  auto registration = std::make_shared<Registration>(*this);
  registration->callback = std::move(callback);
  const Duration start = now();
  const Duration due = delay > Duration::max() - start ? Duration::max() : start + std::max(delay, Duration{0});
  const auto microseconds = std::chrono::ceil<std::chrono::microseconds>(due).count();
  sd_event_source* source = nullptr;
  check(sd_event_add_time(event_.get(), &source, CLOCK_MONOTONIC, static_cast<std::uint64_t>(microseconds),
                          kTimerAccuracyMicroseconds, &SdEventLoop::expired, registration.get()),
        "cannot create a timer");
  registration->sources.emplace_back(source);
  return std::make_unique<Handle>(std::move(registration));
}

int SdEventLoop::expired(sd_event_source*, std::uint64_t, void* data) {
  const auto registration = static_cast<Registration*>(data)->shared_from_this();
  registration->loop.guard(registration->callback);
  return 0;
}

EventLoop::SourcePtr SdEventLoop::on_signal(const std::vector<int>& signals, std::function<void(Signal)> callback) {
  auto registration = std::make_shared<Registration>(*this);
  registration->signal_callback = std::move(callback);
  sigset_t mask;
  sigemptyset(&mask);
  for (const int signal : signals) {
    sigaddset(&mask, signal);
  }
  check(-pthread_sigmask(SIG_BLOCK, &mask, nullptr), "cannot block signals");
  for (const int signal : signals) {
    sd_event_source* source = nullptr;
    check(sd_event_add_signal(event_.get(), &source, signal, &SdEventLoop::signalled, registration.get()),
          "cannot watch a signal");
    registration->sources.emplace_back(source);
    check(sd_event_source_set_priority(source, kSignalPriority), "cannot set the priority of an event source");
  }
  return std::make_unique<Handle>(std::move(registration));
}

int SdEventLoop::signalled(sd_event_source*, const signalfd_siginfo* info, void* data) {
  const auto registration = static_cast<Registration*>(data)->shared_from_this();
  const Signal signal{static_cast<int>(info->ssi_signo), info->ssi_code == SI_KERNEL};
  registration->loop.guard([&] { registration->signal_callback(signal); });
  return 0;
}

void SdEventLoop::post(Callback callback) {
  bool first = false;
  {
    const std::lock_guard lock(post_mutex_);
    first = posts_.empty();
    posts_.push_back(std::move(callback));
  }
  if (first) {
    // This can only fail when the counter is full, and then the loop is going to wake up anyway.
    static_cast<void>(eventfd_write(post_fd_.get(), 1));
  }
}

int SdEventLoop::posted(sd_event_source*, int, std::uint32_t, void* data) {
  auto& loop = *static_cast<SdEventLoop*>(data);
  loop.guard([&] { loop.run_posted(); });
  return 0;
}

void SdEventLoop::run_posted() {
  eventfd_t count = 0;
  static_cast<void>(eventfd_read(post_fd_.get(), &count));
  std::deque<Callback> batch;
  {
    const std::lock_guard lock(post_mutex_);
    batch.swap(posts_);
  }
  while (!batch.empty() && !interrupted()) {
    const Callback callback = std::move(batch.front());
    batch.pop_front();
    guard(callback);
  }
  if (!batch.empty()) {
    const std::lock_guard lock(post_mutex_);
    posts_.insert(posts_.begin(), std::make_move_iterator(batch.begin()), std::make_move_iterator(batch.end()));
    static_cast<void>(eventfd_write(post_fd_.get(), 1));
  }
}

Duration SdEventLoop::now() const {
  return std::chrono::nanoseconds(monotonic_time());
}

void SdEventLoop::run() {
  while (!quit_) {
    check(sd_event_run(event_.get(), std::numeric_limits<std::uint64_t>::max()), "the event loop failed");
    if (failure_) {
      std::rethrow_exception(std::exchange(failure_, nullptr));
    }
  }
  quit_ = false;
}

}  // namespace

std::unique_ptr<EventLoop> make_sd_event_loop() {
  return std::make_unique<SdEventLoop>();
}

}  // namespace launch
