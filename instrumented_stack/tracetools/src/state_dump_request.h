// SPDX-License-Identifier: Apache-2.0
#ifndef STATE_DUMP_REQUEST_H_
#define STATE_DUMP_REQUEST_H_

#ifdef __cplusplus
extern "C" {
#endif

/* Has `dump` called in a thread of lttng-ust whenever LTTng asks this process for its state: a session starts, or
 * somebody runs `lttng regenerate statedump`. Call it once. Returns 0, or not 0 when this lttng-ust offers no way.
 *
 * `dump` holds up the tracer's control of this process while it runs; it may fire tracepoints. */
int tracetools_provider_on_state_dump(void (*dump)(void));

#ifdef __cplusplus
}
#endif

#endif /* STATE_DUMP_REQUEST_H_ */
