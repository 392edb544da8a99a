"""Pictures of results and of curves of others."""
