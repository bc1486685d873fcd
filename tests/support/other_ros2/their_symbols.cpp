// SPDX-License-Identifier: Apache-2.0
#include "their_interface.h"

namespace tracetools::detail {

#if THEIR_VERSION < 501
const char* demangle_symbol(const char*) {
  return "a name of theirs";
}
const char* get_symbol_funcptr(void*) {
  return "a name of theirs";
}
#else
char* demangle_symbol(const char*) {
  return nullptr;
}
char* get_symbol_funcptr(const void*) {
  return nullptr;
}
#endif

}  // namespace tracetools::detail
