"""Figures: each function takes data and returns a block."""
