// SPDX-License-Identifier: Apache-2.0
// Readiness of many descriptors, batch by batch: one epoll(7) instance that stands in the event loop as one source.
//
// sd-event dispatches one source for each epoll_wait(), asks for all ready descriptors each time, and keeps no order
// among descriptors that it finds at once. With hundreds of children that end together this was a third of the cost of
// stopping them. Here one call fetches a whole batch, the kernel keeps the turn (a descriptor that stays ready goes to
// the end of its queue), and exits come after the output found with them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "base/files/unique_fd.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

class DescriptorWatch {
 public:
  DescriptorWatch();  // throws std::system_error

  // Readable whenever run_batch() has something to do.
  int fd() const { return epoll_->get(); }

  // As the functions of EventLoop with these names.
  EventLoop::SourcePtr on_readable(int fd, EventLoop::Callback callback);
  EventLoop::SourcePtr on_writable(int fd, EventLoop::Callback callback);
  EventLoop::SourcePtr on_exit(int pidfd, EventLoop::Callback callback);

  // Calls back for a bounded number of ready descriptors, and stops when `stop` returns true after a callback. The next
  // batch finds the descriptors that were left.
  void run_batch(const std::function<void(const EventLoop::Callback&)>& call, const std::function<bool()>& stop);

 private:
  class Registration;
  class Handle;

  EventLoop::SourcePtr add(int fd, std::uint32_t events, EventLoop::Callback callback);

  std::shared_ptr<UniqueFd> epoll_;  // shared with the handles, which may live longer
};

}  // namespace launch
