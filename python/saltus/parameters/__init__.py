"""What a diagram computes from its parameters. Nothing of it is loaded before it is used."""
