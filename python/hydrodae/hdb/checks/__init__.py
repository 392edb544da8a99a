"""What is wrong with a database: checks, their picture, repairs, comparison of two."""
