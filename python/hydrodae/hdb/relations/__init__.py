"""Relations between arrays of numbers: memory, A at infinity, dispersion, headings, noise."""
