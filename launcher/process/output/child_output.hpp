// SPDX-License-Identifier: Apache-2.0
// Standard output and error of one child, on their way from its pipes to the OutputRouter.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

class ChildOutput {
 public:
  // The process that writes the output. The references must stay valid.
  struct Owner {
    ProcessId id;
    const std::string& label;
    const OutputRouting& routing;
  };

  ChildOutput(EventLoop& loop, OutputRouter& router, Owner owner) : loop_(loop), router_(router), owner_(owner) {}

  using Observer = std::function<void(std::string_view bytes)>;

  // Takes the read ends, which must not block, from a started process and follows them; there may be one only. `on_end`
  // is called from the loop when both have ended, but not by drain() or close(). `on_bytes` gets what is read, as it
  // comes; it may be null.
  void follow(Process& process, EventLoop::Callback on_end, Observer on_bytes = nullptr);
  bool is_open() const { return streams_[0].fd || streams_[1].fd; }

  // Reads what is there, up to a bound, because descendants of an ended child may go on writing.
  void drain();
  // Stops following, and writes a line that has begun.
  void close();

 private:
  struct Stream {
    OutputStream which;
    UniqueFd fd{};
    EventLoop::SourcePtr source{};
  };

  const OutputTargets& targets(const Stream& stream) const;
  void read(Stream& stream, std::size_t limit);
  void close(Stream& stream);

  EventLoop& loop_;
  OutputRouter& router_;
  Owner owner_;
  EventLoop::Callback on_end_;
  Observer on_bytes_;
  std::array<Stream, 2> streams_{{{OutputStream::kOut}, {OutputStream::kErr}}};
};

}  // namespace launch
