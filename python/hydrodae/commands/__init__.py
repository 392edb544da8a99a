"""The commands of `hydrodae`: they read arguments, call the package and print."""
