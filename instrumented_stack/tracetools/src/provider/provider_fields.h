// SPDX-License-Identifier: Apache-2.0
#pragma once

/* What LTTng records for a row of tracetools/event_table.h: pass the macro TRACETOOLS_PROBE to the table, with the
 * name of the provider.
 *
 * Arguments and fields have different names, because LTTng's macros would confuse an argument with its field.
 */

#include <stddef.h>
#include <stdint.h>

#include "tracetools/events.h"

/* Bytes of a recorded gid. Of those of version 8.4 and later it is RMW_GID_STORAGE_SIZE, whose header this package must
 * not include. */
#if TRACETOOLS_INTERFACE < 804
#define TRACETOOLS_GID_SIZE 24
#else
#define TRACETOOLS_GID_SIZE 16
#endif

/* clang-format off */

#define TRACETOOLS_PROBE(provider, name, Struct, group, ...) \
  LTTNG_UST_TRACEPOINT_EVENT(provider, name, \
    LTTNG_UST_TP_ARGS(TRACETOOLS_LIST(TRACETOOLS_EACH_FIELD(TRACETOOLS_PROBE_ARGUMENT, __VA_ARGS__))), \
    LTTNG_UST_TP_FIELDS(TRACETOOLS_EACH_FIELD(TRACETOOLS_PROBE_FIELD, __VA_ARGS__)))

#define TRACETOOLS_PROBE_ARGUMENT(type, name) TRACETOOLS_PROBE_ARGUMENT_##type(name)
#define TRACETOOLS_PROBE_ARGUMENT_pointer(name) , const void *, name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_string(name) , const char *, name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_keyword_string(name) , const char *, name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_size(name) , size_t, name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_uint64(name) , uint64_t, name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_int64(name) , int64_t, name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_boolean(name) , int, name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_gid(name) , const uint8_t *, name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_pointers(name) , const void **, name##_arg, size_t, num_##name##_arg
#define TRACETOOLS_PROBE_ARGUMENT_version(name)
#define TRACETOOLS_PROBE_ARGUMENT_ignored(name)
#define TRACETOOLS_PROBE_ARGUMENT_nothing(name) ,

#define TRACETOOLS_PROBE_FIELD(type, name) TRACETOOLS_PROBE_FIELD_##type(name)
#define TRACETOOLS_PROBE_FIELD_pointer(name) lttng_ust_field_integer_hex(const void *, name, name##_arg)
#define TRACETOOLS_PROBE_FIELD_string(name) lttng_ust_field_string(name, name##_arg)
#define TRACETOOLS_PROBE_FIELD_keyword_string(name) lttng_ust_field_string(name, name##_arg)
#define TRACETOOLS_PROBE_FIELD_size(name) lttng_ust_field_integer(size_t, name, name##_arg)
#define TRACETOOLS_PROBE_FIELD_uint64(name) lttng_ust_field_integer(uint64_t, name, name##_arg)
#define TRACETOOLS_PROBE_FIELD_int64(name) lttng_ust_field_integer(int64_t, name, name##_arg)
#define TRACETOOLS_PROBE_FIELD_boolean(name) lttng_ust_field_integer(int, name, name##_arg)
#define TRACETOOLS_PROBE_FIELD_gid(name) lttng_ust_field_array(uint8_t, name, name##_arg, TRACETOOLS_GID_SIZE)
#define TRACETOOLS_PROBE_FIELD_pointers(name) \
  lttng_ust_field_sequence_hex(const void *, name, name##_arg, size_t, num_##name##_arg)
#define TRACETOOLS_PROBE_FIELD_version(name) lttng_ust_field_string(name, tracetools_version)
#define TRACETOOLS_PROBE_FIELD_ignored(name)
#define TRACETOOLS_PROBE_FIELD_nothing(name)

/* clang-format on */
