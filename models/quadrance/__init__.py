"""This package has the bit-true integer models of the cores and the float64 truth with which they are compared."""
