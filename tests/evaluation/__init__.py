# SPDX-License-Identifier: Apache-2.0
"""
The evaluation of this project: what recording a system costs, and what the stack, the launcher and the tools cost.

`./dev evaluate` runs it. It starts the programs of tests/benchmarks, and needs nothing but Python's own library.
docs/evaluation.md describes what is measured and how.
"""
