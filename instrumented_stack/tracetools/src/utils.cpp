// SPDX-License-Identifier: Apache-2.0
#include "tracetools/utils.hpp"

#include <cxxabi.h>
#include <dlfcn.h>

namespace tracetools::detail {

char* demangle_symbol(const char* mangled) {
  if (mangled == nullptr) {
    return nullptr;
  }
  int status = 0;
  return abi::__cxa_demangle(mangled, nullptr, nullptr, &status);
}

char* get_symbol_funcptr(const void* address) {
  Dl_info info;
  if (dladdr(address, &info) == 0) {
    return nullptr;
  }
  return demangle_symbol(info.dli_sname);
}

}  // namespace tracetools::detail
