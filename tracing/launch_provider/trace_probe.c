/* launch-trace-probe: registers with LTTng's session daemon as every traced program does, fires launch_probe:fired
   once, and ends.

   With it the launcher finds out whether a session with certain context fields records anything at all. And it saves
   time at the end of a session: LTTng 2.13 hands the description of the events to its consumer when a traced program
   ends or the session is stopped, and then waits in steps of 200 ms until the consumer has written it. Run while the
   traced nodes are at work, this program has that done early, so that the session stops at once when they have ended.
 */
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#define LTTNG_UST_TRACEPOINT_DEFINE
#include "probe_tracepoints.h"

int main(void) {
  lttng_ust_tracepoint(launch_probe, fired);
  return 0;
}
