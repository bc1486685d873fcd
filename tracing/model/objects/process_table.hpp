// SPDX-License-Identifier: Apache-2.0
// The processes of a trace. Processes of two machines, of two containers or of two sessions may have equal ids, and so
// may two processes that ran one after the other: a process is known by the machine, the session, its namespace of
// process ids if that was recorded (context `pid_ns`), its id, and its `rcl_init`. One with another address of the
// context than the last one had, where no process has both, is that of a new process. Its events before are taken for
// the last one's.
//
// Two sessions may record one process. It is known by the boot of its machine, its id, and the address of a context in
// its `rcl_init`, which a new session records again. What a session has recorded of it before that stays a process of
// its own, which is merged into the other one in the results.
//
// The tracer of the kernel sees the processes of all sessions of its machine, so its events are those of a process that
// another trace of the machine knows.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/model/objects/process_doubt.hpp"
#include "tracing/model/objects/repeated_events.hpp"

namespace tracing {

using ProcessId = std::uint32_t;  // index in ProcessTable::processes()
inline constexpr ProcessId kNoProcess = 0xffffffff;

struct ProcessObject {
  std::optional<std::int64_t> vpid;   // nullopt: all events of a session that were recorded without the context vpid
  std::string name;                   // procname of its main thread, else of the first thread seen; may be empty
  std::string host;                   // the name of its machine; empty when the trace does not tell
  bool named_by_main_thread = false;  // in an event of its own, not of the kernel
  // The process that had its id before; kNoProcess if there was none. If both run at the same time, in two containers
  // whose namespaces were not recorded, events of the earlier one are taken for those of the later one.
  ProcessId earlier = kNoProcess;
  ProcessId merged_into = kNoProcess;  // another session had it as this process
};

class ProcessTable {
 public:
  // The process of an event. The events of one reader may come in any order.
  ProcessId of(const Event& event) {
    is_newly_shared_ = false;
    const ProcessId remembered = remembered_of(event);
    return remembered != kNoProcess ? remembered : search(event);
  }
  // The process of an event about which there is nothing else to be found out: is_copy() and is_in_doubt() are false.
  // kNoProcess for any other event.
  ProcessId usual_of(const Event& event) const { return is_plain_ ? remembered_of(event) : kNoProcess; }

  // The process with an id as another process sees it.
  std::optional<ProcessId> beside(ProcessId process, std::int64_t vpid) const;

  // Whether another session has recorded this event, too, and it came before. To be asked once for each event.
  bool is_copy(const Event& event, ProcessId process) {
    if (is_newly_shared_) {
      return true;  // the other session has this rcl_init, too
    }
    return process < is_shared_.size() && is_shared_[process] &&
           copies_.is_copy(event, process, facts_of(*event.event_class).space);
  }

  // Whether the process may be one that another session has recorded, too, and nothing has told yet. The other session
  // has its events, so they are only counted.
  bool is_in_doubt(ProcessId process) const { return !doubts_.empty() && doubts_.contains(process); }

  const std::vector<ProcessObject>& processes() const { return processes_; }
  // The name of the machine of a process. Where machines of one name differ, each has the beginning of its boot's id.
  std::string host_of(ProcessId process) const;

 private:
  // Process ids are unique within a space, which is the session of a machine, and a namespace.
  struct Space {
    Recording recording;
    std::uint32_t machine = 0;
  };
  struct Key {
    std::uint32_t place = 0;  // of a space or of a machine
    std::optional<std::int64_t> vpid;
    std::int64_t pid_ns = 0;  // 0: not recorded
    bool operator==(const Key&) const = default;
  };
  // What all events of a class have in common.
  struct ClassFacts {
    std::uint32_t space = 0;
    std::optional<std::size_t> pid_ns;           // the place of the context
    std::optional<std::size_t> context_address;  // the place of the field, in ros2:rcl_init
    bool of_ros2 = false;
  };
  struct HashKey {
    std::size_t operator()(const Key& key) const;
  };

  const ClassFacts& facts_of(const EventClass& event_class) {
    const bool is_known = event_class.id < facts_.size() && facts_[event_class.id].has_value();
    return is_known ? *facts_[event_class.id] : find_facts(event_class);
  }
  const ClassFacts& find_facts(const EventClass& event_class);
  ProcessId remembered_of(const Event& event) const {
    const std::size_t id = event.event_class->id;
    if (id >= usual_spaces_.size() || !event.vpid) {
      return kNoProcess;
    }
    const Recent& recent = recent_[static_cast<std::uint64_t>(*event.vpid) % recent_.size()];
    return recent.vpid == *event.vpid && recent.space == usual_spaces_[id] ? recent.process : kNoProcess;
  }
  ProcessId search(const Event& event);
  ProcessId find(const Event& event, const ClassFacts& facts);
  std::uint32_t space_of(const Recording& recording);
  ProcessId find(const Key& key);
  ProcessId add(const Key& key, ProcessId earlier);
  // The process of an event while there are doubts: another one where the event ends a doubt.
  ProcessId decide(ProcessId process, const Key& key, const Event& event, const ClassFacts& facts);
  bool concerns_a_doubt(ProcessId process) const;
  void join(ProcessId process, const Key& key, ProcessId with);
  // The process of an rcl_init, which may be a new one.
  ProcessId of_context(ProcessId known, const Key& key, const Event& event, std::uint64_t address);
  // The process of another session with the context, if it is certain that it is the same one.
  ProcessId shared_with(ProcessId known, const Key& key, const Event& event, std::uint64_t address);
  static void learn_name(ProcessObject& process, const Event& event, bool of_kernel);

  std::vector<ProcessObject> processes_;
  std::vector<Key> keys_;  // by process
  std::vector<Space> spaces_;
  std::uint32_t machines_ = 0;
  std::vector<std::optional<ClassFacts>> facts_;  // by EventClass::id
  static constexpr std::uint32_t kUnusual = 0xffffffff;
  // By EventClass::id, as far as they are known: the space, if ClassFacts has nothing else; else kUnusual.
  std::vector<std::uint32_t> usual_spaces_;
  std::unordered_map<ProcessId, std::vector<std::uint64_t>> contexts_;  // their addresses
  std::unordered_map<Key, ProcessId, HashKey> by_space_;
  std::unordered_map<Key, ProcessId, HashKey> by_machine_;  // the first process with the id on a machine

  struct Context {
    std::uint32_t machine = 0;
    std::int64_t vpid = 0;
    std::uint64_t address = 0;
    bool operator<(const Context& other) const {
      return std::tie(machine, vpid, address) < std::tie(other.machine, other.vpid, other.address);
    }
  };
  struct FirstInit {
    ProcessId process = kNoProcess;
    std::optional<std::int64_t> vtid;  // of the event
  };
  std::map<Context, FirstInit> by_context_;
  // By process, which is one of a session that has nothing but its id in common with a process of another one so far.
  std::map<ProcessId, ProcessDoubt> doubts_;
  std::vector<bool> is_shared_;   // by process: several sessions have it; may be shorter
  bool is_newly_shared_ = false;  // by the last event
  bool is_plain_ = true;          // there are neither doubts nor shared processes
  RepeatedEvents copies_;

  // Consecutive events often come from a few processes.
  struct Recent {
    std::int64_t vpid = 0;
    std::uint32_t space = kUnusual;  // nobody is there
    ProcessId process = kNoProcess;
  };
  std::array<Recent, 64> recent_;
};

}  // namespace tracing
