"""What every room may use: files and their kinds, progress, units, versions, processes, style."""
