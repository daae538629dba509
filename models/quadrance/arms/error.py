"""What is wrong with an arm: apart from the reader of arm files, so that a model can say it and not follow from it."""


class ArmError(ValueError):
    """An arm file that cannot be used: names the file, the key and the reason."""
