// SPDX-License-Identifier: Apache-2.0
#include "stand_in/is_needed.hpp"

#include <link.h>

#include <cstring>

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

}  // namespace tracetools
