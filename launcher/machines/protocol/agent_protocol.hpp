// SPDX-License-Identifier: Apache-2.0
// What a launcher and its agent on another machine say to each other, through the standard input and output of the
// command that connects them (docs/machines.md describes it for others).
//
// The agent begins with a line of text, so that whatever a login prints before can be passed over:
//
//   launch-agent 2 1.0.0         the version of this protocol, and that of launch there
//
// Behind it stand frames, both ways: a byte for the kind, four for the length, the highest first, and the content.
// The number of a run is chosen by the launcher, a new one for each start of a process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/machines/protocol/wire.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

inline constexpr std::string_view kAgentGreeting = "launch-agent ";
inline constexpr int kAgentProtocol = 2;

// To the agent.
enum class ToAgent : std::uint8_t {
  kSetup = 1,    // first and once: AgentSetup
  kStart = 2,    // u32 run, the spec (spec_wire.hpp): start it
  kSignal = 3,   // u32 run, i32 signal: for its group
  kCredit = 4,   // u32 run, u8 stream, u32 bytes: so many more may be sent
  kRelease = 5,  // u32 run: it is reaped, and what it has left in its group is no longer of interest
  kGroups = 6,   // a list of u32 runs that have exited: do their groups still live?
  kAsk = 7,      // u32 question, u8 what, texts
  kPing = 8,     // u64: anything
  kSuspend = 9,  // flag: the launcher is stopped from now on, and says nothing; or it goes on
  kEnd = 10,     // nothing follows: end what is left
  // The number of a trace is chosen by the launcher, each greater than the one before.
  kTraceBegin = 11,  // u32 trace, MachineTrace (launcher/traced/machine_trace.hpp): record the machine
  kTraceEnd = 12,    // u32 trace, flag whether no process was to be recorded: end it
  kTraceHurry = 13,  // u32 trace: end it with the data that is there
  kTraceFetch = 14,  // u32 trace, u32 bytes: of its files so many more may be sent
  kTraceLeave = 15,  // u32 trace, flag: nothing more is wanted of it; remove its files there, or leave them
  // A snapshot has a number as a trace has, and is fetched and left as one that has ended.
  kTraceSnapshot = 16,  // u32 trace, u32 number of the snapshot, SnapshotOrder (machine_trace.hpp): take one
  // About a connection that is kept (kept_frames.hpp).
  kResume = 32,      // in place of kSetup: text id and text key of AgentSetup, u64 as in kAcknowledge
  kAcknowledge = 33  // u64: so many numbered frames of the agent have come
};

// From the agent.
enum class FromAgent : std::uint8_t {
  kHello = 1,        // after kSetup: AgentHello
  kStarted = 2,      // u32 run, i32 pid
  kFailed = 3,       // u32 run, i32 errno, text: it could not be started
  kOutput = 4,       // u32 run, u8 stream, bytes
  kClosed = 5,       // u32 run, u8 stream: nothing more comes
  kExited = 6,       // u32 run, AgentExit
  kGroups = 7,       // a list of u32 run and flag
  kAnswer = 8,       // u32 question, flag whether it went well, text: the answer, or what is wrong
  kPong = 9,         // u64: as in the ping; i64: nanoseconds since the epoch; i64: those of the monotonic clock
  kRefused = 10,     // text: why the agent can't do its work; the connection ends
  kTraceTold = 11,   // u32 trace, text: a warning of it
  kTraceBegun = 12,  // u32 trace, flag whether it went well, text: what is wrong, text: what helps, text: the directory
  // Of a trace, or of a snapshot that is taken.
  kTraceEnded = 13,   // u32 trace, flag whether it went well, texts as before; no directory: nothing is written
  kTraceFile = 14,    // u32 trace, text: a path below the directory, u64: its bytes, which follow
  kTraceBytes = 15,   // u32 trace, bytes of the file
  kTraceSum = 16,     // u32 trace, u64: sum_of() all bytes of the file, which ends here
  kTraceAll = 17,     // u32 trace, u32: how many files, u64: how many bytes it were
  kTraceFailed = 18,  // u32 trace, text: its files can't be sent
  // A reason for a snapshot.
  kTraceWish = 19,  // u32 trace, flag whether a process has ended, text: its label, or what has happened, i32 exit code
  // About a connection that is kept.
  kResumed = 32,      // u64 as in kAcknowledge, a list of u32 run and u64 lines of it that were dropped meanwhile
  kAcknowledge = 33,  // u64: so many numbered frames of the launcher have come
  kGone = 34          // text: the agent that is to be resumed is not there
};

// The longest content of a frame. Specs with parameters and the list of packages are the long ones.
inline constexpr std::size_t kLongestFrame = std::size_t{8} * 1024 * 1024;

// So many bytes of a stream may be on their way before the launcher has passed on the first of them.
inline constexpr std::uint32_t kStreamWindow = 256 * 1024;

// Of the files of a trace so many bytes may be on their way.
inline constexpr std::uint32_t kTraceWindow = 1024 * 1024;
inline constexpr std::size_t kTracePiece = 64UL * 1024;  // bytes of a file in one message, at most

// The sum of the bytes of a file (FNV-1a): it tells a transfer that went wrong, and no attack.
inline constexpr std::uint64_t kSumOfNothing = 0xcbf29ce484222325;
inline std::uint64_t sum_of(std::string_view bytes, std::uint64_t sum = kSumOfNothing) {
  for (const char byte : bytes) {
    sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  }
  return sum;
}

// Digits of the id and of the key of a connection that is kept, at most.
inline constexpr std::size_t kLongestAgentId = 64;

// What can be asked about files and programs there.
enum class AgentQuestion : std::uint8_t {
  kFileContent = 1,  // path: its text
  kAreFiles = 2,     // paths: a "1" or "0" for each
  kFindProgram = 3,  // name, value of PATH: its path, or nothing
  kPackage = 4,      // name, value of AMENT_PREFIX_PATH: "PREFIX", or nothing
  kProgram = 5,      // path: "1" if it is a program
  kRun = 6           // a command: flag whether standard error is captured, path, words, variables of its environment
};

struct AgentSetup {
  std::string setup;                       // the file that is sourced before anything else; empty: none
  std::uint32_t silence_milliseconds = 0;  // a launcher that has said nothing for so long has gone
  std::string name;                        // of the machine, for messages of the guardian
  // After the loss of the connection the agent waits for so long before it ends what runs.
  std::uint32_t wait_milliseconds = 0;
  // With them a launcher can come back meanwhile (kResume): the name of a socket, and what nobody else knows. Empty:
  // it can't. Both are hexadecimal.
  std::string id;
  std::string key;
};

// What a launcher says in place of it when it comes back.
struct ResumeRequest {
  std::string id;
  std::string key;
  std::uint64_t received = 0;  // numbered frames of the agent
};

// A package there, with its programs.
struct AgentPackage {
  std::string name;
  std::string prefix;
  std::vector<std::string> programs;
};

// What the agent tells of its machine.
struct AgentHello {
  std::string host;
  std::string architecture;
  std::string directory;  // in which it has been started
  Environment::Variables environment;
  std::vector<AgentPackage> packages;  // those of AMENT_PREFIX_PATH of this environment, and of the install prefix
  std::string own_prefix;
};

struct Frame {
  std::uint8_t kind = 0;
  std::string content;
};

// "launch-agent 1 1.0.0", with the end of the line.
std::string agent_greeting(std::string_view launch_version);
struct AgentVersion {
  int protocol = 0;
  std::string launch_version;
};
// Nothing for another line. The line has no end, but may have a carriage return.
std::optional<AgentVersion> parse_agent_greeting(std::string_view line);

// Throws WireError if the content is longer than kLongestFrame.
std::string encode_frame(std::uint8_t kind, std::string_view content);
inline std::string encode(ToAgent kind, const WireWriter& content = {}) {
  return encode_frame(static_cast<std::uint8_t>(kind), content.bytes());
}
inline std::string encode(FromAgent kind, const WireWriter& content = {}) {
  return encode_frame(static_cast<std::uint8_t>(kind), content.bytes());
}

// Takes bytes as they come, and gives the frames in them.
class Frames {
 public:
  void add(std::string_view bytes) { buffer_ += bytes; }
  // Nothing until a frame is complete. Throws WireError for one that is too long: what comes is no frame.
  std::optional<Frame> take();
  std::size_t held() const { return buffer_.size() - begin_; }

 private:
  std::string buffer_;
  std::size_t begin_ = 0;  // of what has not been taken
};

std::string to_wire(const AgentSetup& setup);
AgentSetup parse_agent_setup(std::string_view bytes);
std::string to_wire(const ResumeRequest& request);
ResumeRequest parse_resume_request(std::string_view bytes);
std::string to_wire(const AgentHello& hello);
AgentHello parse_agent_hello(std::string_view bytes);

void put(WireWriter& writer, const ProcessExit& exit);
ProcessExit get_exit(WireReader& reader);

}  // namespace launch
