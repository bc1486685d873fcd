// SPDX-License-Identifier: Apache-2.0
#include "tracing/objects/process_table.hpp"

#include <algorithm>

namespace tracing {

std::size_t ProcessTable::HashKey::operator()(const Key& key) const {
  const auto vpid = static_cast<std::uint64_t>(key.vpid.value_or(-1));
  const std::uint64_t mixed = (vpid ^ (static_cast<std::uint64_t>(key.place) << 40)) * 0x9e3779b97f4a7c15;
  return mixed ^ (mixed >> 32);
}

std::uint32_t ProcessTable::space_of(const EventClass& event_class) {
  if (event_class.id >= space_of_class_.size()) space_of_class_.resize(event_class.id + 1);
  std::optional<std::uint32_t>& known = space_of_class_[event_class.id];
  if (known) return *known;
  static const Recording kUnknown;
  const Recording& recording = event_class.recording == nullptr ? kUnknown : *event_class.recording;
  const auto same =
      std::find_if(spaces_.begin(), spaces_.end(), [&](const Space& space) { return space.recording == recording; });
  if (same != spaces_.end()) {
    known = static_cast<std::uint32_t>(same - spaces_.begin());
    return *known;
  }
  const auto machine = std::find_if(spaces_.begin(), spaces_.end(), [&](const Space& space) {
    return space.recording.host == recording.host && space.recording.machine == recording.machine;
  });
  known = static_cast<std::uint32_t>(spaces_.size());
  spaces_.push_back({recording, machine == spaces_.end() ? machines_++ : machine->machine});
  return *known;
}

ProcessId ProcessTable::find(std::uint32_t space, const std::optional<std::int64_t>& vpid) {
  const auto [found, is_new] = by_space_.try_emplace({space, vpid}, kNoProcess);
  if (!is_new) return found->second;
  const Recording& recording = spaces_[space].recording;
  const auto [on_machine, first] = by_machine_.try_emplace({spaces_[space].machine, vpid}, kNoProcess);
  if (!first && vpid) {
    // Only the kernel's events belong to a process of another session. They may have come first.
    const bool by_kernel_so_far = spaces_[space_of_process_[on_machine->second]].recording.of_kernel;
    if (recording.of_kernel || by_kernel_so_far) {
      found->second = on_machine->second;
      if (by_kernel_so_far) space_of_process_[found->second] = space;
      return found->second;
    }
  }
  found->second = static_cast<ProcessId>(processes_.size());
  if (first) on_machine->second = found->second;
  processes_.push_back({vpid, "", recording.host, false});
  space_of_process_.push_back(space);
  return found->second;
}

// procname is the name of the thread: only the main thread has the name of the process. The kernel's events begin
// before the process executes its program, when it still has the name of the process that started it. So the last name
// counts there, until an event of the program itself tells its name.
void ProcessTable::learn_name(ProcessObject& process, const Event& event, bool of_kernel) {
  if (!event.vpid || process.named_by_main_thread || !event.procname) return;
  const bool is_main_thread = event.vtid == event.vpid;
  process.named_by_main_thread = is_main_thread && !of_kernel;
  if ((is_main_thread || process.name.empty()) && process.name != *event.procname) process.name = *event.procname;
}

ProcessId ProcessTable::of(const Event& event) {
  const std::uint32_t space = space_of(*event.event_class);
  if (last_process_ == kNoProcess || last_space_ != space || last_vpid_ != event.vpid) {
    last_process_ = find(space, event.vpid);
    last_space_ = space;
    last_vpid_ = event.vpid;
  }
  learn_name(processes_[last_process_], event, spaces_[space].recording.of_kernel);
  return last_process_;
}

std::optional<ProcessId> ProcessTable::beside(ProcessId process, std::int64_t vpid) const {
  const auto found = by_space_.find({space_of_process_[process], vpid});
  return found == by_space_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace tracing
