// SPDX-License-Identifier: Apache-2.0
// The traces that an agent records, and their recordings on the way home.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "launcher/machines/clock_offset.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/traced/machine_recorder.hpp"

namespace launch {

class RemoteTraces {
 public:
  using Send = std::function<void(ToAgent kind, const WireWriter& content)>;

  // The clock must outlive this.
  RemoteTraces(EventLoop& loop, std::string machine, ClockOffset& clock, Send send);
  ~RemoteTraces();
  RemoteTraces(const RemoteTraces&) = delete;
  RemoteTraces& operator=(const RemoteTraces&) = delete;

  // This must outlive what it gives.
  std::unique_ptr<MachineRecorder> recorder();

  // A message of the agent about them. Throws WireError for one that it must not send.
  void receive(FromAgent kind, WireReader& reader);
  // The connection is lost: nothing comes any more.
  void lose(const std::string& why);

 private:
  template <typename Interface>
  class Recording;
  class Recorder;
  class Snapshot;
  struct Trace;

  Trace& open(std::uint32_t number);
  void answer(Trace& trace, MachineRecorder::Outcome outcome);
  void take_file(Trace& trace, FromAgent kind, WireReader& reader);

  EventLoop& loop_;
  std::string machine_;
  ClockOffset& clock_;
  Send send_;
  std::optional<std::string> lost_;
  std::uint32_t numbers_ = 0;
  std::map<std::uint32_t, std::unique_ptr<Trace>> traces_;
};

}  // namespace launch
