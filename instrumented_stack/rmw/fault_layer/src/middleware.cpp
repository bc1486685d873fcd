// SPDX-License-Identifier: Apache-2.0
#include "middleware.hpp"

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

#include "layer_variable.hpp"

namespace rmw_fault_layer {

namespace {

// Of a program in Python, whose extension brings libraries that only it sees.
void* find_in_local_scope(const char* name) {
  for (const char* const library : {"librmw_implementation.so", "librmw.so"}) {
    if (void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD)) {
      if (void* const symbol = dlsym(handle, name)) {
        return symbol;
      }
    }
  }
  return nullptr;
}

void* find(const char* name) {
  void* const symbol = dlsym(RTLD_NEXT, name);
  return symbol != nullptr ? symbol : find_in_local_scope(name);
}

void* allocate(std::size_t size, void*) {
  return std::malloc(size);
}
void deallocate(void* memory, void*) {
  std::free(memory);
}
void* reallocate(void* memory, std::size_t size, void*) {
  return std::realloc(memory, size);
}
void* zero_allocate(std::size_t count, std::size_t size, void*) {
  return std::calloc(count, size);
}

// The process may have no librcutils when this library is loaded.
rcutils_allocator_t own_allocator() {
  return {allocate, deallocate, reallocate, zero_allocate, nullptr};
}

}  // namespace

void* find_next(const char* name) {
  void* const symbol = find(name);
  if (symbol == nullptr) {
    std::fprintf(stderr, "[rmw] faults of messages: the middleware of this process has no function %s()\n", name);
    std::abort();
  }
  return symbol;
}

bool is_needed() {
  static const bool needed = std::getenv(kVariableOfLayer) != nullptr || find("rmw_applies_message_faults") == nullptr;
  return needed;
}

bool services_tell_their_messages() {
  static const bool tell = find("rmw_get_gid_for_client") != nullptr;
  return tell;
}

std::size_t size_of_message_info() {
  constexpr std::size_t kWithGidOf16 = 64;
  constexpr std::size_t kWithGidOf24 = 72;
  static_assert(sizeof(rmw_message_info_t) == kWithGidOf16);
  static const std::size_t size = find("rmw_get_gid_for_client") != nullptr ? kWithGidOf16 : kWithGidOf24;
  return size;
}

Bytes serialize(const void* message, const rosidl_message_type_support_t* type) {
  static auto* const rmw_serialize_next = next<decltype(rmw_serialize)>("rmw_serialize");
  rmw_serialized_message_t serialized{nullptr, 0, 0, own_allocator()};
  Bytes bytes;
  if (rmw_serialize_next(message, type, &serialized) == RMW_RET_OK) {
    bytes.assign(serialized.buffer, serialized.buffer + serialized.buffer_length);
  }
  std::free(serialized.buffer);
  return bytes;
}

bool deserialize(const Bytes& bytes, const rosidl_message_type_support_t* type, void* message) try {
  static auto* const rmw_deserialize_next = next<decltype(rmw_deserialize)>("rmw_deserialize");
  const rmw_serialized_message_t serialized = view(bytes);
  return rmw_deserialize_next(&serialized, type, message) == RMW_RET_OK;
} catch (...) {
  return false;  // changed bytes may ask for more than there is
}

void NotSerialized::tell(const char* name) {
  if (!is_told_.exchange(true)) {
    std::fprintf(
        stderr,
        "[rmw] a fault of '%s' is not applied: it needs the bytes of a message, which this middleware does not "
        "give\n",
        name);
  }
}

rmw_serialized_message_t view(const Bytes& bytes) {
  return {const_cast<std::uint8_t*>(bytes.data()), bytes.size(), bytes.size(), own_allocator()};
}

}  // namespace rmw_fault_layer
