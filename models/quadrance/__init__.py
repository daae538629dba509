"""Bit-true integer models of the Quadrance cores and the float64 truth they are held to."""
