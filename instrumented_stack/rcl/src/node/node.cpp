// SPDX-License-Identifier: Apache-2.0
#include "rcl/node.h"

#include <memory>
#include <string>

#include "names/names.hpp"
#include "node/type_cache.hpp"
#include "rcl/error_handling.h"
#include "rcl/logging.h"
#include "rcl/logging_rosout.h"
#include "rcl/remap.h"
#include "rmw/rmw.h"
#include "tracetools/tracetools.h"

struct rcl_node_impl_s {
  rcl_node_options_t options = rcl_node_get_default_options();
  rmw_node_t* rmw_handle = nullptr;
  rcl_guard_condition_t graph_guard_condition = rcl_get_zero_initialized_guard_condition();
  std::string fully_qualified_name;
  std::string logger_name;
  bool has_rosout = false;
  rcl::TypeCache type_cache;
};

namespace {

using RemapNode = rcl_ret_t (*)(const rcl_arguments_t*, const rcl_arguments_t*, const char*, rcl_allocator_t, char**);

// Replaces `value` if a rule matches the node.
rcl_ret_t remap(RemapNode function, const rcl_node_options_t& options, const rcl_context_t& context,
                const std::string& node_name, std::string& value) {
  char* remapped = nullptr;
  const rcl_arguments_t* global = options.use_global_arguments ? &context.global_arguments : nullptr;
  const rcl_ret_t result = function(&options.arguments, global, node_name.c_str(), options.allocator, &remapped);
  if (remapped != nullptr) {
    value = remapped;
    options.allocator.deallocate(remapped, options.allocator.state);
  }
  return result;
}

rcl_ret_t check_names(const std::string& name, const std::string& namespace_) try {
  rcl::check_node_names(name, namespace_);
  return RCL_RET_OK;
} catch (const rcl::NameError& error) {
  RCL_SET_ERROR_MSG(error.what());
  return error.code();
}

std::string absolute(const char* namespace_) {
  return *namespace_ == '/' ? std::string(namespace_) : std::string("/") + namespace_;
}

// `/ns/node` → `ns.node`
std::string logger_name_of(const std::string& fully_qualified_name) {
  std::string result = fully_qualified_name.substr(1);
  for (char& c : result) {
    c = c == '/' ? RCUTILS_LOGGING_SEPARATOR_CHAR : c;
  }
  return result;
}

void destroy(rcl_node_impl_t* impl) {
  if (impl->graph_guard_condition.impl != nullptr) {
    (void)rcl_guard_condition_fini(&impl->graph_guard_condition);
  }
  if (impl->rmw_handle != nullptr) {
    (void)rmw_destroy_node(impl->rmw_handle);
  }
  (void)rcl_node_options_fini(&impl->options);
  delete impl;
}

// Fills a new node. The names are already remapped.
rcl_ret_t create(rcl_node_impl_t& impl, rcl_context_t* context, const std::string& name,
                 const std::string& namespace_) {
  impl.rmw_handle = rmw_create_node(rcl_context_get_rmw_context(context), name.c_str(), namespace_.c_str());
  if (impl.rmw_handle == nullptr) {
    return RCL_RET_ERROR;
  }
  impl.fully_qualified_name = rcl::fully_qualified_name(namespace_, name);
  impl.logger_name = logger_name_of(impl.fully_qualified_name);
  return rcl_guard_condition_init_from_rmw(&impl.graph_guard_condition,
                                           rmw_node_get_graph_guard_condition(impl.rmw_handle), context,
                                           rcl_guard_condition_get_default_options());
}

}  // namespace

rcl_node_t rcl_get_zero_initialized_node(void) {
  return {};
}

rcl_ret_t rcl_node_init(rcl_node_t* node, const char* name, const char* namespace_, rcl_context_t* context,
                        const rcl_node_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(namespace_, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  if (node->impl != nullptr) {
    RCL_SET_ERROR_MSG("the node is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  if (!rcl_context_is_valid(context)) {
    RCL_SET_ERROR_MSG("a node needs a context that is initialized and not shut down");
    return RCL_RET_NOT_INIT;
  }

  std::string final_name = name;
  std::string final_namespace = absolute(namespace_);
  if (const rcl_ret_t result = check_names(final_name, final_namespace); result != RCL_RET_OK) {
    return result;
  }
  if (const rcl_ret_t result = remap(rcl_remap_node_name, *options, *context, final_name, final_name);
      result != RCL_RET_OK) {
    return result;
  }
  // Rules for the namespace use the node's new name.
  if (const rcl_ret_t result = remap(rcl_remap_node_namespace, *options, *context, final_name, final_namespace);
      result != RCL_RET_OK) {
    return result;
  }
  if (const rcl_ret_t result = check_names(final_name, final_namespace); result != RCL_RET_OK) {
    return result;
  }

  auto* impl = new rcl_node_impl_s;
  rcl_ret_t result = rcl_node_options_copy(options, &impl->options);
  if (result == RCL_RET_OK) {
    result = create(*impl, context, final_name, final_namespace);
  }
  if (result != RCL_RET_OK) {
    destroy(impl);
    return result;
  }
  node->context = context;
  node->impl = impl;
  TRACETOOLS_TRACEPOINT(rcl_node_init, static_cast<const void*>(node), static_cast<const void*>(impl->rmw_handle),
                        impl->rmw_handle->name, impl->rmw_handle->namespace_);

  if (options->enable_rosout && rcl_logging_rosout_enabled()) {
    result = rcl_logging_rosout_init_publisher_for_node(node);
    if (result != RCL_RET_OK) {
      destroy(impl);
      *node = rcl_get_zero_initialized_node();
      return result;
    }
    impl->has_rosout = true;
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_node_fini(rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node, RCL_RET_NODE_INVALID);
  if (node->impl == nullptr) {
    return RCL_RET_OK;
  }
  rcl_ret_t result = RCL_RET_OK;
  if (node->impl->has_rosout) {
    result = rcl_logging_rosout_fini_publisher_for_node(node);
  }
  TRACETOOLS_EXT_TRACEPOINT(rcl_node_fini, static_cast<const void*>(node));
  destroy(node->impl);
  *node = rcl_get_zero_initialized_node();
  return result;
}

bool rcl_node_is_valid_except_context(const rcl_node_t* node) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(node, "the node is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(node->impl, "the node is not initialized", return false);
  return true;
}

bool rcl_node_is_valid(const rcl_node_t* node) {
  if (!rcl_node_is_valid_except_context(node)) {
    return false;
  }
  if (!rcl_context_is_valid(node->context)) {
    RCL_SET_ERROR_MSG("the context of the node is shut down");
    return false;
  }
  return true;
}

const char* rcl_node_get_name(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? node->impl->rmw_handle->name : nullptr;
}

const char* rcl_node_get_namespace(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? node->impl->rmw_handle->namespace_ : nullptr;
}

const char* rcl_node_get_fully_qualified_name(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? node->impl->fully_qualified_name.c_str() : nullptr;
}

const rcl_node_options_t* rcl_node_get_options(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? &node->impl->options : nullptr;
}

rcl_ret_t rcl_node_get_domain_id(const rcl_node_t* node, size_t* domain_id) {
  return rcl_node_is_valid_except_context(node) ? rcl_context_get_domain_id(node->context, domain_id)
                                                : RCL_RET_NODE_INVALID;
}

rmw_node_t* rcl_node_get_rmw_handle(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? node->impl->rmw_handle : nullptr;
}

rcl::TypeCache* rcl::type_cache_of(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? &node->impl->type_cache : nullptr;
}

uint64_t rcl_node_get_rcl_instance_id(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? rcl_context_get_instance_id(node->context) : 0;
}

const rcl_guard_condition_t* rcl_node_get_graph_guard_condition(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? &node->impl->graph_guard_condition : nullptr;
}

const char* rcl_node_get_logger_name(const rcl_node_t* node) {
  return rcl_node_is_valid_except_context(node) ? node->impl->logger_name.c_str() : nullptr;
}

rcl_ret_t rcl_node_resolve_name(const rcl_node_t* node, const char* input_name, rcl_allocator_t allocator,
                                bool is_service, bool only_expand, char** output_name) try {
  if (!rcl_node_is_valid_except_context(node)) {
    return RCL_RET_NODE_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(input_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(output_name, RCL_RET_INVALID_ARGUMENT);
  const char* name = rcl_node_get_name(node);
  const char* namespace_ = rcl_node_get_namespace(node);
  std::string resolved = rcl::expand_topic_name(input_name, name, namespace_);
  if (!only_expand) {
    const rcl_node_options_t& options = node->impl->options;
    const rcl_arguments_t* global = options.use_global_arguments ? &node->context->global_arguments : nullptr;
    char* remapped = nullptr;
    const rcl_ret_t result = (is_service ? rcl_remap_service_name : rcl_remap_topic_name)(
        &options.arguments, global, resolved.c_str(), name, namespace_, allocator, &remapped);
    if (result != RCL_RET_OK) {
      return result;
    }
    if (remapped != nullptr) {
      resolved = remapped;
      allocator.deallocate(remapped, allocator.state);
    }
  }
  rcl::check_full_topic_name(resolved);
  return rcl::hand_out(resolved, allocator, output_name);
} catch (const rcl::NameError& error) {
  RCL_SET_ERROR_MSG(error.what());
  return error.code();
}
