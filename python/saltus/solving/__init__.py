"""The short door: `saltus.solve`, its guards and what it returns."""
