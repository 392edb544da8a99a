"""Ways to a database that a run can use: import, fit or kernel, boundary elements, arrays."""
