"""Studies of a case: responses in the frequency domain, charts of methods, ladders of models."""
