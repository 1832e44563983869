"""Generators of the three scenes under scenes/. Python's standard library only."""
