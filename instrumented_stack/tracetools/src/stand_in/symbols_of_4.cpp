// SPDX-License-Identifier: Apache-2.0
// The names of callables as version 4 gives them, instead of utils.cpp: never null, and the caller does not free them.
#include <cxxabi.h>
#include <dlfcn.h>

namespace tracetools::detail {

// A symbol tells the types of parameters, and not what a function returns. So it is that of utils.cpp.
const char* demangle_symbol(const char* mangled) {
  if (mangled == nullptr) {
    return "UNKNOWN_demangling_failed";
  }
  int status = 0;
  const char* const name = abi::__cxa_demangle(mangled, nullptr, nullptr, &status);
  return name == nullptr ? mangled : name;
}

const char* get_symbol_funcptr(void* address) {
  Dl_info info;
  return dladdr(address, &info) == 0 ? "UNKNOWN" : demangle_symbol(info.dli_sname);
}

}  // namespace tracetools::detail
