// SPDX-License-Identifier: Apache-2.0
// Which functions the library shows: all that have a header.
#pragma once

#define RCL_YAML_PARAM_PARSER_EXPORT __attribute__((visibility("default")))
#define RCL_YAML_PARAM_PARSER_IMPORT
#define RCL_YAML_PARAM_PARSER_PUBLIC __attribute__((visibility("default")))
#define RCL_YAML_PARAM_PARSER_LOCAL __attribute__((visibility("hidden")))
#define RCL_YAML_PARAM_PARSER_PUBLIC_TYPE
