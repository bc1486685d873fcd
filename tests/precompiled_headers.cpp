// SPDX-License-Identifier: Apache-2.0
// CMake precompiles headers for a target, and a target needs a source. The target's headers are what is wanted.
int main() {
  return 0;
}
