"""From result files to the report: one HTML page, its PDF, and the documentation beside them."""
