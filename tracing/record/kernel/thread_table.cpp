// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/thread_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tracing/record/kernel/ring_page.hpp"

namespace tracing::kernel {
namespace {

constexpr std::uint64_t kCloneThread = 0x10000;  // CLONE_THREAD: of the same process

std::string text(std::span<const std::uint8_t> bytes, std::size_t offset, std::size_t size) {
  if (offset + size > bytes.size()) {
    return {};
  }
  const char* const begin = reinterpret_cast<const char*>(bytes.data()) + offset;
  return std::string(begin, strnlen(begin, size));
}

Thread from_proc(std::int32_t thread) {
  Thread found{.process = thread, .name = {}};
  std::getline(std::ifstream(fmt::format("/proc/{}/comm", thread)), found.name);
  std::ifstream status(fmt::format("/proc/{}/status", thread));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("Tgid:")) {
      found.process = std::atoi(line.c_str() + 5);
    }
  }
  return found;
}

}  // namespace

ThreadTable::Place ThreadTable::place_of(const EventFormat& format, const std::string& field) {
  const auto found = std::find_if(format.fields.begin(), format.fields.end(),
                                  [&](const EventField& candidate) { return candidate.name == field; });
  if (found == format.fields.end()) {
    throw std::runtime_error(fmt::format("the kernel's event {} has no field {}", format.name, field));
  }
  return {.offset = found->offset, .size = found->size};
}

ThreadTable::ThreadTable(const EventFormat& newtask, const EventFormat& rename)
    : newtask_(newtask.id),
      rename_(rename.id),
      new_thread_(place_of(newtask, "pid")),
      new_name_(place_of(newtask, "comm")),
      clone_flags_(place_of(newtask, "clone_flags")),
      renamed_thread_(place_of(rename, "pid")),
      old_name_(place_of(rename, "oldcomm")),
      renamed_name_(place_of(rename, "newcomm")) {}

void ThreadTable::learn(std::uint64_t time, std::span<const std::uint8_t> record) {
  const auto id = load<std::uint16_t>(record, 0);
  if (id == newtask_) {
    const auto thread = load<std::int32_t>(record, new_thread_.offset);
    const bool same_process = (load<std::uint64_t>(record, clone_flags_.offset) & kCloneThread) != 0;
    const std::int32_t process = same_process ? find(load<std::int32_t>(record, kPidOffset), time).process : thread;
    threads_[thread][time] = {.process = process, .name = text(record, new_name_.offset, new_name_.size)};
  } else if (id == rename_) {
    const auto thread = load<std::int32_t>(record, renamed_thread_.offset);
    std::map<std::uint64_t, Thread>& history = threads_[thread];
    if (history.empty()) {
      // /proc knows the new name already.
      history[0] = {.process = from_proc(thread).process, .name = text(record, old_name_.offset, old_name_.size)};
    }
    const std::int32_t process = at(thread, time).process;
    history[time] = {.process = process, .name = text(record, renamed_name_.offset, renamed_name_.size)};
  }
}

Thread ThreadTable::at(std::int32_t thread, std::uint64_t time) const {
  const std::map<std::uint64_t, Thread>& history = threads_.at(thread);
  const auto later = history.upper_bound(time);
  return later == history.begin() ? later->second : std::prev(later)->second;
}

Thread ThreadTable::find(std::int32_t thread, std::uint64_t time) {
  std::map<std::uint64_t, Thread>& history = threads_[thread];
  if (history.empty()) {
    history[0] = from_proc(thread);
  }
  return at(thread, time);
}

void ThreadTable::forget_the_past() {
  for (auto& [thread, history] : threads_) {
    if (history.size() > 1) {
      history.erase(history.begin(), std::prev(history.end()));
    }
  }
}

}  // namespace tracing::kernel
