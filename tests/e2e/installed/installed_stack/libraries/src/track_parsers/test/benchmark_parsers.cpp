// SPDX-License-Identifier: Apache-2.0
#error "benchmarks are not part of the build"
