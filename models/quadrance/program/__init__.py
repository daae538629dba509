"""This package makes programs of the product engine from equations and reads those of all engines.

`parser` to `table` go from a text to a Verilog table, `meaning` and `ranges` say what the text computes; `checker` and
`product_engine` judge control words and share no code with the others.
"""
