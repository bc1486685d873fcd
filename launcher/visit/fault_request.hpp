// SPDX-License-Identifier: Apache-2.0
// A fault that a test asks for: what is done to a process or to messages, and when. Its random parts are drawn already.
#pragma once

#include <signal.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/dependency.hpp"

namespace launch {

struct KillFault {
  int signal = SIGKILL;
};
// The process stands still.
struct StopFault {};
// The process runs for this part of the time only.
struct SlowFault {
  unsigned percent = 50;
};
struct LimitFault {
  std::optional<std::uint64_t> memory;  // bytes of address space
  std::optional<std::uint64_t> files;   // open descriptors
};

// Messages of a topic or a service are lost, come twice, with other bytes, or late.
struct MessageFault {
  enum class Kind { kDrop, kDuplicate, kCorrupt, kDelay };
  enum class Side { kPublish, kTake, kRequest, kResponse };
  Kind kind = Kind::kDrop;
  Side side = Side::kPublish;              // requests and responses suffer at the service
  std::string topic;                       // or the service; fully qualified
  std::string node;                        // fully qualified; empty: any
  std::uint64_t first = 1;                 // the number of the first message, from 1
  std::uint64_t every = 1;                 // then each message of so many
  std::optional<std::uint64_t> count = 1;  // nullopt: no end
  Duration by{0};                          // of a delay
  std::uint64_t seed = 0;                  // of the bytes that are changed
};

// Packets between two groups of processes are lost or late, in both directions.
struct NetworkFault {
  enum class Kind { kPartition, kLose, kDelay };
  struct Member {
    std::string name;  // of a process (process_table.hpp)
    SourceRange where;
  };
  Kind kind = Kind::kPartition;
  std::vector<Member> group;  // one at least
  std::vector<Member> from;   // empty: all others
  double share = 1;           // that is lost
  Duration by{0};             // of a delay
  std::uint64_t seed = 0;     // of what is lost
};

// The simulated time of a <clock> stands still, runs at another rate, or jumps.
struct ClockFault {
  enum class Kind { kStop, kSkew, kJump };
  Kind kind = Kind::kStop;
  double rate = 1;  // of kSkew: so many times its rate
  double by = 0;    // of kJump: seconds
};

// Whether the process is that of a <clock>, which publishes simulated time and obeys lines of its standard input:
// `stop` and `go`, `scale FACTOR` of its rate, `jump SECONDS`.
inline bool is_clock(const ProcessSpec& spec) {
  return spec.argv.size() > 1 && spec.argv[0].ends_with("/launch-ros-command") && spec.argv[1] == "clock";
}

// The disk of a directory is full.
struct DiskFault {
  std::string directory;   // absolute; empty: that of the logs
  std::uint64_t free = 0;  // bytes for which there is room nevertheless
  SourceRange where;
};

struct FaultRequest {
  std::size_t number = 0;  // among the faults of its test, from 1
  std::string process;     // one of its names (process_table.hpp); every process of that name is meant
  std::variant<KillFault, StopFault, SlowFault, LimitFault, MessageFault, NetworkFault, ClockFault, DiskFault> what;
  Duration at{0};                 // from the begin of the test, or from when all dependencies hold
  std::optional<Duration> lasts;  // nullopt: as long as the process; of a MessageFault: until its count is reached
  std::vector<Dependency> dependencies;  // their number of a process means nothing
  std::string left_out;                  // why it is not applied in this run; empty: it is
  bool is_random = false;                // it has something that is drawn
  std::string identity;                  // as FaultDraw takes it
  SourceRange where;
  SourceRange process_where;
};

// "message on '/scan'", "requests of '/add'".
std::string describe_messages(const MessageFault& fault, bool several);

// "kill of 'worker'", "kill of 'worker' by SIGTERM", "stop of 'worker' for 2 s", "slow of 'worker' to 25% for 1 s",
// "limit of 'worker' to 20 files", "drop of messages 3 to 5 on '/scan'", "partition of
// 'camera' from the others for 2 s", "full disk at '/data' for 1 s".
std::string describe(const FaultRequest& fault);

}  // namespace launch
