"""Generators of the scenes under scenes/. Python's standard library only."""
