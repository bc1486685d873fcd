# SPDX-License-Identifier: Apache-2.0
"""Names of events and fields of traces."""
