"""Speed figures, each a ratio or a total within one run. `make bench` runs them all."""
