"""Readers of the files of other programs: Nemoh, Capytaine, WAMIT, BEMIO."""
