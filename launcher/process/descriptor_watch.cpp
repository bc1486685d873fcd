// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/descriptor_watch.hpp"

#include <sys/epoll.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

namespace launch {
namespace {

constexpr int kBatch = 64;
// An exit is reported once. EPOLLONESHOT keeps the registration, so that it can be armed again.
constexpr std::uint32_t kReadable = EPOLLIN;
constexpr std::uint32_t kWritable = EPOLLOUT;
constexpr std::uint32_t kExit = EPOLLIN | EPOLLONESHOT;

[[noreturn]] void fail_to_watch(const char* what) {
  throw std::system_error(errno, std::system_category(), what);
}

}  // namespace

class DescriptorWatch::Registration : public std::enable_shared_from_this<Registration> {
 public:
  Registration(std::shared_ptr<UniqueFd> epoll, int fd, std::uint32_t events, EventLoop::Callback callback)
      : epoll_(std::move(epoll)), fd_(fd), events_(events), callback_(std::move(callback)) {
    change(EPOLL_CTL_ADD);
  }
  // No callback comes after this, even if the descriptor is already in a batch.
  void cancel() {
    cancelled_ = true;
    ::epoll_ctl(epoll_->get(), EPOLL_CTL_DEL, fd_, nullptr);
  }
  void rearm() { change(EPOLL_CTL_MOD); }

  bool cancelled() const { return cancelled_; }
  bool is_exit() const { return events_ == kExit; }
  const EventLoop::Callback& callback() const { return callback_; }

 private:
  void change(int operation) {
    epoll_event event{};
    event.events = events_;
    event.data.ptr = this;
    if (::epoll_ctl(epoll_->get(), operation, fd_, &event) != 0) {
      fail_to_watch("cannot watch a descriptor");
    }
  }

  std::shared_ptr<UniqueFd> epoll_;
  int fd_;
  std::uint32_t events_;
  EventLoop::Callback callback_;
  bool cancelled_ = false;
};

class DescriptorWatch::Handle final : public EventLoop::Source {
 public:
  explicit Handle(std::shared_ptr<Registration> registration) : registration_(std::move(registration)) {}
  ~Handle() override { registration_->cancel(); }

 private:
  std::shared_ptr<Registration> registration_;
};

DescriptorWatch::DescriptorWatch() : epoll_(std::make_shared<UniqueFd>(::epoll_create1(EPOLL_CLOEXEC))) {
  if (!*epoll_) {
    fail_to_watch("cannot create an epoll instance");
  }
}

EventLoop::SourcePtr DescriptorWatch::on_readable(int fd, EventLoop::Callback callback) {
  return add(fd, kReadable, std::move(callback));
}

EventLoop::SourcePtr DescriptorWatch::on_writable(int fd, EventLoop::Callback callback) {
  return add(fd, kWritable, std::move(callback));
}

EventLoop::SourcePtr DescriptorWatch::on_exit(int pidfd, EventLoop::Callback callback) {
  return add(pidfd, kExit, std::move(callback));
}

EventLoop::SourcePtr DescriptorWatch::add(int fd, std::uint32_t events, EventLoop::Callback callback) {
  return std::make_unique<Handle>(std::make_shared<Registration>(epoll_, fd, events, std::move(callback)));
}

void DescriptorWatch::run_batch(const std::function<void(const EventLoop::Callback&)>& call,
                                const std::function<bool()>& stop) {
  std::array<epoll_event, kBatch> events{};
  const int count = ::epoll_wait(epoll_->get(), events.data(), kBatch, 0);
  if (count < 0) {
    if (errno == EINTR) {
      return;
    }
    fail_to_watch("cannot wait for descriptors");
  }
  // The batch owns them before the first callback, which may cancel any of them.
  std::vector<std::shared_ptr<Registration>> ready;
  ready.reserve(static_cast<std::size_t>(count));
  for (const bool exits : {false, true}) {
    for (int i = 0; i < count; ++i) {
      auto* registration = static_cast<Registration*>(events[static_cast<std::size_t>(i)].data.ptr);
      if (registration->is_exit() == exits) {
        ready.push_back(registration->shared_from_this());
      }
    }
  }
  bool stopped = false;
  for (const std::shared_ptr<Registration>& registration : ready) {
    if (registration->cancelled()) {
      continue;
    }
    if (stopped) {
      registration->rearm();
    } else {
      call(registration->callback());
      stopped = stop();
    }
  }
}

}  // namespace launch
