// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/protocol/outgoing.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace launch {

Outgoing::Outgoing(UniqueFd fd) {
  use(std::move(fd));
}

void Outgoing::use(UniqueFd fd) {
  const std::lock_guard lock(mutex_);
  fd_ = std::move(fd);
  ::fcntl(fd_.get(), F_SETFL, ::fcntl(fd_.get(), F_GETFL) | O_NONBLOCK);
  bytes_.clear();
  begin_ = 0;
  broken_ = false;
}

bool Outgoing::add(std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  if (broken_ || !fd_) {
    return false;
  }
  bytes_ += bytes;
  return write_some();
}

bool Outgoing::flush() {
  const std::lock_guard lock(mutex_);
  return !broken_ && fd_ && write_some();
}

std::size_t Outgoing::waiting() const {
  const std::lock_guard lock(mutex_);
  return bytes_.size() - begin_;
}

void Outgoing::close() {
  const std::lock_guard lock(mutex_);
  fd_.reset();
  bytes_.clear();
  begin_ = 0;
}

UniqueFd Outgoing::take() {
  const std::lock_guard lock(mutex_);
  return std::move(fd_);
}

int Outgoing::fd() const {
  const std::lock_guard lock(mutex_);
  return fd_.get();
}

bool Outgoing::write_some() {
  constexpr std::size_t kMuch = 64 * 1024;
  while (begin_ < bytes_.size()) {
    const ssize_t written = ::write(fd_.get(), bytes_.data() + begin_, bytes_.size() - begin_);
    if (written >= 0) {
      begin_ += static_cast<std::size_t>(written);
    } else if (errno == EAGAIN) {
      break;
    } else if (errno != EINTR) {
      broken_ = true;
      return false;
    }
  }
  if (begin_ == bytes_.size() || begin_ > kMuch) {
    bytes_.erase(0, begin_);
    begin_ = 0;
  }
  return true;
}

}  // namespace launch
