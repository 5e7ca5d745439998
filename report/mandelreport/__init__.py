# SPDX-License-Identifier: Apache-2.0
"""Makes the report from result files: one HTML page, its PDF, and the documentation."""
