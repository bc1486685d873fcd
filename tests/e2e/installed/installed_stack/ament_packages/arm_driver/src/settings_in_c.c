// SPDX-License-Identifier: Apache-2.0
// Prints the parameters of a file.
#include <stdio.h>

#include "rcl_yaml_param_parser/parser.h"
#include "rcutils/error_handling.h"

int main(int argc, char** argv) {
  rcl_params_t* params = rcl_yaml_node_struct_init(rcutils_get_default_allocator());
  const rcl_variant_t* speed;
  if (argc != 2 || !params || !rcl_parse_yaml_file(argv[1], params)) {
    fprintf(stderr, "%s\n", rcutils_get_error_string().str);
    rcl_yaml_node_struct_fini(params);
    return 1;
  }
  speed = rcl_yaml_node_struct_get("/arm/elbow", "speed", params);
  if (speed && speed->double_value) {
    printf("speed %.1f\n", *speed->double_value);
  }
  rcl_yaml_node_struct_print(params);
  rcl_yaml_node_struct_fini(params);
  return 0;
}
