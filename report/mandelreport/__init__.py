# SPDX-License-Identifier: Apache-2.0
"""From result files to the report: one HTML page, its PDF, and the documentation beside them."""
