// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/child_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <utility>

namespace launch {
namespace {

constexpr std::size_t kReadSize = 64 * 1024;  // capacity of a pipe; also the share of a stream in one turn of the loop
constexpr std::size_t kDrainLimit = 1024 * 1024;

}  // namespace

void ChildOutput::follow(Process& process, EventLoop::Callback on_end, Observer on_bytes) {
  on_end_ = std::move(on_end);
  on_bytes_ = std::move(on_bytes);
  streams_[0].fd = std::move(process.out);
  streams_[1].fd = std::move(process.err);
  for (Stream& stream : streams_) {
    if (!stream.fd) {
      continue;
    }
    stream.source = loop_.on_readable(stream.fd.get(), [this, &stream] {
      read(stream, kReadSize);
      if (!is_open()) {
        on_end_();
      }
    });
  }
}

void ChildOutput::drain() {
  for (Stream& stream : streams_) {
    if (stream.fd) {
      read(stream, kDrainLimit);
    }
  }
}

void ChildOutput::close() {
  for (Stream& stream : streams_) {
    close(stream);
  }
}

const OutputTargets& ChildOutput::targets(const Stream& stream) const {
  return stream.which == OutputStream::kOut ? owner_.routing.out : owner_.routing.err;
}

void ChildOutput::read(Stream& stream, std::size_t limit) {
  std::array<char, kReadSize> buffer;  // not initialised: clearing 64 KiB for each line would take noticeable time
  for (std::size_t total = 0; total < limit;) {
    const ssize_t size = ::read(stream.fd.get(), buffer.data(), buffer.size());
    if (size > 0) {
      if (on_bytes_) {
        on_bytes_({buffer.data(), static_cast<std::size_t>(size)});
      }
      router_.write(owner_.id, owner_.label, stream.which, targets(stream),
                    {buffer.data(), static_cast<std::size_t>(size)});
      total += static_cast<std::size_t>(size);
    } else if (size < 0 && errno == EAGAIN) {
      return;
    } else if (size == 0 || errno != EINTR) {
      close(stream);  // end of the stream; a pseudo-terminal reports it as the error EIO
      return;
    }
  }
}

void ChildOutput::close(Stream& stream) {
  if (stream.fd) {
    stream.source.reset();
    stream.fd.reset();
    router_.close_stream(owner_.id, owner_.label, stream.which, targets(stream));
  }
}

}  // namespace launch
