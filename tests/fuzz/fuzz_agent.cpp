// SPDX-License-Identifier: Apache-2.0
// What an agent of another machine sends, and what a launcher sends to an agent: any bytes are read or refused.
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "launcher/machines/fetched_files.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/machines/protocol/kept_frames.hpp"
#include "launcher/machines/protocol/spec_wire.hpp"
#include "launcher/machines/remote_runs.hpp"
#include "launcher/machines/remote_traces.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/traced/machine_trace.hpp"

namespace {

using namespace launch;

template <typename Read>
void attempt(Read read) {
  try {
    read();
  } catch (const WireError&) {
    // refused
  }
}

void read_as_launcher(std::string_view bytes) {
  FakeEventLoop loop;
  RemoteRuns runs(loop, [](ToAgent, const WireWriter&) {});
  ProcessSpec spec;
  spec.name = "talker";
  spec.machine = "arm";
  spec.argv = {"/bin/talker"};
  std::vector<Process> processes;
  processes.push_back(runs.start(spec));
  processes.push_back(runs.start(spec));
  ClockOffset clock;
  RemoteTraces traces(loop, "arm", clock, [](ToAgent, const WireWriter&) {});
  const auto recorder = traces.recorder();
  recorder->begin(
      "", [](const std::string&) {}, [](const MachineRecorder::Reason&) {}, [](const MachineRecorder::Outcome&) {});
  const auto snapshot = recorder->take_snapshot({}, [](const MachineRecorder::Outcome&) {});
  KeptFrames kept;
  kept.add("a");
  kept.add("b");
  Frames frames;
  frames.add(bytes);
  is_path_of_fetched_file(bytes);
  attempt([&] {
    while (const auto frame = frames.take()) {
      WireReader reader(frame->content);
      if (static_cast<FromAgent>(frame->kind) == FromAgent::kHello) {
        parse_agent_hello(frame->content);
      } else if (static_cast<FromAgent>(frame->kind) == FromAgent::kAcknowledge) {
        kept.acknowledge(reader.u64());
      } else if (static_cast<FromAgent>(frame->kind) >= FromAgent::kTraceTold) {
        traces.receive(static_cast<FromAgent>(frame->kind), reader);
      } else {
        runs.receive(static_cast<FromAgent>(frame->kind), reader);
      }
      loop.run_until_idle();
    }
  });
}

void read_as_agent(std::string_view bytes) {
  Frames frames;
  frames.add(bytes);
  attempt([&] {
    while (const auto frame = frames.take()) {
      WireReader reader(frame->content);
      if (static_cast<ToAgent>(frame->kind) == ToAgent::kSetup) {
        parse_agent_setup(frame->content);
      } else if (static_cast<ToAgent>(frame->kind) == ToAgent::kResume) {
        parse_resume_request(frame->content);
      } else if (static_cast<ToAgent>(frame->kind) == ToAgent::kStart) {
        reader.u32();
        get_spec(reader);
      } else if (static_cast<ToAgent>(frame->kind) == ToAgent::kTraceBegin) {
        reader.u32();
        parse_machine_trace(reader.rest());
      } else if (static_cast<ToAgent>(frame->kind) == ToAgent::kTraceSnapshot) {
        reader.u32();
        reader.u32();
        parse_snapshot_order(reader.rest());
      }
    }
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  parse_agent_greeting(bytes);
  read_as_launcher(bytes);
  read_as_agent(bytes);
  return 0;
}
