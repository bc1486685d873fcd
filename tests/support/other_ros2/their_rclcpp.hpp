// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// For Python, too. Arguments: CYCLES MICROSECONDS [late]. Makes the objects of a node, says "ready", and runs cycles of
// two callbacks, of which it counts each hundred. With "late" the message of one cycle is an hour old, and its callback
// takes 30 ms.
extern "C" int spin_their_node(int argc, char** argv);
