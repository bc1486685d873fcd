// SPDX-License-Identifier: Apache-2.0
#pragma once

// The events of provider `ros2` as C sees them: the functions of tracetools.h are declared and defined from this list.
//
// A row is EVENT(name, (parameters of the C function), (arguments that are recorded)). Rows come from event_table.h;
// add an event there.

#include "tracetools/event_table.h"

#define TRACETOOLS_EVENTS(EVENT) TRACETOOLS_EVENT_TABLE(TRACETOOLS_EVENT_IN_C, EVENT)

#define TRACETOOLS_EVENT_IN_C(EVENT, name, Struct, group, ...) \
  EVENT(name, TRACETOOLS_PARAMETERS(__VA_ARGS__), TRACETOOLS_ARGUMENTS(__VA_ARGS__))

// Expands the fields of a row of the table, in parentheses.
#define TRACETOOLS_PARAMETERS(...) (TRACETOOLS_LIST(TRACETOOLS_EACH_FIELD(TRACETOOLS_PARAMETER, __VA_ARGS__)))
#define TRACETOOLS_ARGUMENTS(...) (TRACETOOLS_LIST(TRACETOOLS_EACH_FIELD(TRACETOOLS_ARGUMENT, __VA_ARGS__)))

// Each field adds a comma before itself. A list drops the first comma.
#define TRACETOOLS_LIST(...) TRACETOOLS_AFTER_FIRST_COMMA(__VA_ARGS__)
#define TRACETOOLS_AFTER_FIRST_COMMA(nothing, ...) __VA_ARGS__

#define TRACETOOLS_PARAMETER(type, name) TRACETOOLS_PARAMETER_##type(name)
#define TRACETOOLS_PARAMETER_pointer(name) , const void* name
#define TRACETOOLS_PARAMETER_string(name) , const char* name
#define TRACETOOLS_PARAMETER_keyword_string(name) , const char* name##_
#define TRACETOOLS_PARAMETER_size(name) , size_t name
#define TRACETOOLS_PARAMETER_uint64(name) , uint64_t name
#define TRACETOOLS_PARAMETER_int64(name) , int64_t name
#define TRACETOOLS_PARAMETER_boolean(name) , bool name
#define TRACETOOLS_PARAMETER_gid(name) , const uint8_t* name
#define TRACETOOLS_PARAMETER_pointers(name) , const void **name, size_t num_##name
#define TRACETOOLS_PARAMETER_version(name)
#define TRACETOOLS_PARAMETER_ignored(name) , const void* name
#define TRACETOOLS_PARAMETER_nothing(name) , void

#define TRACETOOLS_ARGUMENT(type, name) TRACETOOLS_ARGUMENT_##type(name)
#define TRACETOOLS_ARGUMENT_pointer(name) , name
#define TRACETOOLS_ARGUMENT_string(name) , name
#define TRACETOOLS_ARGUMENT_keyword_string(name) , name##_
#define TRACETOOLS_ARGUMENT_size(name) , name
#define TRACETOOLS_ARGUMENT_uint64(name) , name
#define TRACETOOLS_ARGUMENT_int64(name) , name
#define TRACETOOLS_ARGUMENT_boolean(name) , name
#define TRACETOOLS_ARGUMENT_gid(name) , name
#define TRACETOOLS_ARGUMENT_pointers(name) , name, num_##name
#define TRACETOOLS_ARGUMENT_version(name)
#define TRACETOOLS_ARGUMENT_ignored(name)
#define TRACETOOLS_ARGUMENT_nothing(name) ,
