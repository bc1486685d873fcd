// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

// The identifier of the type supports of C messages. Their content is for Fast DDS.
extern const char* const rosidl_typesupport_c__typesupport_identifier;

#ifdef __cplusplus
}
#endif
