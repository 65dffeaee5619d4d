"""What the scripts share: artifacts, provenance, logs, configuration, plots. No mathematics."""
