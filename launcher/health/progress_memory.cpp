// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/progress_memory.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <system_error>

namespace launch {
namespace {

using executor_progress::Page;
using executor_progress::Slot;

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::system_category(), what);
}

}  // namespace

ProgressMemory::~ProgressMemory() {
  for (Page* const page : pages_) {
    ::munmap(page, Page::kSize);
  }
}

ProgressMemory::Place ProgressMemory::add() {
  if (!file_) {
    file_.reset(::memfd_create("executor_progress", MFD_CLOEXEC));
    if (!file_) {
      fail("memory for the progress of executors");
    }
  }
  const auto offset = static_cast<off_t>(pages_.size() * Page::kSize);
  if (::ftruncate(file_.get(), offset + static_cast<off_t>(Page::kSize)) != 0) {
    fail("memory for the progress of executors");
  }
  void* const memory = ::mmap(nullptr, Page::kSize, PROT_READ | PROT_WRITE, MAP_SHARED, file_.get(), offset);
  if (memory == MAP_FAILED) {
    fail("memory for the progress of executors");
  }
  pages_.push_back(static_cast<Page*>(memory));
  return {pages_.back(), fmt::format("{}:/proc/{}/fd/{}", offset, ::getpid(), file_.get())};
}

void clear(Page& page) {
  page.joined.store(0, std::memory_order_relaxed);
  for (Slot& slot : page.slots) {
    slot.pid.store(0, std::memory_order_relaxed);
    slot.state.store(0, std::memory_order_relaxed);
    slot.steps.store(0, std::memory_order_relaxed);
  }
}

}  // namespace launch
