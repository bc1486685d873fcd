// SPDX-License-Identifier: Apache-2.0
// The processes of a trace. Processes of two machines, of two containers or of two sessions may have equal ids: a
// process is known by the machine, the session and its id.
//
// The tracer of the kernel sees the processes of all sessions of its machine, so its events are those of a process that
// another trace of the machine knows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracing/reader/event.hpp"

namespace tracing {

using ProcessId = std::uint32_t;  // index in ProcessTable::processes()
inline constexpr ProcessId kNoProcess = 0xffffffff;

struct ProcessObject {
  std::optional<std::int64_t> vpid;  // nullopt: all events of a session that were recorded without the context vpid
  std::string name;                  // procname of its main thread, else of the first thread seen; may be empty
  std::string host;                  // the name of its machine; empty when the trace does not tell
  bool named_by_main_thread = false;  // in an event of its own, not of the kernel
};

class ProcessTable {
 public:
  // The process of an event. The events of one reader may come in any order.
  ProcessId of(const Event& event);

  // The process with an id as another process sees it.
  std::optional<ProcessId> beside(ProcessId process, std::int64_t vpid) const;

  const std::vector<ProcessObject>& processes() const { return processes_; }

 private:
  // Process ids are unique within a space: the session of a machine.
  struct Space {
    Recording recording;
    std::uint32_t machine = 0;
  };
  struct Key {
    std::uint32_t place = 0;  // of a space or of a machine
    std::optional<std::int64_t> vpid;
    bool operator==(const Key&) const = default;
  };
  struct HashKey {
    std::size_t operator()(const Key& key) const;
  };

  std::uint32_t space_of(const EventClass& event_class);
  ProcessId find(std::uint32_t space, const std::optional<std::int64_t>& vpid);
  static void learn_name(ProcessObject& process, const Event& event, bool of_kernel);

  std::vector<ProcessObject> processes_;
  std::vector<std::uint32_t> space_of_process_;
  std::vector<Space> spaces_;
  std::uint32_t machines_ = 0;
  std::vector<std::optional<std::uint32_t>> space_of_class_;  // by EventClass::id
  std::unordered_map<Key, ProcessId, HashKey> by_space_;
  std::unordered_map<Key, ProcessId, HashKey> by_machine_;  // the first process with the id on a machine

  std::uint32_t last_space_ = 0;  // consecutive events often come from one process
  std::optional<std::int64_t> last_vpid_;
  ProcessId last_process_ = kNoProcess;
};

}  // namespace tracing
