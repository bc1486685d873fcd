// SPDX-License-Identifier: Apache-2.0
// The value of a parameter as a structure of C.
#pragma once

#include "rcl_yaml_param_parser/read_yaml.hpp"
#include "rcl_yaml_param_parser/types.h"

namespace rcl_yaml {

void clear_variant(rcl_variant_t& variant, const rcutils_allocator_t& allocator);

// Replaces the value. Without one, the variant is empty. Throws std::bad_alloc.
void set_variant(rcl_variant_t& variant, const std::optional<ParameterValue>& value,
                 const rcutils_allocator_t& allocator);

// Makes an empty variant equal to another one. Throws std::bad_alloc; clear_variant() then frees what is there.
void copy_variant(rcl_variant_t& target, const rcl_variant_t& source, const rcutils_allocator_t& allocator);

}  // namespace rcl_yaml
