# SPDX-License-Identifier: Apache-2.0
"""Figures: each function takes data and returns a block."""
