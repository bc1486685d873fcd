// SPDX-License-Identifier: Apache-2.0
#include "allocation_count.hpp"

#include <dlfcn.h>
#include <execinfo.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string_view>

namespace test_support {
namespace {

// Return addresses, the innermost first.
struct CallStack {
  std::array<void*, 12> frames;
  int depth;
};

constexpr std::size_t kMaxCalls = 4096;
std::array<CallStack, kMaxCalls> calls;
std::size_t call_count = 0;
thread_local bool counting = false;

[[maybe_unused]] void note_allocation() {
  if (!counting) {
    return;
  }
  counting = false;  // backtrace() may allocate
  if (call_count < kMaxCalls) {
    CallStack& call = calls[call_count++];
    call.depth = backtrace(call.frames.data(), static_cast<int>(call.frames.size()));
  }
  counting = true;
}

enum class Layer { kStack, kFastDds, kRuntime };

Layer layer_of(std::string_view object) {
  const std::string_view name = object.substr(object.rfind('/') + 1);
  if (name.starts_with("libfastrtps") || name.starts_with("libfastdds") || name.starts_with("libfastcdr")) {
    return Layer::kFastDds;
  }
  if (name.starts_with("libc.") || name.starts_with("libstdc++") || name.starts_with("libm.")) {
    return Layer::kRuntime;
  }
  return Layer::kStack;
}

std::string describe(const Dl_info& info, const void* address) {
  if (info.dli_sname != nullptr) {
    return info.dli_sname;
  }
  std::array<char, 512> text;
  std::snprintf(text.data(), text.size(), "%s+%#zx", info.dli_fname,
                static_cast<std::size_t>(static_cast<const char*>(address) - static_cast<const char*>(info.dli_fbase)));
  return text.data();
}

}  // namespace

AllocationCount::AllocationCount() {
  // The first call loads a library.
  std::array<void*, 1> frame;
  (void)backtrace(frame.data(), 1);
  call_count = 0;
  counting = true;
}

AllocationCount::~AllocationCount() {
  counting = false;
}

Allocations AllocationCount::finish() {
  counting = false;
  if (call_count == kMaxCalls) {
    throw std::runtime_error("more allocations than can be counted");
  }
  Allocations result;
  for (std::size_t i = 0; i < call_count; ++i) {
    // The innermost functions are note_allocation() and malloc() of this file.
    for (int frame = 2; frame < calls[i].depth; ++frame) {
      Dl_info info{};
      void* const address = calls[i].frames[static_cast<std::size_t>(frame)];
      const Layer layer = dladdr(address, &info) == 0 ? Layer::kStack : layer_of(info.dli_fname);
      if (layer == Layer::kRuntime) {
        continue;
      }
      if (layer == Layer::kFastDds) {
        ++result.in_fast_dds;
      } else {
        ++result.in_stack;
        if (result.stack_callers.size() < 10) {
          result.stack_callers.push_back(describe(info, address));
        }
      }
      break;
    }
  }
  return result;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
bool AllocationCount::is_possible() {
  return false;
}
#else
bool AllocationCount::is_possible() {
  return true;
}
#endif

}  // namespace test_support

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// glibc's own names for the replaced functions (malloc(3) allows replacing).
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
void* __libc_realloc(void* memory, std::size_t size);            // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT

void* malloc(std::size_t size) {
  test_support::note_allocation();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  test_support::note_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  test_support::note_allocation();
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  test_support::note_allocation();
  return __libc_memalign(alignment, size);
}
}
#endif
