"""Reading .uda archives into NumPy and drawing them."""
