/* Registers with LTTng's session daemon as a traced program does, by being linked with LTTng-UST, and ends.

   LTTng 2.13 hands the description of a session's events to its consumer when a traced program ends or the session is
   stopped, and then waits in steps of 200 ms until the consumer has written it. Run while the traced nodes are at work,
   this program has that done early, so that the session stops at once when they have ended. */
#include <lttng/tracepoint.h>

int main(void) {
  return 0;
}
