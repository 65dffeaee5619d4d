"""The command ``hopper``: an answer for one hopper, as text, JSON, files and plots."""
