"""Names of events and fields of traces."""
