"""The short way to a run: `saltus.solve`, its guards and its solution."""
