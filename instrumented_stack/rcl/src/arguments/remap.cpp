// SPDX-License-Identifier: Apache-2.0
#include "rcl/remap.h"

#include "arguments/arguments_impl.hpp"
#include "names/names.hpp"
#include "rcl/error_handling.h"

namespace {

using rcl::RemapRule;

// The first match of the local rules; if there is none, of the global rules.
template <typename Find>
rcl_ret_t first_match(const rcl_arguments_t* local, const rcl_arguments_t* global, const rcl_allocator_t& allocator,
                      char** output, Find find) try {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(output, RCL_RET_INVALID_ARGUMENT);
  *output = nullptr;
  for (const rcl_arguments_t* arguments : {local, global}) {
    if (arguments == nullptr || arguments->impl == nullptr) {
      continue;
    }
    if (const std::optional<std::string> found = find(arguments->impl->remap_rules)) {
      return rcl::hand_out(*found, allocator, output);
    }
  }
  return RCL_RET_OK;
} catch (const rcl::NameError& error) {
  RCL_SET_ERROR_MSG(error.what());
  return error.code();
}

rcl_ret_t remap_name(RemapRule::Kind kind, const rcl_arguments_t* local, const rcl_arguments_t* global,
                     const char* name, const char* node_name, const char* node_namespace,
                     const rcl_allocator_t& allocator, char** output) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_namespace, RCL_RET_INVALID_ARGUMENT);
  return first_match(local, global, allocator, output, [&](const std::vector<RemapRule>& rules) {
    return rcl::remapped_name(rules, kind, name, node_name, node_namespace);
  });
}

rcl_ret_t remap_node(RemapRule::Kind kind, const rcl_arguments_t* local, const rcl_arguments_t* global,
                     const char* node_name, const rcl_allocator_t& allocator, char** output) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_name, RCL_RET_INVALID_ARGUMENT);
  return first_match(local, global, allocator, output,
                     [&](const std::vector<RemapRule>& rules) { return rcl::remapped_node(rules, kind, node_name); });
}

}  // namespace

rcl_ret_t rcl_remap_topic_name(const rcl_arguments_t* local_arguments, const rcl_arguments_t* global_arguments,
                               const char* topic_name, const char* node_name, const char* node_namespace,
                               rcl_allocator_t allocator, char** output_name) {
  return remap_name(RemapRule::Kind::kTopic, local_arguments, global_arguments, topic_name, node_name, node_namespace,
                    allocator, output_name);
}

rcl_ret_t rcl_remap_service_name(const rcl_arguments_t* local_arguments, const rcl_arguments_t* global_arguments,
                                 const char* service_name, const char* node_name, const char* node_namespace,
                                 rcl_allocator_t allocator, char** output_name) {
  return remap_name(RemapRule::Kind::kService, local_arguments, global_arguments, service_name, node_name,
                    node_namespace, allocator, output_name);
}

rcl_ret_t rcl_remap_node_name(const rcl_arguments_t* local_arguments, const rcl_arguments_t* global_arguments,
                              const char* node_name, rcl_allocator_t allocator, char** output_name) {
  return remap_node(RemapRule::Kind::kNodeName, local_arguments, global_arguments, node_name, allocator, output_name);
}

rcl_ret_t rcl_remap_node_namespace(const rcl_arguments_t* local_arguments, const rcl_arguments_t* global_arguments,
                                   const char* node_name, rcl_allocator_t allocator, char** output_namespace) {
  return remap_node(RemapRule::Kind::kNamespace, local_arguments, global_arguments, node_name, allocator,
                    output_namespace);
}
