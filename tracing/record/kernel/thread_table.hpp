// SPDX-License-Identifier: Apache-2.0
// The process and the name of a thread at the time of an event: the kernel's records hold only the thread.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tracing/record/kernel/event_format.hpp"

namespace tracing::kernel {

struct Thread {
  std::int32_t process = 0;
  std::string name;  // at most 15 characters
};

// Learns from the kernel's events of new and renamed threads. Threads that existed before are read from /proc when they
// are first asked for; a thread that has gone by then has no name.
class ThreadTable {
 public:
  // task_newtask and task_rename, as tracefs describes them.
  ThreadTable(const EventFormat& newtask, const EventFormat& rename);

  // Records of other events are skipped. Call this for all records before find() is asked about any of them: what a
  // processor records about a thread is in another buffer than the thread's own events.
  void learn(std::uint64_t time, std::span<const std::uint8_t> record);
  Thread find(std::int32_t thread, std::uint64_t time);
  // Promises that all records from now on are later than those before.
  void forget_the_past();

 private:
  struct Place {
    std::uint32_t offset = 0;
    std::uint32_t size = 0;
  };
  static Place place_of(const EventFormat& format, const std::string& field);
  Thread at(std::int32_t thread, std::uint64_t time) const;

  std::uint16_t newtask_;
  std::uint16_t rename_;
  Place new_thread_;
  Place new_name_;
  Place clone_flags_;
  Place renamed_thread_;
  Place old_name_;
  Place renamed_name_;
  std::map<std::int32_t, std::map<std::uint64_t, Thread>> threads_;  // the state of each thread from a time on
};

}  // namespace tracing::kernel
