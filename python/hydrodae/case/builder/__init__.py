"""What `hydrodae.Scene` is made of: entries, the base of the class, methods from the tables."""
