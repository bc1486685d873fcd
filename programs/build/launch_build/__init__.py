# SPDX-License-Identifier: Apache-2.0
"""`launch build`: builds the packages of a workspace in their order."""
