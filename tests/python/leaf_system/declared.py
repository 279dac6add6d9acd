"""A block that a test declares where it uses it."""

import saltus


class Block(saltus.LeafSystem):
    """Declares what `declare(self)` says."""

    def __init__(self, declare, name="block"):
        super().__init__(name=name)
        declare(self)
