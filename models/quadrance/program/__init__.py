"""This package reads the programs of the engines: it says what a control word does and whether a program is sound."""
