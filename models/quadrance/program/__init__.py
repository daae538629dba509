"""Programs of the engines that play a table of control words: what a word does, and whether a program is sound."""
