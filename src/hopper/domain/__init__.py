"""Where hoppers are stable: neutral curves, borders and maps, Figures 4.4 and 4.5 of the paper."""
