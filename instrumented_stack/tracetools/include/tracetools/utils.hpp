// SPDX-License-Identifier: Apache-2.0
#ifndef TRACETOOLS__UTILS_HPP_
#define TRACETOOLS__UTILS_HPP_

#include <functional>
#include <typeinfo>

#include "tracetools/config.h"

/// Readable names of callables, for the event rclcpp_callback_register.
///
/// Every function returns memory from malloc, to be freed by the caller, or null when there is no name: a function that
/// the dynamic symbol table does not hold (static, or a stripped executable), one that was not mangled (extern "C"), or
/// tracepoints that are disabled.
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

/// The demangled form of `mangled`, null if it is not a mangled name.
char* demangle_symbol(const char* mangled);

/// The demangled name of the function at `address`.
char* get_symbol_funcptr(const void* address);

}  // namespace detail

/// The function's own name if `callable` holds a plain function, otherwise the type of what it holds.
template <typename Result, typename... Arguments>
char* get_symbol(const std::function<Result(Arguments...)>& callable) {
  using Function = Result (*)(Arguments...);
  if (const Function* function = callable.template target<Function>()) {
    return detail::get_symbol_funcptr(reinterpret_cast<const void*>(*function));
  }
  return detail::demangle_symbol(callable.target_type().name());
}

/// The type of a lambda or another function object; it names the function that a lambda stands in.
template <typename Callable>
char* get_symbol(const Callable& callable) {
  return detail::demangle_symbol(typeid(callable).name());
}

#endif  // TRACETOOLS_DISABLED

}  // namespace tracetools

#endif  // TRACETOOLS__UTILS_HPP_
