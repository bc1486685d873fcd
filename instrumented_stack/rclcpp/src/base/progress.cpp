// SPDX-License-Identifier: Apache-2.0
#include "base/progress.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace rclcpp::progress {

namespace {

using executor_progress::Page;
using executor_progress::Slot;

// Null without a launcher that watches, and if its memory can't be had: another user's processes may not open it.
Page* map_page() noexcept {
  const char* const place = std::getenv(executor_progress::kVariable);
  if (place == nullptr) {
    return nullptr;
  }
  char* path = nullptr;
  const long offset = std::strtol(place, &path, 10);
  if (offset < 0 || *path != ':') {
    return nullptr;
  }
  const int file = ::open(path + 1, O_RDWR | O_CLOEXEC);
  if (file < 0) {
    return nullptr;
  }
  void* const memory = ::mmap(nullptr, Page::kSize, PROT_READ | PROT_WRITE, MAP_SHARED, file, offset);
  ::close(file);
  return memory == MAP_FAILED ? nullptr : static_cast<Page*>(memory);
}

// Never unmapped: threads of static objects may spin until the process ends.
Page* page() noexcept {
  static Page* const mapped = map_page();
  return mapped;
}

// The slot of a thread; given back when the thread ends.
struct OwnSlot {
  Slot* slot = nullptr;
  bool has_asked = false;  // there may be more threads than slots

  ~OwnSlot() {
    if (slot != nullptr) {
      slot->pid.store(0, std::memory_order_release);
    }
  }

  Slot* get() noexcept {
    if (!has_asked) {
      has_asked = true;
      const auto pid = static_cast<std::uint32_t>(::getpid());
      for (Slot& candidate : page()->slots) {
        std::uint32_t free = 0;
        if (candidate.pid.load(std::memory_order_relaxed) == 0 && candidate.pid.compare_exchange_strong(free, pid)) {
          candidate.tid.store(static_cast<std::uint32_t>(::syscall(SYS_gettid)), std::memory_order_relaxed);
          slot = &candidate;
          break;
        }
      }
    }
    return slot;
  }
};

thread_local OwnSlot own;

}  // namespace

namespace detail {

std::atomic<bool> is_watched = false;

void tell(Doing doing, std::uint64_t time) noexcept {
  if (Slot* const slot = own.get(); slot != nullptr) {
    slot->state.store(executor_progress::pack(doing, time), std::memory_order_relaxed);
    slot->steps.store(slot->steps.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }
}

Doing told() noexcept {
  const Slot* const slot = own.get();
  return slot == nullptr ? Doing::kNothing : executor_progress::doing_of(slot->state.load(std::memory_order_relaxed));
}

}  // namespace detail

void join() noexcept {
  if (Page* const shared = page(); shared != nullptr) {
    shared->joined.store(1, std::memory_order_relaxed);
    detail::is_watched.store(true, std::memory_order_relaxed);
  }
}

}  // namespace rclcpp::progress
