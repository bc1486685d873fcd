// SPDX-License-Identifier: Apache-2.0
#include "stand_in/preloaded.hpp"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

namespace tracetools {
namespace {

// glibc writes the address of the table into the section, except for what the kernel has loaded.
const char* strings_of(const ElfW(Dyn) * section, ElfW(Addr) base) {
  for (const ElfW(Dyn)* entry = section; entry->d_tag != DT_NULL; ++entry) {
    if (entry->d_tag == DT_STRTAB) {
      const ElfW(Addr) address = entry->d_un.d_ptr;
      return reinterpret_cast<const char*>(address < base ? base + address : address);
    }
  }
  return nullptr;
}

bool needs_tracetools(const dl_phdr_info& object) {
  for (ElfW(Half) i = 0; i < object.dlpi_phnum; ++i) {
    if (object.dlpi_phdr[i].p_type != PT_DYNAMIC) {
      continue;
    }
    const auto* const section = reinterpret_cast<const ElfW(Dyn)*>(object.dlpi_addr + object.dlpi_phdr[i].p_vaddr);
    const char* const strings = strings_of(section, object.dlpi_addr);
    for (const ElfW(Dyn)* entry = section; strings != nullptr && entry->d_tag != DT_NULL; ++entry) {
      if (entry->d_tag == DT_NEEDED && std::strcmp(strings + entry->d_un.d_val, "libtracetools.so") == 0) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

bool is_needed() noexcept {
  return dl_iterate_phdr([](dl_phdr_info* object, std::size_t, void*) { return needs_tracetools(*object) ? 1 : 0; },
                         nullptr) != 0;
}

void keep_from_others() {
  Dl_info self;
  const char* const variable = std::getenv("LD_PRELOAD");
  if (variable == nullptr || dladdr(reinterpret_cast<const void*>(&is_needed), &self) == 0) {
    return;
  }
  constexpr const char* kSeparators = ": ";
  const std::string libraries = variable;
  std::string others;
  for (std::size_t begin = 0; begin < libraries.size();) {
    const std::size_t end = std::min(libraries.find_first_of(kSeparators, begin), libraries.size());
    const std::string library = libraries.substr(begin, end - begin);
    if (!library.empty() && library != self.dli_fname) {
      others += (others.empty() ? "" : ":") + library;
    }
    begin = end + 1;
  }
  if (others.empty()) {
    unsetenv("LD_PRELOAD");
  } else {
    setenv("LD_PRELOAD", others.c_str(), 1);
  }
}

}  // namespace tracetools
