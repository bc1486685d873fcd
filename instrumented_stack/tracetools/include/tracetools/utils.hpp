// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <typeinfo>

#include "tracetools/config.h"

// Readable names of callables, for the event rclcpp_callback_register.
//
// Every function returns memory from malloc, which the caller must free. It returns null if there is no name: if the
// function is not in the dynamic symbol table (static, or a stripped executable), if its name is not mangled (extern
// "C"), or if tracepoints are disabled.
namespace tracetools {

#ifdef TRACETOOLS_DISABLED

namespace detail {

inline char* demangle_symbol(const char*) {
  return nullptr;
}

inline char* get_symbol_funcptr(const void*) {
  return nullptr;
}

}  // namespace detail

template <typename Callable>
char* get_symbol(const Callable&) {
  return nullptr;
}

#else

namespace detail {

// The demangled form of `mangled`; null if it is not a mangled name.
char* demangle_symbol(const char* mangled);

// The demangled name of the function at `address`.
char* get_symbol_funcptr(const void* address);

}  // namespace detail

// The name of the function if `callable` holds a plain function, otherwise the type of the callable it holds.
template <typename Result, typename... Arguments>
char* get_symbol(const std::function<Result(Arguments...)>& callable) {
  using Function = Result (*)(Arguments...);
  if (const Function* function = callable.template target<Function>()) {
    return detail::get_symbol_funcptr(reinterpret_cast<const void*>(*function));
  }
  return detail::demangle_symbol(callable.target_type().name());
}

// The type of a lambda or another function object. The type of a lambda names the function that contains it.
template <typename Callable>
char* get_symbol(const Callable& callable) {
  return detail::demangle_symbol(typeid(callable).name());
}

#endif  // TRACETOOLS_DISABLED

}  // namespace tracetools
