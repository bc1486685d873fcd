// SPDX-License-Identifier: Apache-2.0
// The service ~/get_type_description with messages of C, for client libraries that use these.
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include "rcl/described_types.hpp"
#include "rcl/error_handling.h"
#include "rcl/node.h"
#include "rcl/service.h"

namespace {

using Request = type_description_interfaces__srv__GetTypeDescription_Request;
using Response = type_description_interfaces__srv__GetTypeDescription_Response;
using IndividualType = type_description_interfaces__msg__IndividualTypeDescription;

// The memory of messages of C is from malloc().
void* allocate(size_t count, size_t size) {
  void* memory = std::calloc(count, size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

void set(rosidl_runtime_c__String& target, std::string_view text) {
  target = {static_cast<char*>(allocate(text.size() + 1, 1)), text.size(), text.size() + 1};
  std::memcpy(target.data, text.data(), text.size());
}

template <typename SequenceT>
void resize(SequenceT& sequence, size_t size) {
  sequence = {};
  if (size > 0) {
    sequence = {static_cast<decltype(sequence.data)>(allocate(size, sizeof *sequence.data)), size, size};
  }
}

void describe(const rosidl_type_description_t* type, IndividualType& target) {
  set(target.type_name, type == nullptr ? "" : type->type_name);
  resize(target.fields, type == nullptr ? 0 : type->field_count);
  for (size_t i = 0; i < target.fields.size; ++i) {
    const rosidl_field_description_t& field = type->fields[i];
    type_description_interfaces__msg__Field& described = target.fields.data[i];
    set(described.name, field.name);
    described.type.type_id = field.type_id;
    described.type.capacity = field.capacity;
    described.type.string_capacity = field.string_capacity;
    set(described.type.nested_type_name, field.nested_type == nullptr ? "" : field.nested_type->type_name);
    set(described.default_value, field.default_value);
  }
}

// Its library is loaded only where it is used, because programs in C++ have their own messages.
const rosidl_service_type_support_t* type_support_of_c() {
  using Get = const rosidl_service_type_support_t*();
  void* library = dlopen("libtype_description_interfaces__rosidl_generator_c.so", RTLD_NOW | RTLD_LOCAL);
  void* get = library == nullptr ? nullptr
                                 : dlsym(library,
                                         "rosidl_typesupport_c__get_service_type_support_handle__"
                                         "type_description_interfaces__srv__GetTypeDescription");
  return get == nullptr ? nullptr : reinterpret_cast<Get*>(get)();
}

}  // namespace

rcl_ret_t rcl_node_type_description_service_init(rcl_service_t* service, const rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service, RCL_RET_INVALID_ARGUMENT);
  if (!rcl_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  const rosidl_service_type_support_t* type_support = type_support_of_c();
  if (type_support == nullptr) {
    RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("the service of type descriptions needs a library: %s", dlerror());
    return RCL_RET_ERROR;
  }
  const rcl_service_options_t options = rcl_service_get_default_options();
  return rcl_service_init(service, node, type_support, "~/get_type_description", &options);
}

void rcl_node_type_description_service_handle_request(rcl_node_t* node, const rmw_request_id_t*, const Request* request,
                                                      Response* response) {
  const rcl::DescribedTypes described =
      rcl::describe_type(node, std::string(request->type_hash.data, request->type_hash.size));
  const bool is_known = !described.types.empty();
  const size_t nested = is_known ? described.types.size() - 1 : 0;
  response->successful = is_known;
  set(response->failure_reason, described.failure_reason);
  describe(is_known ? described.types[0] : nullptr, response->type_description.type_description);
  resize(response->type_description.referenced_type_descriptions, nested);
  for (size_t i = 0; i < nested; ++i) {
    describe(described.types[i + 1], response->type_description.referenced_type_descriptions.data[i]);
  }
  resize(response->type_sources, request->include_type_sources ? described.types.size() : 0);
  for (size_t i = 0; i < response->type_sources.size; ++i) {
    type_description_interfaces__msg__TypeSource& source = response->type_sources.data[i];
    set(source.type_name, described.types[i]->type_name);
    set(source.encoding, described.types[i]->encoding);
    set(source.raw_file_contents, described.types[i]->source);
  }
  resize(response->extra_information, 0);
}
