// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/process_table.hpp"

#include <algorithm>
#include <iterator>

namespace tracing {
namespace {

constexpr std::string_view kContextInit = "ros2:rcl_init";
constexpr std::int64_t kFirstPidNamespace = 0xEFFFFFFC;  // PROC_PID_INIT_INO of the kernel

// An operating system gives the number of a process that has ended to another one, and only the addresses of rcl
// contexts tell the two apart.
//
// Whether no process has objects at both addresses. Each process has its heap at a place chosen at random (ASLR), where
// its contexts are close together. Two heaps of different processes are terabytes apart, in the same region of the
// address space: that of the program (0x55…) or that of mapped memory (0x7f…). A process may have objects in both
// regions, so two addresses in different regions tell nothing.
constexpr bool are_of_two_processes(std::uint64_t a, std::uint64_t b) {
  constexpr int kRegion = 44;                                     // bits
  constexpr std::uint64_t kLargestHeap = std::uint64_t{1} << 34;  // 16 GiB
  return a >> kRegion == b >> kRegion && (a > b ? a - b : b - a) > kLargestHeap;
}

}  // namespace

std::size_t ProcessTable::HashKey::operator()(const Key& key) const {
  const auto vpid = static_cast<std::uint64_t>(key.vpid.value_or(-1));
  const auto place = static_cast<std::uint64_t>(key.place) << 40 ^ static_cast<std::uint64_t>(key.pid_ns) << 20;
  const std::uint64_t mixed = (vpid ^ place) * 0x9e3779b97f4a7c15;
  return mixed ^ (mixed >> 32);
}

std::uint32_t ProcessTable::space_of(const Recording& recording) {
  const auto same =
      std::find_if(spaces_.begin(), spaces_.end(), [&](const Space& space) { return space.recording == recording; });
  if (same != spaces_.end()) {
    return static_cast<std::uint32_t>(same - spaces_.begin());
  }
  const auto machine = std::find_if(spaces_.begin(), spaces_.end(), [&](const Space& space) {
    return space.recording.host == recording.host && space.recording.machine == recording.machine;
  });
  spaces_.push_back({recording, machine == spaces_.end() ? machines_++ : machine->machine});
  return static_cast<std::uint32_t>(spaces_.size() - 1);
}

const ProcessTable::ClassFacts& ProcessTable::find_facts(const EventClass& event_class) {
  if (event_class.id >= facts_.size()) {
    facts_.resize(event_class.id + 1);
  }
  static const Recording kUnknown;
  ClassFacts facts{
      .space = space_of(event_class.recording == nullptr ? kUnknown : *event_class.recording),
      .pid_ns = event_class.index_of_context("pid_ns"),
      .context_address = event_class.name == kContextInit ? event_class.index_of("context_handle") : std::nullopt,
      .of_ros2 = event_class.name.starts_with("ros2:")};
  if (!facts.pid_ns && !facts.context_address) {
    usual_spaces_.resize(std::max(usual_spaces_.size(), event_class.id + 1), kUnusual);
    usual_spaces_[event_class.id] = facts.space;
  }
  return facts_[event_class.id].emplace(facts);
}

ProcessId ProcessTable::add(const Key& key, ProcessId earlier) {
  processes_.push_back({.vpid = key.vpid, .name = "", .host = spaces_[key.place].recording.host, .earlier = earlier});
  keys_.push_back(key);
  return static_cast<ProcessId>(processes_.size() - 1);
}

ProcessId ProcessTable::find(const Key& key) {
  const auto [found, is_new] = by_space_.try_emplace(key, kNoProcess);
  if (!is_new) {
    return found->second;
  }
  const Space& space = spaces_[key.place];
  // The kernel's numbers are those of the first namespace, where it tells none.
  const std::int64_t pid_ns = key.pid_ns == kFirstPidNamespace ? 0 : key.pid_ns;
  const auto [on_machine, first] = by_machine_.try_emplace({space.machine, key.vpid, pid_ns}, kNoProcess);
  if (!first && key.vpid) {
    // Only the kernel's events belong to a process of another session. They may have come first.
    const bool by_kernel_so_far = spaces_[keys_[on_machine->second].place].recording.of_kernel;
    if (space.recording.of_kernel || by_kernel_so_far) {
      found->second = on_machine->second;
      if (by_kernel_so_far) {
        keys_[found->second] = key;
      }
      return found->second;
    }
  }
  found->second = add(key, kNoProcess);
  if (first) {
    on_machine->second = found->second;
  }
  return found->second;
}

ProcessId ProcessTable::shared_with(ProcessId known, const Key& key, const Event& event, std::uint64_t address) {
  const Space& space = spaces_[key.place];
  if (space.recording.machine.empty() || space.recording.of_kernel) {
    return kNoProcess;  // equal addresses of two machines mean nothing
  }
  const auto [found, is_new] =
      by_context_.try_emplace({space.machine, *key.vpid, address}, FirstInit{kNoProcess, event.vtid});
  const ProcessId shared = found->second.process;
  if (is_new || shared == kNoProcess || shared == known || keys_[shared].place == key.place) {
    return kNoProcess;
  }
  is_shared_.resize(std::max<std::size_t>(is_shared_.size(), shared + 1));
  is_shared_[shared] = true;
  // A thread of the tracer tells a session that begins late what there is.
  is_newly_shared_ = found->second.vtid == event.vtid;
  by_space_[key] = shared;
  if (contexts_[known].empty() && keys_[known] == key) {
    processes_[known].merged_into = shared;
  }
  return shared;
}

std::string ProcessTable::host_of(ProcessId process) const {
  const Recording& own = spaces_[keys_[process].place].recording;
  const bool has_namesake = std::any_of(spaces_.begin(), spaces_.end(), [&own](const Space& space) {
    return space.recording.host == own.host && !space.recording.machine.empty() &&
           space.recording.machine != own.machine;
  });
  constexpr std::size_t kShown = 8;
  return has_namesake && !own.machine.empty() ? own.host + " (boot " + own.machine.substr(0, kShown) + ")" : own.host;
}

ProcessId ProcessTable::of_context(ProcessId known, const Key& key, const Event& event, std::uint64_t address) {
  if (const ProcessId shared = shared_with(known, key, event, address); shared != kNoProcess) {
    return shared;
  }
  const std::vector<std::uint64_t>& contexts = contexts_[known];
  const auto is_apart = [address](std::uint64_t other) { return are_of_two_processes(address, other); };
  // A state dump repeats it, also if another process has the id meanwhile.
  bool is_same = false;
  for (ProcessId one = known; one != kNoProcess && !is_same; one = processes_[one].earlier) {
    const std::vector<std::uint64_t>& seen = contexts_[one];
    is_same = std::find(seen.begin(), seen.end(), address) != seen.end();
  }
  const bool is_other_program = event.vtid == event.vpid && event.procname && processes_[known].named_by_main_thread &&
                                processes_[known].name != *event.procname;
  const bool is_new =
      !contexts.empty() && !is_same && (is_other_program || std::any_of(contexts.begin(), contexts.end(), is_apart));
  ProcessId process = known;
  if (is_new) {
    process = add(key, known);
    by_space_[key] = process;
    for (auto& [other, of_kernel] : by_space_) {
      if (of_kernel == known && spaces_[other.place].recording.of_kernel) {
        of_kernel = process;
      }
    }
    for (auto& [other, on_machine] : by_machine_) {
      if (on_machine == known) {
        on_machine = process;
      }
    }
  }
  if (!is_same) {
    contexts_[process].push_back(address);
    if (const auto found = by_context_.find({spaces_[key.place].machine, *key.vpid, address});
        found != by_context_.end() && found->second.process == kNoProcess) {
      found->second.process = process;
    }
  }
  return process;
}

// procname is the name of the thread: only the main thread has the name of the process. The kernel's events begin
// before the process executes its program, when it still has the name of the process that started it. So the last name
// counts there, until an event of the program itself tells its name.
void ProcessTable::learn_name(ProcessObject& process, const Event& event, bool of_kernel) {
  if (!event.vpid || process.named_by_main_thread || !event.procname) {
    return;
  }
  const bool is_main_thread = event.vtid == event.vpid;
  process.named_by_main_thread = is_main_thread && !of_kernel;
  if ((is_main_thread || process.name.empty()) && process.name != *event.procname) {
    process.name = *event.procname;
  }
}

ProcessId ProcessTable::search(const Event& event) {
  const ClassFacts& facts = facts_of(*event.event_class);
  const ProcessId process = find(event, facts);
  is_plain_ = is_shared_.empty() && doubts_.empty();
  const bool is_usual = !facts.pid_ns && !facts.context_address && event.vpid;
  // There is nothing more to learn of it.
  if (is_usual && processes_[process].named_by_main_thread && !concerns_a_doubt(process)) {
    recent_[static_cast<std::uint64_t>(*event.vpid) % recent_.size()] = {*event.vpid, facts.space, process};
  }
  return process;
}

ProcessId ProcessTable::find(const Event& event, const ClassFacts& facts) {
  Key key{.place = facts.space, .vpid = event.vpid};
  if (facts.pid_ns) {
    key.pid_ns = event.context(*facts.pid_ns).integer().value_or(0);
  }
  const std::size_t known = processes_.size();
  ProcessId process = find(key);
  if (facts.of_ros2 && process == known && event.vpid) {
    const Space& space = spaces_[facts.space];
    const std::int64_t pid_ns = key.pid_ns == kFirstPidNamespace ? 0 : key.pid_ns;
    const auto other = by_machine_.find({space.machine, key.vpid, pid_ns});
    if (!space.recording.machine.empty() && other != by_machine_.end() && other->second != process) {
      doubts_.try_emplace(process, other->second);
      recent_ = {};  // the events of the other session are wanted, too
    }
  }
  if (facts.context_address && event.vpid) {
    const std::optional<std::uint64_t> address = event.field(*facts.context_address).unsigned_integer();
    if (address) {
      process = of_context(process, key, event, *address);
      recent_ = {};  // other events may belong to another process from now on
    }
  }
  if (!doubts_.empty()) {
    process = decide(process, key, event, facts);
  }
  learn_name(processes_[process], event, spaces_[facts.space].recording.of_kernel);
  return process;
}

ProcessId ProcessTable::decide(ProcessId process, const Key& key, const Event& event, const ClassFacts& facts) {
  if (const auto own = doubts_.find(process); own != doubts_.end()) {
    const ProcessId other = own->second.other();
    const bool is_told = facts.context_address.has_value();  // by the address of its context: they are two
    if (!is_told && own->second.is_copy(event, process)) {
      doubts_.erase(own);
      join(process, key, other);
      is_newly_shared_ = true;
      return other;
    }
    if (is_told || own->second.is_given_up()) {
      doubts_.erase(own);
    }
    return process;
  }
  for (auto doubt = doubts_.begin(); doubt != doubts_.end();) {
    const ProcessId own = doubt->first;
    if (processes_[own].merged_into != kNoProcess) {
      doubt = doubts_.erase(doubt);  // its rcl_init has told
      continue;
    }
    if (doubt->second.other() == process && doubt->second.is_copy(event, process)) {
      const Key own_key = keys_[own];
      doubt = doubts_.erase(doubt);
      join(own, own_key, process);
      continue;
    }
    doubt = doubt->second.is_given_up() ? doubts_.erase(doubt) : std::next(doubt);
  }
  return process;
}

bool ProcessTable::concerns_a_doubt(ProcessId process) const {
  return std::any_of(doubts_.begin(), doubts_.end(), [process](const auto& doubt) {
    return doubt.first == process || doubt.second.other() == process;
  });
}

void ProcessTable::join(ProcessId process, const Key& key, ProcessId with) {
  is_shared_.resize(std::max<std::size_t>(is_shared_.size(), with + 1));
  is_shared_[with] = true;
  by_space_[key] = with;
  processes_[process].merged_into = with;
  recent_ = {};
}

std::optional<ProcessId> ProcessTable::beside(ProcessId process, std::int64_t vpid) const {
  Key key = keys_[process];
  key.vpid = vpid;
  const auto found = by_space_.find(key);
  return found == by_space_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace tracing
