// SPDX-License-Identifier: Apache-2.0
#ifndef STATE_DUMP_REQUEST_H_
#define STATE_DUMP_REQUEST_H_

#ifdef __cplusplus
extern "C" {
#endif

/* Makes a thread of lttng-ust call `dump` whenever LTTng asks this process for its state: when a session starts, or
 * when a user runs `lttng regenerate statedump`. Call it once. Returns 0, or another value if this lttng-ust cannot do
 * it.
 *
 * While `dump` runs, the tracer's control of this process waits. `dump` may fire tracepoints. */
int tracetools_provider_on_state_dump(void (*dump)(void));

#ifdef __cplusplus
}
#endif

#endif /* STATE_DUMP_REQUEST_H_ */
